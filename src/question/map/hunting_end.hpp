// Where hunting ends along a line of servos: growth at rest 1.
#pragma once

#include <functional>
#include <optional>

#include "gearlash/quantity.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// The place next to the boundary, on the hunting side and exact to the last bits, between a place
/// whose servo hunts (growth at rest > 1) and one whose servo does not. Found by bisection, so it
/// is a boundary even if there are others between. With plastic contact the cycle vanishes there:
/// its amplitude, speeds and losses tend to 0, its period to infinity. Precondition: servos at both
/// ends and between are sound.
double hunting_end(const std::function<NormalizedServo(double place)>& servo_at, double hunting,
                   double quiet);

/// The limit of a quantity where hunting ends, with plastic contact: 0 for the load's amplitude,
/// the speed, the losses and the frequency, half the backlash for the motor's amplitude, 1 for the
/// multiplier, infinity for the period and the time apart. Empty if the limit depends on the place
/// or does not exist.
std::optional<double> limit_where_hunting_ends(Quantity quantity, double backlash);

}  // namespace gearlash
