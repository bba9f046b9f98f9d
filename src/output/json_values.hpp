// Writing Gearlash's types as JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "gearlash/bounds.hpp"
#include "question/axis.hpp"
#include "question/change/target.hpp"

namespace gearlash {

using Json = nlohmann::ordered_json;  ///< keys stay in the documented order

/// A number that reads back exactly; infinity as "inf" or "-inf", NaN (not computed) as null.
inline Json json_number(double value) {
  if (std::isnan(value)) return nullptr;
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

inline Json json_optional(const std::optional<double>& number) {
  return number ? json_number(*number) : Json(nullptr);
}

/// The word if the axis has words, else the number. null for NaN.
inline Json json_value(const Axis& axis, const Drive& drive, double value) {
  const bool is_word = unit_of(axis, drive).empty() && !std::isnan(value);
  return is_word ? Json(text_of(axis, drive, value)) : json_number(value);
}

/// The list of convert(element).
template <class List, class Convert>
Json json_list(const List& list, const Convert& convert) {
  Json json = Json::array();
  for (const auto& element : list) json.push_back(convert(element));
  return json;
}

inline Json json_bounds(const Bounds& bounds) {
  return {{"from", json_number(bounds.low)}, {"to", json_number(bounds.high)}};
}

inline Json json_linear_loop(const std::optional<LinearLoop>& loop) {
  if (!loop) return nullptr;
  return {{"stable", loop->is_stable},
          {"bandwidth", json_optional(loop->bandwidth)},
          {"crossover", json_optional(loop->crossover)},
          {"phase_margin", json_optional(loop->phase_margin)}};
}

/// `Form` is NormalFormNumbers or NormalizedServo.
template <class Form>
Json json_normal_form(const Form& form, double natural_frequency) {
  return {{"damping", json_number(form.damping)},
          {"inertia_ratio", json_number(form.inertia_ratio)},
          {"friction_ratio", json_number(form.friction_ratio)},
          {"backlash", json_number(form.backlash)},
          {"restitution", json_number(form.restitution)},
          {"natural_frequency", json_number(natural_frequency)}};
}

}  // namespace gearlash
