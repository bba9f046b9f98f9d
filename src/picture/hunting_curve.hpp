// A curve through servos that continues to the place where hunting ends.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/normalized_servo.hpp"
#include "picture/curve_panel.hpp"

namespace gearlash {

/// A servo on the curve.
struct CurveServo {
  double place = 0.0;
  double value = 0.0;                        ///< NaN if there is none
  std::optional<bool> hunts = std::nullopt;  ///< nothing: no end of hunting is sought next to it
};

/// The line through the servos, which are in the order of rising places. If only one of two
/// neighbours hunts, bisection finds the place between them where hunting ends; the value goes to
/// `limit` there, and `ends` lists the point. Precondition: if an end is sought, contact is plastic
/// and the value has this limit.
NamedCurve curve_to_hunting_ends(const std::vector<CurveServo>& servos,
                                 const std::function<NormalizedServo(double place)>& servo_at,
                                 double limit);

}  // namespace gearlash
