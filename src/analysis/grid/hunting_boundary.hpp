// The hunting-free boundary of a map: growth at rest 1.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/grid/grid_points.hpp"
#include "analysis/grid/region_boundary.hpp"

namespace gearlash {

/// The servo at a place of a map, whose first axis is y and second x; nothing where there is none,
/// or a drive that must be searched.
std::optional<NormalizedServo> servo_at(const GridPoints& points, const MapPoint& place);

/// Inside where small motion grows (growth at rest > 1), outside where it dies away; unknown where
/// there is no such servo, or more bounces than can be followed.
Side side_of_hunting(const std::optional<NormalizedServo>& servo);

/// The curves on which the growth at rest is 1 to the last bits, servos that hunt on their left.
/// With plastic contact there is no limit cycle on the other side, and the cycle's size tends to 0
/// towards the curve. Where faces bounce the growth can also jump past 1, from one number of
/// bounces to the next, and a limit cycle may go on existing beside a stable rest. `growth_at_rest`
/// is that of the grid's points, as evaluate() wrote it. There are no curves where an axis has less
/// than two values, or one that is infinite. Precondition: two axes, y and x.
std::vector<MapCurve> hunting_boundary(const Grid& grid, std::span<const double> growth_at_rest);

/// The curves around servos that no restitution can make hunt (is_dissipative()), which are on
/// their right. They lie where the growth at rest is at most 1. Precondition: two axes, y and x.
std::vector<MapCurve> dissipative_boundary(const Grid& grid);
/// Outside where no restitution can make the servo hunt, inside elsewhere; unknown of no servo.
Side side_of_dissipation(const std::optional<NormalizedServo>& servo);

}  // namespace gearlash
