// What is known of the members of structs. records/make writes it from their headers.
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <tuple>

namespace gearlash::records {

template <class Place>
struct Member {
  const char* name;
  Place place;  ///< a pointer to a member, or to a function without arguments that computes it
  const char* attribute = name;  ///< its name in Python
};
template <class Place>
Member(const char*, Place) -> Member<Place>;  // clang 16 deduces no aggregate
template <class Place>
Member(const char*, Place, const char*) -> Member<Place>;

/// One whose own members stand in its place.
template <class Place>
struct Opened : Member<Place> {};
template <class Place>
Opened(const char*, Place) -> Opened<Place>;

/// Specialised for every struct: its name, the tuple `members` of those it holds and the tuple
/// `computed` of those it computes, and for what the tool prints `document`, the name of its
/// schema: "gearlash/design/3".
template <class Struct>
struct Record;

template <class Enumeration>
struct Word {
  Enumeration value;
  const char* text;  ///< the enumerator
};

/// Specialised for every enumeration: its name, all its values, and named(), the word of a value.
template <class Enumeration>
struct Words;

template <class Type>
concept IsRecord = requires { Record<Type>::members; };
template <class Type>
concept IsDocument = requires { Record<Type>::document; };
template <class Type>
concept IsWord = requires { Words<Type>::all; };

template <class Type>
concept IsCurve = requires(const Type& points) {
  { points.front().x } -> std::convertible_to<double>;
  { points.front().y } -> std::convertible_to<double>;
};

template <class Type, template <class...> class Template>
inline constexpr bool is_a = false;
template <template <class...> class Template, class... Arguments>
inline constexpr bool is_a<Template<Arguments...>, Template> = true;

}  // namespace gearlash::records
