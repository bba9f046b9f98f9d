// Whole numbers as compact text, for records that are read back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/bits_of_double.hpp"

namespace gearlash {

/// Five bits to a character, the lowest first; all but the last character of a number have a sixth
/// bit. So small numbers are short. The characters need no escape in JSON.
class PackedNumbers {
 public:
  void add(std::uint64_t number) {
    for (; number >= 32U; number >>= 5U)
      text_ += digits[32U + static_cast<std::size_t>(number & 31U)];
    text_ += digits[static_cast<std::size_t>(number)];
  }
  void add_double(double number) { add(bits_of(number)); }
  const std::string& text() const& { return text_; }
  std::string text() && { return std::move(text_); }

  static constexpr std::string_view digits =
      "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-_";

 private:
  std::string text_;
};

/// Reads what PackedNumbers wrote. After a character that is not one of its own, or the end, every
/// number is missing.
class UnpackedNumbers {
 public:
  explicit UnpackedNumbers(std::string_view text) : text_(text) {}

  std::optional<std::uint64_t> next() {
    std::uint64_t number = 0;
    for (unsigned shift = 0; shift < 64U && !text_.empty(); shift += 5U) {
      const std::size_t digit = PackedNumbers::digits.find(text_.front());
      if (digit == std::string_view::npos) break;
      text_.remove_prefix(1);
      number |= static_cast<std::uint64_t>(digit & 31U) << shift;
      if (digit < 32U) return number;
    }
    text_ = {};
    return std::nullopt;
  }
  std::optional<double> next_double() {
    const std::optional<std::uint64_t> bits = next();
    return bits ? std::optional(double_of_bits(*bits)) : std::nullopt;
  }
  bool is_at_end() const { return text_.empty(); }

 private:
  std::string_view text_;
};

}  // namespace gearlash
