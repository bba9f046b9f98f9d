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

namespace by_trial {
namespace {

constexpr int most_digits = 17;  // read back as any double

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
  for (int count = 1; count <= most_digits; ++count) {
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

#else

std::string shortest_text(double value) { return by_trial::shortest_text(value); }
std::string shortest_scientific_text(double value) {
  return by_trial::shortest_scientific_text(value);
}
std::string rounded_text(double value, int digits) { return by_trial::rounded_text(value, digits); }

#endif

}  // namespace gearlash
