// A project whose optimiser asks how much backlash a servo may have, and what its size depends on.
#include <cmath>
#include <cstdio>

#include "analysis/design/feasible_values.hpp"
#include "closed_form/cycle_sensitivity.hpp"

int main() {
  using namespace gearlash;
  const NormalizedServo servo{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};
  Target target;
  target.amplitude.high = 0.1;  // rad
  const FeasibleValues backlash =
      feasible_values(ChangeableDrive(normal_form(0.19, 2.0, 0.1, 0.3)), "backlash", target);
  const CycleSensitivity sensitivity = cycle_sensitivity(servo);
  std::printf("backlash at most %.6f rad; size %.6f rad, %.4f more for 1 more damping\n",
              backlash.nearest(), sensitivity.size.value, sensitivity.size.slope.damping);
  return std::abs(backlash.nearest() * 0.241611108 / 0.3 - 0.1) < 1e-9 ? 0 : 1;
}
