// Where hunting ends along a line of servos: growth at rest 1.
#pragma once

#include <functional>
#include <optional>

#include "gearlash/quantity.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// The place next to the boundary, to the last bits and on the hunting side, between a place whose
/// servo hunts (growth at rest > 1) and one whose servo does not; by bisection, so that it is a
/// boundary whatever lies between. With plastic contact the cycle vanishes there: its size, speeds
/// and losses tend to 0, its period to infinity. Precondition: servos at both ends and between are
/// sound.
double hunting_end(const std::function<NormalizedServo(double place)>& servo_at, double hunting,
                   double quiet);

/// What it tends to where hunting ends, with plastic contact: 0 for the load's amplitude, the
/// speed, the losses and the frequency, half the backlash for the motor's amplitude, 1 for the
/// multiplier, infinity for the period and the time apart. Nothing where that is another number
/// from place to place, or where there is no such end.
std::optional<double> limit_where_hunting_ends(Quantity quantity, double backlash);

}  // namespace gearlash
