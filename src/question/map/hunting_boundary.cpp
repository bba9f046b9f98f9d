#include "question/map/hunting_boundary.hpp"

#include <array>
#include <cmath>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/energy_balance.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "model/proportional_servo.hpp"
#include "question/map/side_bisection.hpp"

namespace gearlash {
namespace {

Side side_of(double growth_at_rest) {
  if (std::isnan(growth_at_rest)) return Side::unknown;
  return growth_at_rest > 1.0 ? Side::inside : Side::outside;
}

}  // namespace

std::optional<NormalizedServo> servo_at(const Family& family, const MapPoint& place) {
  const std::optional<ProportionalServo> servo = family.servo_at(std::array{place.y, place.x});
  return servo ? std::optional(servo->servo) : std::nullopt;
}

Side side_of_hunting(const std::optional<NormalizedServo>& servo) {
  return servo ? side_of(growth_at_rest(servo_dynamics(*servo))) : Side::unknown;
}

Side side_of_dissipation(const std::optional<NormalizedServo>& servo) {
  if (!servo) return Side::unknown;
  return is_dissipative(*servo) ? Side::outside : Side::inside;
}

std::vector<MapCurve> dissipative_boundary(const Grid& grid, Progress& progress) {
  const Family family(grid);
  const auto side = [&](const MapPoint& place) {
    return side_of_dissipation(servo_at(family, place));
  };
  std::vector<Side> corners;
  corners.reserve(grid.size());
  for (const double y : grid.axes[0].values) {
    for (const double x : grid.axes[1].values) corners.push_back(side({x, y}));
  }
  return boundary_of_region(grid.axes[1], grid.axes[0], corners, side, {}, progress);
}

std::vector<MapCurve> hunting_boundary(const Grid& grid, std::span<const double> growth_at_rest,
                                       Progress& progress) {
  const Family family(grid);
  const std::vector<Side> corners =
      of_each(growth_at_rest, [](double growth) { return side_of(growth); });
  const auto side = [&](const MapPoint& place) { return side_of_hunting(servo_at(family, place)); };
  return boundary_of_region(grid.axes[1], grid.axes[0], corners, side, {}, progress);
}

double hunting_end(const std::function<NormalizedServo(double place)>& servo_at, double hunting,
                   double quiet) {
  const auto side_at = [&](double place) { return side_of_hunting(servo_at(place)); };
  constexpr int halvings = 60;
  return bisect_sides(side_at, hunting, quiet, halvings).place;
}

std::optional<double> limit_where_hunting_ends(Quantity quantity, double backlash) {
  switch (quantity) {
    case Quantity::motor_amplitude:
      return 0.5 * backlash;
    case Quantity::multiplier:
      return 1.0;
    case Quantity::period:
    case Quantity::separated_time:
      return infinity;
    case Quantity::center:
    case Quantity::engaged_time:
    case Quantity::residual:
      return std::nullopt;
    default:
      return info_of(quantity).scope == QuantityScope::motion ? std::optional(0.0) : std::nullopt;
  }
}

}  // namespace gearlash
