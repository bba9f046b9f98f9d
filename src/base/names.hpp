// The names of an enumeration's values, in the order of its enumerators.
#pragma once

#include <cstddef>

namespace gearlash {

/// Of an enumeration whose enumerators are 0, 1, … up to `last`: one name for each. Any other value
/// has the name "".
template <auto last>
class Names {
 public:
  template <class... Name>
  explicit constexpr Names(Name... names) : names_{names...} {
    static_assert(sizeof...(Name) == count, "one name for each enumerator");
  }
  constexpr const char* operator[](decltype(last) value) const {
    const auto place = static_cast<std::size_t>(value);
    return place < count ? names_[place] : "";
  }

 private:
  static constexpr std::size_t count = static_cast<std::size_t>(last) + 1;
  const char* names_[count];
};

}  // namespace gearlash
