#include "picture/axis_scale.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "picture/gnuplot_script.hpp"

namespace gearlash {
namespace {

/// The power of ten, a multiple of three, that numbers up to `largest` are multiples of.
int shown_power(double largest) {
  constexpr double smallest_plain = 0.02;
  constexpr double largest_plain = 1e5;
  if (!(largest > 0.0) || (largest >= smallest_plain && largest < largest_plain)) return 0;
  constexpr double rounding = 1e-9;
  return 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0 + rounding));
}

std::string superscript(int number) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += digits[digit - '0'];
  return text;
}

std::string unit_of_power(const std::string& unit, int power) {
  if (power == 0) return unit;
  if (unit.starts_with("rad") || unit == "N m") {
    switch (power) {
      case -9:
        return "n" + unit;
      case -6:
        return "µ" + unit;
      case -3:
        return "m" + unit;
      case 6:
        return "M" + unit;
      default:
        break;
    }
  }
  return "10" + superscript(power) + " " + unit;
}

}  // namespace

AxisScale axis_scale(char name, const std::string& quantity, const std::string& unit,
                     const Bounds& range, int most) {
  const int power = shown_power(std::max(std::abs(range.low), std::abs(range.high)));
  const double scale = std::pow(10.0, power);
  const double step = round_step(range.high - range.low, most);
  std::vector<std::string> tics;
  for (double i = std::ceil(range.low / step - 1e-9); i * step <= range.high; ++i) {
    const double value = i == 0.0 ? 0.0 : i * step;
    tics.push_back(fmt::format("'{:.6g}' {:.7g}", value / scale, value));
  }
  return {.tics = fmt::format("set {}tics ({})\n", name, fmt::join(tics, ", ")),
          .label = quantity + " (" + unit_of_power(unit, power) + ")"};
}

}  // namespace gearlash
