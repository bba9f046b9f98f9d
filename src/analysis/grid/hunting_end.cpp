#include "analysis/grid/hunting_end.hpp"

#include "analysis/grid/side_bisection.hpp"
#include "closed_form/growth_at_rest.hpp"

namespace gearlash {

double hunting_end(const std::function<NormalizedServo(double place)>& servo_at, double hunting,
                   double quiet) {
  const auto side_at = [&](double place) {
    return growth_at_rest(servo_dynamics(servo_at(place))) > 1.0 ? Side::inside : Side::outside;
  };
  constexpr int halvings = 60;
  return bisect_sides(side_at, hunting, quiet, halvings).place;
}

}  // namespace gearlash
