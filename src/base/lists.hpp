// Questions to whole lists, and lists as text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gearlash {

template <class List, class Value>
bool contains(const List& list, const Value& value) {
  return std::find(std::begin(list), std::end(list), value) != std::end(list);
}

template <class List, class Holds>
bool any_of(const List& list, const Holds& holds) {
  return std::any_of(std::begin(list), std::end(list), holds);
}
template <class List, class Holds>
bool all_of(const List& list, const Holds& holds) {
  return std::all_of(std::begin(list), std::end(list), holds);
}

/// What `make`, a function or a member, gives of each element, as a list of `Made` if that is
/// given.
template <class Made = void, class List, class Make>
auto of_each(const List& list, const Make& make) {
  using Given = std::decay_t<decltype(std::invoke(make, *std::begin(list)))>;
  std::vector<std::conditional_t<std::is_void_v<Made>, Given, Made>> all;
  for (const auto& element : list) all.emplace_back(std::invoke(make, element));
  return all;
}

/// What `make` gives of each element and the next one.
template <class List, class Make>
auto of_neighbors(const List& list, const Make& make) {
  std::vector<std::decay_t<decltype(make(list[0], list[0]))>> all;
  for (std::size_t i = 0; i + 1 < list.size(); ++i) all.push_back(make(list[i], list[i + 1]));
  return all;
}

/// Those of which it holds.
template <class List, class Holds>
auto those_of(const List& list, const Holds& holds) {
  std::vector<std::decay_t<decltype(*std::begin(list))>> all;
  std::copy_if(std::begin(list), std::end(list), std::back_inserter(all), holds);
  return all;
}

template <class List, class Value>
void add_all(std::vector<Value>& list, const List& more) {
  list.insert(list.end(), std::begin(more), std::end(more));
}

template <class List, class Holds>
std::size_t count_of(const List& list, const Holds& holds) {
  return static_cast<std::size_t>(std::count_if(std::begin(list), std::end(list), holds));
}

/// The first of which it holds; nullptr if there is none.
template <class List, class Holds>
auto* first_of(List& list, const Holds& holds) {
  const auto found = std::find_if(std::begin(list), std::end(list), holds);
  return found == std::end(list) ? nullptr : &*found;
}

/// Compares by a member or a function of the elements.
template <class Key>
auto by(const Key& key) {
  return [key](const auto& one, const auto& other) {
    return std::invoke(key, one) < std::invoke(key, other);
  };
}

/// Stable, the least first, by a member or a function of the elements.
template <class List, class Key>
void sort_by(List& list, const Key& key) {
  std::stable_sort(std::begin(list), std::end(list), by(key));
}

/// 0, 1, …, count − 1.
inline std::vector<std::size_t> indices(std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

/// "a, b, c": a text, or a member that is one, of each element. Elements of an empty text are left
/// out.
template <class List, class Text>
std::string listed(const List& list, const Text& text_of, std::string_view separator = ", ") {
  std::string all;
  for (const auto& element : list) {
    const std::string text(std::invoke(text_of, element));
    if (!text.empty() && !all.empty()) all += separator;
    all += text;
  }
  return all;
}
template <class List>
std::string listed(const List& list) {
  return listed(list, std::identity());
}

}  // namespace gearlash
