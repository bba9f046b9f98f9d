// Where hunting ends, on a map or along a line of servos: growth at rest 1.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "gearlash/quantity.hpp"
#include "question/family/family.hpp"
#include "question/map/region_boundary.hpp"

namespace gearlash {

/// The servo at a place of a map whose axes are y and x, in this order; empty for an invalid drive
/// or one that must be searched.
std::optional<NormalizedServo> servo_at(const Family& family, const MapPoint& place);

/// Inside where small motion grows (growth at rest > 1), outside where it decays; unknown where
/// there is no such servo, or it bounces too often to follow.
Side side_of_hunting(const std::optional<NormalizedServo>& servo);

/// The curves on which the growth at rest is 1 to the last bits, with servos that hunt on their
/// left. With plastic contact there is no limit cycle on the other side, and the amplitude tends to
/// 0 towards the curve. Where faces bounce, the growth can also jump past 1 when the number of
/// bounces changes, and a limit cycle may exist beside a stable rest. `growth_at_rest` belongs to
/// the grid's points, as evaluate() gives it. There are no curves where an axis has fewer than two
/// values or an infinite one. Precondition: two axes, y and x.
std::vector<MapCurve> hunting_boundary(const Grid& grid, std::span<const double> growth_at_rest,
                                       Progress& progress = no_progress());

/// The curves around servos that cannot hunt with any restitution (is_dissipative()), which lie on
/// their right. The growth at rest on the curves is at most 1. Precondition: two axes, y and x.
std::vector<MapCurve> dissipative_boundary(const Grid& grid, Progress& progress = no_progress());
/// Outside where no restitution can make the servo hunt, inside elsewhere; unknown without a servo.
Side side_of_dissipation(const std::optional<NormalizedServo>& servo);

/// The place next to the boundary, on the hunting side and exact to the last bits, between a place
/// whose servo hunts (growth at rest > 1) and one whose servo does not. Found by bisection, so it
/// is a boundary even if there are others between. With plastic contact the cycle vanishes there:
/// its amplitude, speeds and losses tend to 0, its period to infinity. Precondition: servos at both
/// ends and between are sound.
double hunting_end(const std::function<NormalizedServo(double place)>& servo_at, double hunting,
                   double quiet);

/// The limit of a quantity where hunting ends, with plastic contact: 0 for the load's amplitude,
/// the speed, the torque, the losses and the frequency, half the backlash for the motor's
/// amplitude, 1 for the multiplier, infinity for the period and the time apart. Empty if the limit
/// depends on the place or does not exist.
std::optional<double> limit_where_hunting_ends(Quantity quantity, double backlash);

}  // namespace gearlash
