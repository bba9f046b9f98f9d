#include "output/report_units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace gearlash {

std::string significant(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

std::string change_text(double ratio) {
  constexpr double most_told_in_percent = 10.0;
  if (ratio > most_told_in_percent) return "×" + significant(ratio, 3);
  const double percent = 100.0 * (ratio - 1.0);
  return (percent < 0.0 ? "−" : "+") + significant(std::abs(percent), 3) + " %";
}

std::string swing_text(double amplitude, const AngleUnit& unit, int digits) {
  const std::string radians = significant(amplitude, digits) + " rad";
  if (unit.radians != 1.0) {
    return fmt::format("±{} {} ({})", significant(unit.from_radians(amplitude), digits), unit.name,
                       radians);
  }
  const double degrees = amplitude * 180.0 / std::numbers::pi;
  return fmt::format("±{} ({}°)", radians, significant(degrees, digits));
}

}  // namespace gearlash
