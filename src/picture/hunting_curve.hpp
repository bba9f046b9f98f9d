// A curve through servos of which some hunt, drawn on to where hunting ends.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/normalized_servo.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {

/// A servo on the way along the curve.
struct CurveServo {
  double place = 0.0;
  double value = 0.0;                        ///< NaN where there is none
  std::optional<bool> hunts = std::nullopt;  ///< nothing: no end is sought next to it
};

/// The line through the servos, whose places rise. Between two neighbours of which one hunts and
/// the other does not, the value goes to `limit` at the place where hunting ends, which bisection
/// finds and `ends` lists. Precondition: plastic contact where an end is sought, and a value that
/// has this limit there.
ChartCurve curve_to_hunting_ends(const std::vector<CurveServo>& servos,
                                 const std::function<NormalizedServo(double place)>& servo_at,
                                 double limit);

}  // namespace gearlash
