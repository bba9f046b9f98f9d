// How Gearlash's own types are written in JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "model/normalized_servo.hpp"
#include "output/report_units.hpp"

namespace gearlash {

using Json = nlohmann::ordered_json;  ///< keys stay in the order in which they are documented

/// A number that reads back exactly; infinity as "inf" or "-inf", NaN (not computed) as null.
inline Json json_number(double value) {
  if (std::isnan(value)) return nullptr;
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

inline Json json_optional(const std::optional<double>& number) {
  return number ? json_number(*number) : Json(nullptr);
}

inline Json json_servo(const NormalizedServo& servo) {
  return {{"damping", json_number(servo.damping)},
          {"inertia_ratio", json_number(servo.inertia_ratio)},
          {"friction_ratio", json_number(servo.friction_ratio)},
          {"backlash", json_number(servo.backlash)},
          {"restitution", json_number(servo.restitution)},
          {"sensor", servo.sensor == ShaftName::load ? "load" : "motor"}};
}

inline Json json_provenance(const Provenance& provenance) {
  return {
      {"program", "gearlash"}, {"version", provenance.version}, {"command", provenance.command}};
}

}  // namespace gearlash
