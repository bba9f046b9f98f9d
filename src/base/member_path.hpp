// Follows member pointers through structures, optional parts and alternatives of variants.
#pragma once

#include <type_traits>
#include <variant>

namespace gearlash {

/// The content of an optional part, nullptr if there is none; any other part itself.
template <class Part>
auto* content_of(Part* part) {
  if constexpr (requires { part->has_value(); }) {
    return part != nullptr && part->has_value() ? &**part : nullptr;
  } else {
    return part;
  }
}

/// A member of a part, which is the member's structure, an alternative of a variant, or optional.
template <class Part, class Whole, class Member>
auto* member_of(Part* part, Member Whole::*member) {
  auto* whole = [&] {
    auto* content = content_of(part);
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(*content)>, Whole>) {
      return content;
    } else {
      return std::get_if<Whole>(content);
    }
  }();
  return whole == nullptr ? nullptr : &(whole->*member);
}

/// What the member pointers lead to, one after the other; nullptr if a part on the way is absent.
template <auto first, auto... others, class Part>
auto* follow(Part* part) {
  auto* member = member_of(part, first);
  if constexpr (sizeof...(others) == 0) {
    return member;
  } else {
    return follow<others...>(member);
  }
}

}  // namespace gearlash
