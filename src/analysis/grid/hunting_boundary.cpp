#include "analysis/grid/hunting_boundary.hpp"

#include <cmath>

#include "closed_form/energy_balance.hpp"
#include "closed_form/growth_at_rest.hpp"

namespace gearlash {
namespace {

Side side_of(double growth_at_rest) {
  if (std::isnan(growth_at_rest)) return Side::unknown;
  return growth_at_rest > 1.0 ? Side::inside : Side::outside;
}

}  // namespace

NormalizedServo servo_at(const ServoGrid& grid, const MapPoint& point) {
  NormalizedServo servo = grid.servo;
  servo.*field_of(grid.axes[0].input) = point.y;
  servo.*field_of(grid.axes[1].input) = point.x;
  return servo;
}

Side side_of_hunting(const NormalizedServo& servo) {
  if (!validate(servo).empty()) return Side::unknown;
  return side_of(growth_at_rest(servo_dynamics(servo)));
}

Side side_of_dissipation(const NormalizedServo& servo) {
  if (!validate(servo).empty()) return Side::unknown;
  return is_dissipative(servo) ? Side::outside : Side::inside;
}

std::vector<MapCurve> dissipative_boundary(const ServoGrid& grid) {
  const auto side = [&](const MapPoint& place) {
    return side_of_dissipation(servo_at(grid, place));
  };
  std::vector<Side> corners;
  corners.reserve(grid.size());
  for (const double y : grid.axes[0].values) {
    for (const double x : grid.axes[1].values) corners.push_back(side({x, y}));
  }
  return boundary_of_region(grid.axes[1], grid.axes[0], corners, side);
}

std::vector<MapCurve> hunting_boundary(const ServoGrid& grid,
                                       std::span<const double> growth_at_rest) {
  std::vector<Side> corners;
  corners.reserve(growth_at_rest.size());
  for (const double growth : growth_at_rest) corners.push_back(side_of(growth));
  return boundary_of_region(grid.axes[1], grid.axes[0], corners, [&](const MapPoint& point) {
    return side_of_hunting(servo_at(grid, point));
  });
}

}  // namespace gearlash
