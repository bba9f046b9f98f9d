#include "base/decimal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <locale>
#include <sstream>
#include <string>

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

/// ± 0.d₁d₂… · 10^point.
struct Digits {
  std::string sign;
  std::string digits;
  int point = 0;
};

/// One more or less in the last place; `step`: −1, 0 or 1. Empty where that changes the length.
std::string neighbour(const std::string& digits, int step) {
  const std::string text = std::to_string(std::stoll(digits) + step);
  return text.size() == digits.size() ? text : std::string();
}

/// The fewest digits that read back. With one less than most, the nearest decimal may be just
/// outside the numbers that read back as `value`, and its neighbour inside.
Digits shortest_digits(double value) {
  Digits result{.sign = std::signbit(value) ? "-" : "", .digits = {}};
  for (int count = 1; count <= static_cast<int>(most_digits); ++count) {
    const std::string text = printed(std::abs(value), count - 1, Notation::scientific);
    const std::size_t e = text.find('e');
    result.point = std::atoi(text.c_str() + e + 1) + 1;
    std::string digits = text.substr(0, e);
    std::erase(digits, '.');
    for (const int step : {0, 1, -1}) {
      result.digits = neighbour(digits, step);
      const std::string candidate = result.digits + "e" + std::to_string(result.point - count);
      if (!result.digits.empty() && std::strtod(candidate.c_str(), nullptr) == std::abs(value)) {
        return result;
      }
    }
  }
  return result;
}

std::string scientific(const Digits& number) {
  const int exponent = number.point - 1;
  std::string text = number.sign + number.digits.substr(0, 1);
  if (number.digits.size() > 1) text += "." + number.digits.substr(1);
  const std::string power = std::to_string(std::abs(exponent));
  return text + (exponent < 0 ? "e-" : "e+") + (power.size() < 2 ? "0" : "") + power;
}

std::string fixed(const Digits& number, double value) {
  const int length = static_cast<int>(number.digits.size());
  if (number.point >= length) return printed(value, 0, Notation::fixed);  // an integer, in full
  const std::string zeros(static_cast<std::size_t>(std::max(0, 1 - number.point)), '0');
  const std::string digits = zeros + number.digits;
  const auto whole = static_cast<std::size_t>(std::max(1, number.point));
  return number.sign + digits.substr(0, whole) + "." + digits.substr(whole);
}

}  // namespace

std::string shortest_scientific_text(double value) {
  return value == 0.0 ? printed(value, 0, Notation::scientific)
                      : scientific(shortest_digits(value));
}

std::string shortest_text(double value) {
  if (value == 0.0) return printed(value, 0, Notation::fixed);
  const Digits number = shortest_digits(value);
  const std::string with_exponent = scientific(number);
  const std::string without = fixed(number, value);
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
