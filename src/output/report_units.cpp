#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "gearlash/units.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

std::string significant(double value, int digits) {
  const std::string text = fmt::format("{:.{}g}", value, digits);
  constexpr double long_number = 1e6;
  const bool is_whole = std::abs(value) < long_number && text.find("e+") != std::string::npos;
  return is_whole ? fmt::format("{:.0f}", std::stod(text)) : text;
}

namespace {

double rounded(double bound, int digits, double (*round)(double)) {
  if (!(bound > 0.0) || !std::isfinite(bound)) return bound;
  const double last_unit = std::pow(10.0, std::floor(std::log10(bound)) - (digits - 1));
  return round(bound / last_unit) * last_unit;
}

}  // namespace

double rounded_up(double bound, int digits) { return rounded(bound, digits, std::ceil); }

double rounded_down(double bound, int digits) { return rounded(bound, digits, std::floor); }

std::string name_with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " (" + unit + ")";
}

std::string change_text(double ratio) {
  constexpr double most_told_in_percent = 10.0;
  if (ratio > most_told_in_percent) return "×" + significant(ratio, 3);
  const double percent = 100.0 * (ratio - 1.0);
  return (percent < 0.0 ? "−" : "+") + significant(std::abs(percent), 3) + " %";
}

std::string angle_text(double radians, const AngleUnit& unit, int digits) {
  return significant(unit.from_radians(radians), digits) + " " + unit.name;
}

DriveUnits::DriveUnits(const Drive& drive, int digits)
    : angle_(drive.angle_unit), is_normalized_(gearlash::is_normalized(drive)), digits_(digits) {}

std::string DriveUnits::angles(const Bounds& range) const {
  const double low = angle_.from_radians(range.low);
  const double high = angle_.from_radians(range.high);
  constexpr double unseen = 1e-9;  // relative to the larger; closer ends print as one number
  if (high - low <= unseen * std::max(std::abs(low), std::abs(high))) return angle(range.low);
  return fmt::format("{} … {} {}", number(low), number(high), angle_.name);
}

std::string DriveUnits::at_least(double radians) const {
  return number(rounded_down(angle_.from_radians(radians), digits_)) + " " + angle_.name;
}

std::string DriveUnits::swing_at_most(double amplitude) const {
  return "±" + number(rounded_up(angle_.from_radians(amplitude), digits_)) + " " + angle_.name;
}

std::string DriveUnits::frequency(double period) const {
  return is_normalized_ ? number(2.0 * std::numbers::pi / period) + " ω_n"
                        : number(1.0 / period) + " Hz";
}

std::string DriveUnits::pace(double period) const {
  if (!is_normalized_) return " at " + frequency(period);
  return ", period " + significant(period, std::max(digits_, usual_digits)) + " / ω_n";
}

}  // namespace gearlash
