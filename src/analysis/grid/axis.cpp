#include "analysis/grid/axis.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/range_check.hpp"

namespace gearlash {
namespace {

[[noreturn]] void refuse(std::string_view field, std::string value, std::string permitted) {
  throw InvalidInput({{std::string(field), std::move(value), std::move(permitted), ""}});
}

/// Whether this one number is permitted in an otherwise sound servo.
bool is_permitted(Input input, double value) {
  NormalizedServo servo{.damping = 0.5, .friction_ratio = 0.5};
  servo.*field_of(input) = value;
  return validate(servo).empty();
}

}  // namespace

const char* name_of(Input input) {
  switch (input) {
    case Input::damping:
      return "damping";
    case Input::inertia_ratio:
      return "inertia_ratio";
    case Input::friction_ratio:
      return "friction_ratio";
    case Input::backlash:
      return "backlash";
    case Input::restitution:
      return "restitution";
  }
  return "";
}

std::optional<Input> input_named(std::string_view name) {
  std::string underscored(name);
  std::replace(underscored.begin(), underscored.end(), '-', '_');
  for (const Input input : all_inputs) {
    if (underscored == name_of(input)) return input;
  }
  return std::nullopt;
}

const char* description_of(Input input) {
  switch (input) {
    case Input::damping:
      return "damping coefficient";
    case Input::inertia_ratio:
      return "inertia ratio, load to motor";
    case Input::friction_ratio:
      return "friction ratio, load to total";
    case Input::backlash:
      return "backlash";
    case Input::restitution:
      return "coefficient of restitution";
  }
  return "";
}

const char* unit_of(Input input) { return input == Input::backlash ? "rad" : "1"; }

double NormalizedServo::*field_of(Input input) {
  switch (input) {
    case Input::damping:
      return &NormalizedServo::damping;
    case Input::inertia_ratio:
      return &NormalizedServo::inertia_ratio;
    case Input::friction_ratio:
      return &NormalizedServo::friction_ratio;
    case Input::backlash:
      return &NormalizedServo::backlash;
    case Input::restitution:
      return &NormalizedServo::restitution;
  }
  return nullptr;
}

Axis spaced_axis(std::string_view field, Input input, double from, double to, std::size_t count,
                 Spacing spacing) {
  const bool logarithmic = spacing == Spacing::logarithmic;
  const std::string ends = exact_text(from) + " to " + exact_text(to);
  if (!std::isfinite(from) || !std::isfinite(to)) refuse(field, ends, "must be finite");
  if (logarithmic && !(from > 0.0)) {
    refuse(field, exact_text(from), "must be positive on a logarithmic axis");
  }
  if (from > to) refuse(field, ends, "must rise: the smaller value first");
  if (count < 1 || count > most_values_on_an_axis) {
    refuse(field, std::to_string(count) + " values",
           "must be from 1 to " + std::to_string(most_values_on_an_axis));
  }
  if ((count == 1) != (from == to)) {
    refuse(field, std::to_string(count) + " values from " + ends,
           "must be two or more between different ends, or one where they are the same");
  }
  Axis axis{input, {}, logarithmic};
  axis.values.reserve(count);
  const double steps = std::max(1.0, static_cast<double>(count) - 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto step = static_cast<double>(i);
    // By powers of ten, so that whole ones are met exactly.
    const double exponent = (std::log10(from) * (steps - step) + std::log10(to) * step) / steps;
    axis.values.push_back(logarithmic ? std::pow(10.0, exponent)
                                      : from + step / steps * (to - from));
  }
  axis.values.front() = from;
  axis.values.back() = to;
  return axis;
}

double position_on(const Axis& axis, double value) {
  const double low = axis.values.front();
  const double high = axis.values.back();
  return axis.logarithmic ? std::log(value / low) / std::log(high / low)
                          : (value - low) / (high - low);
}

double value_at(const Axis& axis, double position) {
  const double low = axis.values.front();
  const double high = axis.values.back();
  const double value = axis.logarithmic ? low * std::exp(position * std::log(high / low))
                                        : low + position * (high - low);
  return std::clamp(value, low, high);
}

std::size_t interval_of(const Axis& axis, double value) {
  const auto above = std::upper_bound(axis.values.begin() + 1, axis.values.end() - 1, value);
  return static_cast<std::size_t>(above - axis.values.begin()) - 1;
}

std::vector<Fault> validate(const Axis& axis, std::string_view field) {
  RangeCheck check;
  if (axis.values.empty()) {
    check.refuse(field, "no value", "must be at least one");
  }
  const auto refused = [&](double value) { return !is_permitted(axis.input, value); };
  const auto first = std::find_if(axis.values.begin(), axis.values.end(), refused);
  if (first != axis.values.end()) {
    const auto others = std::count_if(std::next(first), axis.values.end(), refused);
    check.refuse(
        field, exact_text(*first) + (others > 0 ? " and " + std::to_string(others) + " more" : ""),
        std::string(name_of(axis.input)) + " must be " + permitted_values(name_of(axis.input)));
  }
  const auto fall = std::adjacent_find(axis.values.begin(), axis.values.end(),
                                       [](double one, double next) { return !(one < next); });
  if (fall != axis.values.end()) {
    check.refuse(field, exact_text(*fall) + " before " + exact_text(*std::next(fall)),
                 "must rise from value to value");
  }
  return check.faults();
}

}  // namespace gearlash
