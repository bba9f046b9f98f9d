// Models of one shape with other numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace gearlash {

/// Makes `to` the shape of `from` and calls set(number of from, number of to) for each pair that
/// `set` takes; what else they hold is copied. Structures name their members by members().
/// Precondition: `to` is empty or has the shape of `from`.
template <class Set, class From, class To>
void set_numbers(const Set& set, const From& from, To& to);

namespace number_members {

template <class Set, class From, class To, std::size_t... Index>
void set_members(const Set& set, const From& from, To& to, std::index_sequence<Index...>) {
  constexpr auto read = From::members();
  constexpr auto written = To::members();
  (set_numbers(set, from.*std::get<Index>(read), to.*std::get<Index>(written)), ...);
}

template <class Set, class From, class To>
void set_model(const Set& set, const From& from, To& to) {
  if constexpr (requires { From::members(); }) {
    constexpr std::size_t count = std::tuple_size_v<decltype(From::members())>;
    set_members(set, from, to, std::make_index_sequence<count>());
  } else {
    to = from;
  }
}

template <class Set, class From, class To>
void set_model(const Set& set, const std::vector<From>& from, std::vector<To>& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) set_numbers(set, from[i], to[i]);
}

template <class Set, class From, class To>
void set_model(const Set& set, const std::optional<From>& from, std::optional<To>& to) {
  if (!from) return to.reset();
  if (!to) to.emplace();
  set_numbers(set, *from, *to);
}

template <class Set, class... From, class... To>
void set_model(const Set& set, const std::variant<From...>& from, std::variant<To...>& to) {
  const auto set_if_held = [&]<class One, class Other>() {
    const auto* one = std::get_if<One>(&from);
    if (one == nullptr) return;
    if (!std::holds_alternative<Other>(to)) to.template emplace<Other>();
    set_numbers(set, *one, std::get<Other>(to));
  };
  (set_if_held.template operator()<From, To>(), ...);
}

}  // namespace number_members

template <class Set, class From, class To>
void set_numbers(const Set& set, const From& from, To& to) {
  if constexpr (std::is_invocable_v<const Set&, const From&, To&>) {
    set(from, to);
  } else {
    number_members::set_model(set, from, to);
  }
}

}  // namespace gearlash
