#include "output/parameter_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gearlash/output.hpp"
#include "question/change/target.hpp"

namespace gearlash {

ParameterFacts facts_of(const Drive& drive, const std::string& path) {
  const Axis axis{.path = path};
  const Parameter& parameter = *parameter_of(axis, drive);
  return {.path = path,
          .unit = unit_of(axis, drive),
          .meaning = std::string(parameter.meaning),
          .choices = parameter.choices};
}

ParameterText::ParameterText(const Drive& drive, std::string parameter, int digits)
    : drive_(drive),
      axis_{.path = std::move(parameter)},
      unit_(unit_of(axis_, drive)),
      digits_(digits) {
  if (unit_ == "rad") {
    unit_ = drive.angle_unit.name;
    size_ = drive.angle_unit.radians;
  }
  if (unit_ == "1") unit_.clear();
}

void ParameterText::show_in(const std::string& unit, double size) {
  unit_ = unit == "1" ? "" : unit;
  size_ = size;
}

std::string ParameterText::of(double value) const {
  if (std::isnan(value)) return "";
  return is_word() ? text_of(axis_, drive_, value) : with_unit(significant(value / size_, digits_));
}

std::string ParameterText::at_least(double value) const {
  return with_unit(significant(rounded_up(value / size_, digits_), digits_));
}

std::string ParameterText::at_most(double value) const {
  return with_unit(significant(rounded_down(value / size_, digits_), digits_));
}

std::string ParameterText::of(const Bounds& interval) const {
  if (interval.low == interval.high) return of(interval.low);
  return significant(rounded_up(interval.low / size_, digits_), digits_) + " to " +
         with_unit(significant(rounded_down(interval.high / size_, digits_), digits_));
}

void SearchedGrids::add(const std::string& parameter, std::size_t count, const Bounds& range) {
  const ParameterText shown(drive_, parameter);
  text_ += fmt::format("{}{}, {} values", text_.empty() ? "" : "; ", parameter, count);
  if (!shown.is_word()) text_ += " from " + shown.of(range.low) + " to " + shown.of(range.high);
}

std::string SearchedGrids::located_text(const std::string& ends) const {
  if (!(located_ > 0.0)) return "";
  return " " + ends + " are located to " + significant(located_, 1) + " of their value";
}

std::string words_of(Quantity quantity) {
  std::string words(name_of(quantity));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

DrawnUnit drawn_unit(Quantity quantity, const AngleUnit& angle, bool is_normalized) {
  const std::string unit(info_of(quantity).unit);
  if (unit == "rad") return {angle.name, angle.radians};
  if (unit == "1") return {};
  if (!is_normalized) return {unit};
  if (unit == "s") return {"1/ω_n"};
  if (unit == "Hz") return {"ω_n", 0.5 / std::numbers::pi};
  if (unit == "rad/s") return {"rad ω_n"};
  return {unit == "J" ? "K rad²" : unit};
}

std::string result_text(const Answer& answer, const Drive& drive) {
  constexpr int few_digits = 3;
  const DriveUnits units(drive, few_digits);
  std::string text = name_of(answer.verdict);
  if (answer.verdict == Verdict::cannot_hunt && answer.growth_at_rest) {
    text += " (growth " + units.number(*answer.growth_at_rest) + ")";
  }
  const std::optional<double> load = answer.value(Quantity::amplitude);
  const std::optional<double> motor = answer.value(Quantity::motor_amplitude);
  constexpr double hardly = 1e-3;  // the load moves while the motor hunts within the gap
  const bool is_of_motor = load && motor && *load < hardly * *motor;
  const std::optional<double> amplitude = is_of_motor ? motor : load;
  const std::optional<double> error = answer.value(Quantity::error);
  const std::string off = error && std::isfinite(*error) && *error > 1.05 * load.value_or(0.0)
                              ? ", up to " + units.angle(*error) + " off"
                              : "";
  if (!amplitude || *amplitude == 0.0) return text + off;
  text += (is_of_motor ? ": motor " : ": ") + units.swing(*amplitude);
  const auto frequency = answer.value(Quantity::frequency);
  if (frequency && !units.is_normalized()) {
    text += " at " + units.number(*frequency) + " Hz";
  }
  return text + off;
}

std::string hidden_error_text(const Target& target, const std::vector<const Answer*>& answers,
                              const Drive& drive) {
  double error = 0.0;
  for (const Answer* answer : answers) {
    const double own = answer->value(Quantity::error).value_or(0.0);
    if (is_met(target, *answer) && hides_error(target, own)) error = std::max(error, own);
  }
  if (error == 0.0) return "";
  return further_paragraph(
      "The target limits the amplitude of hunting alone: where it is met the load may end " +
      DriveUnits(drive).angle(error) +
      " off. \"error <= …\" limits where it ends, static error and hunting "
      "together.");
}

std::string step_text(const StepResponse& step, const Drive& drive) {
  const DriveUnits units(drive);
  return "a step of " + units.angle(step.step) + ", settled within " + units.swing(step.band);
}

}  // namespace gearlash
