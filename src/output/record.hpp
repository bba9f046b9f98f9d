// What is known of the members of structs. records/make writes it from their headers.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace gearlash::records {

template <class Place>
struct Member {
  const char* name;
  Place place;  ///< a pointer to a member, or to a function without arguments that computes it
  const char* unit = "";         ///< as its comment has it
  const char* attribute = name;  ///< its name in Python
};
template <class Place, class... Texts>
Member(const char*, Place, Texts...) -> Member<Place>;  // clang 16 deduces no aggregate

/// One whose own members stand in its place.
template <class Place>
struct Opened : Member<Place> {};
template <class Place, class... Texts>
Opened(const char*, Place, Texts...) -> Opened<Place>;

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

/// Whether another member of the struct has that type too.
template <class Struct, class Type>
inline constexpr bool has_several = std::apply(
    [](const auto&... one) {
      return (std::size_t{std::is_same_v<decltype(one.place), Type Struct::*>} + ... + 0U) > 1U;
    },
    Record<Struct>::members);

/// All numbers and words of a struct, those of structs within it in their places: visit(member,
/// holder, value). The holder is the name of the struct's member that it is within; empty where the
/// names differ without it.
template <class Struct, class Visit>
void for_each_leaf(const Struct& value, const Visit& visit, const char* holder = "") {
  const auto leaf = [&](const auto& one) {
    using Type = std::remove_cvref_t<decltype(value.*(one.place))>;
    if constexpr (IsRecord<Type>) {
      for_each_leaf(value.*(one.place), visit, has_several<Struct, Type> ? one.name : "");
    } else {
      visit(one, holder, value.*(one.place));
    }
  };
  std::apply([&](const auto&... one) { (leaf(one), ...); }, Record<Struct>::members);
}

/// "load_position_before": the name of a leaf, then its holder's.
template <class Place>
std::string leaf_name(const Member<Place>& member, std::string_view holder) {
  return std::string(member.name) + (holder.empty() ? "" : "_") + std::string(holder);
}

template <class Type, template <class...> class Template>
inline constexpr bool is_a = false;
template <template <class...> class Template, class... Arguments>
inline constexpr bool is_a<Template<Arguments...>, Template> = true;

}  // namespace gearlash::records

namespace gearlash {

/// Rows that are computed while they are written.
template <class Row>
struct RowsOf {
  std::function<void(const std::function<void(const Row&)>&)> each;
};

}  // namespace gearlash
