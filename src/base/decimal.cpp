#include "base/decimal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <locale>
#include <sstream>

namespace gearlash {

// libc++ 14, with which the page is compiled, reads no doubles by from_chars. There the locale is
// always that of C.
std::optional<double> nearest_double(std::string_view text) {
#ifdef __cpp_lib_to_chars
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  return value;
#else
  const double value = std::strtod(std::string(text).c_str(), nullptr);
  const std::string_view digits = text.substr(0, text.find_first_of("eE"));
  const bool vanished = value == 0.0 && digits.find_first_of("123456789") != std::string_view::npos;
  if (vanished || !std::isfinite(value)) return std::nullopt;
  return value;
#endif
}

namespace {

constexpr std::size_t most_digits = 17;  // read back as any double
constexpr int digits_of_long_text = 20;

/// The digits of a decimal number from the first that is not 0 on.
std::string significant_digits(std::string_view text) {
  std::string digits(text.substr(0, text.find_first_of("eE")));
  std::erase_if(digits, [](char c) { return c < '0' || c > '9'; });
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

std::string without_zeros_at_end(std::string digits) {
  while (digits.ends_with('0')) digits.pop_back();
  return digits;
}

}  // namespace

Decimal shortest_decimal(double value) {
  const std::string text = shortest_scientific_text(value);
  const std::string digits = significant_digits(text);
  if (digits.empty()) return {};  // 0
  const int exponent = std::stoi(text.substr(text.find('e') + 1));
  return {std::stoull(digits), exponent - static_cast<int>(digits.size()) + 1};
}

bool is_long_decimal(std::string_view text) {
  const std::string digits = significant_digits(text);
  if (digits.empty()) return false;  // 0
  const std::optional<double> value = nearest_double(text);
  if (value && text == shortest_text(*value)) return false;  // an integer has all its digits
  if (!value || digits.size() > most_digits) return true;
  const std::string shortest = significant_digits(shortest_scientific_text(*value));
  return without_zeros_at_end(digits) != without_zeros_at_end(shortest);
}

namespace {

/// The power of ten of the first digit that is not 0. Precondition: there is one.
int leading_power(std::string_view text) {
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  const std::string_view digits = text.substr(0, e);
  const auto point = static_cast<int>(std::min(digits.find('.'), digits.size()));
  const auto first = static_cast<int>(digits.find_first_of("123456789"));
  const int exponent = e == text.size() ? 0 : std::stoi(std::string(text.substr(e + 1)));
  return exponent + (first < point ? point - first - 1 : point - first);
}

}  // namespace

bool is_above(std::string_view one, std::string_view other, int power) {
  const std::string digits = without_zeros_at_end(significant_digits(one));
  const std::string other_digits = without_zeros_at_end(significant_digits(other));
  if (digits.empty() || other_digits.empty()) return !digits.empty();
  const int excess = leading_power(one) - leading_power(other) - power;
  return excess != 0 ? excess > 0 : digits > other_digits;
}

bool is_short_decimal(double value) {
  constexpr int most_decimals = 15;
  double scale = 1.0;
  for (int decimals = 0; decimals <= most_decimals; ++decimals, scale *= 10.0) {
    const double scaled = value * scale;
    if (scaled == std::floor(scaled)) return std::fma(value, scale, -scaled) == 0.0;
  }
  return false;
}

namespace by_trial {
namespace {

enum class Notation { general, scientific, fixed };

std::string printed(double value, int precision, Notation notation) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(precision);
  if (notation == Notation::scientific) text.setf(std::ios::scientific, std::ios::floatfield);
  if (notation == Notation::fixed) text.setf(std::ios::fixed, std::ios::floatfield);
  text << value;
  return text.str();
}

}  // namespace

/// The fewest digits that read back. The nearest decimal of so many may be just below the numbers
/// that read back as `value`, if that is a power of two, and the next one among them.
std::string shortest_scientific_text(double value) {
  std::string text;
  for (std::size_t count = 1; count <= most_digits; ++count) {
    text = printed(value, static_cast<int>(count) - 1, Notation::scientific);
    if (std::strtod(text.c_str(), nullptr) == value) break;
    char& last = text[text.find('e') - 1];
    if (last == '9') continue;  // the next one has fewer digits
    ++last;
    if (std::strtod(text.c_str(), nullptr) == value) break;
  }
  return text;
}

std::string shortest_text(double value) {
  std::string with_exponent = shortest_scientific_text(value);
  const std::size_t e = with_exponent.find('e');
  const auto decimals = static_cast<int>(significant_digits(with_exponent).size()) - 1 -
                        std::stoi(with_exponent.substr(e + 1));
  std::string without = printed(value, std::max(0, decimals), Notation::fixed);
  return without.size() <= with_exponent.size() ? without : with_exponent;
}

std::string rounded_text(double value, int digits) {
  return printed(value, digits, Notation::general);
}

std::string long_text(double value) {
  return printed(value, digits_of_long_text - 1, Notation::scientific);
}

}  // namespace by_trial

#ifdef __cpp_lib_to_chars

namespace {

template <class... Format>
std::string written(double value, Format... format) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format...);
  return {text.data(), end.ptr};
}

}  // namespace

std::string shortest_text(double value) { return written(value); }
std::string shortest_scientific_text(double value) {
  return written(value, std::chars_format::scientific);
}
std::string rounded_text(double value, int digits) {
  return written(value, std::chars_format::general, digits);
}
std::string long_text(double value) {
  return written(value, std::chars_format::scientific, digits_of_long_text - 1);
}

#else

std::string shortest_text(double value) { return by_trial::shortest_text(value); }
std::string shortest_scientific_text(double value) {
  return by_trial::shortest_scientific_text(value);
}
std::string rounded_text(double value, int digits) { return by_trial::rounded_text(value, digits); }
std::string long_text(double value) { return by_trial::long_text(value); }

#endif

}  // namespace gearlash
