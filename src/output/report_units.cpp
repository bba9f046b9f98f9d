#include "output/report_units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

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

std::string time_text(double seconds, bool is_normalized, int digits) {
  return significant(seconds, digits) + (is_normalized ? " / ω_n" : " s");
}

std::string frequency_text(double period, bool is_normalized, int digits) {
  if (!is_normalized) return significant(1.0 / period, digits) + " Hz";
  return "ω = " + significant(2.0 * std::numbers::pi / period, digits) + " ω_n";
}

std::string swing_text(double amplitude, const AngleUnit& unit, int digits) {
  return "±" + angle_text(amplitude, unit, digits);
}

std::string swing_bound_text(double amplitude, const AngleUnit& unit, int digits) {
  return fmt::format(
      "±{} {}", significant(rounded_up(unit.from_radians(amplitude), digits), digits), unit.name);
}

std::string step_text(const StepResponse& step, const AngleUnit& unit) {
  return "a step of " + angle_text(step.step, unit, usual_digits) + ", settled within " +
         swing_text(step.band, unit, usual_digits);
}

}  // namespace gearlash
