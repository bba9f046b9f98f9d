#include "gearlash/chart/hunting_end.hpp"

#include "gearlash/cycle/growth_at_rest.hpp"

namespace gearlash {

double hunting_end(const std::function<NormalizedServo(double place)>& servo_at, double hunting,
                   double quiet) {
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (hunting + quiet);
    const bool hunts = growth_at_rest(servo_dynamics(servo_at(middle))) > 1.0;
    (hunts ? hunting : quiet) = middle;
  }
  return hunting;
}

}  // namespace gearlash
