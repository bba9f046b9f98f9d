#include "question/map/hunting_end.hpp"

#include <limits>

#include "closed_form/growth_at_rest.hpp"
#include "question/map/side_bisection.hpp"

namespace gearlash {

double hunting_end(const std::function<NormalizedServo(double place)>& servo_at, double hunting,
                   double quiet) {
  const auto side_at = [&](double place) {
    return growth_at_rest(servo_dynamics(servo_at(place))) > 1.0 ? Side::inside : Side::outside;
  };
  constexpr int halvings = 60;
  return bisect_sides(side_at, hunting, quiet, halvings).place;
}

std::optional<double> limit_where_hunting_ends(Quantity quantity, double backlash) {
  switch (quantity) {
    case Quantity::motor_amplitude:
      return 0.5 * backlash;
    case Quantity::amplitude:
    case Quantity::frequency:
    case Quantity::impact_speed:
    case Quantity::motor_friction_loss:
    case Quantity::load_friction_loss:
    case Quantity::impact_loss:
      return 0.0;
    case Quantity::multiplier:
      return 1.0;
    case Quantity::period:
    case Quantity::separated_time:
      return std::numeric_limits<double>::infinity();
    default:
      return std::nullopt;
  }
}

}  // namespace gearlash
