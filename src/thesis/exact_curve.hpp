// The exact motions and amplitudes, by the closed form, for comparison with those of 1960.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "closed_form/limit_cycle.hpp"
#include "closed_form/trajectory.hpp"
#include "model/normalized_servo.hpp"
#include "picture/curve_panel.hpp"

namespace gearlash::thesis {

/// Amplitude of the largest stable limit cycle, rad; nothing if there is none.
std::optional<double> exact_amplitude(const NormalizedServo& servo);

/// The amplitude over a continuum of servos at rising places: NaN without a cycle or for an
/// impossible servo, 0 without a gap. Bisection finds the places where the cycle begins or ends.
/// Precondition: plastic contact, with which a cycle ends at a single place between two neighbours.
NamedCurve exact_curve(const std::vector<double>& places,
                       const std::function<NormalizedServo(double place)>& servo_at);

}  // namespace gearlash::thesis
