// The exact answer beside which everything of 1960 is put.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/normalized_servo.hpp"
#include "picture/line_chart.hpp"

namespace gearlash::thesis {

/// Size of the largest stable limit cycle, rad; nothing where there is none.
std::optional<double> exact_amplitude(const NormalizedServo& servo);

/// The size through a continuum of servos, at places which rise: NaN where there is no cycle or no
/// such servo, 0 without a gap. Bisection finds the ends, where the cycle begins or ends.
/// Precondition: plastic contact, for which a cycle ends at one place between two neighbours.
ChartCurve exact_curve(const std::vector<double>& places,
                       const std::function<NormalizedServo(double place)>& servo_at);

}  // namespace gearlash::thesis
