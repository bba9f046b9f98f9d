// The line on which faces part: how far out a lasting motion can part, and what the scan says of
// it.
#include "closed_form/parting_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/traced_draws.hpp"
#include "closed_form/growth_at_rest.hpp"

namespace gearlash::parting_scan_test {
namespace {

NormalizedServo random_servo(SeededDraws& draws) {
  return {.damping = draws.log_uniform(0.02, 3.0),
          .inertia_ratio = draws.log_uniform(0.1, 10.0),
          .friction_ratio = draws.uniform(0.03, 0.97),
          .backlash = 0.3,
          .restitution = draws.uniform(0.05, 0.95)};
}

/// From far outside, every motion comes in. The bound is on what lasts: after forty times the
/// loop's slowest time constant nothing is left of the start.
TEST(PropertyPartingScan, NoLastingMotionPartsBeyondTheBound) {
  TracedDraws draws(2001);
  int parted = 0;
  double nearest = 0.0;
  for (int i = 0; i < 300; ++i) {
    const NormalizedServo servo = random_servo(draws);
    const ServoDynamics dynamics = servo_dynamics(servo);
    const double bound = largest_lasting_parting(dynamics);
    const Traversal start = first_arrival(dynamics, 3.0 * bound);
    if (start.outcome != Traversal::Outcome::arrived) continue;
    const double settling_time = 40.0 / std::min(servo.damping, 1.0 / (2.0 * servo.damping));
    Arrival arrival = start.next;
    double time = 0.0;
    for (int count = 0; count < 2000; ++count) {
      const Traversal next = traverse(dynamics, arrival, Derivative::not_wanted);
      if (next.outcome != Traversal::Outcome::arrived) break;
      arrival = next.next;
      time += next.duration;
      if (time < settling_time || !next.settled) continue;
      ++parted;
      nearest = std::max(nearest, std::abs(next.parting_amplitude) / bound);
      ASSERT_LE(std::abs(next.parting_amplitude), bound)
          << servo.damping << ' ' << servo.inertia_ratio << ' ' << servo.friction_ratio << ' '
          << servo.restitution;
    }
  }
  EXPECT_GT(parted, 10'000);
  EXPECT_GT(nearest, 0.3);  // it is a bound of the right order
}

TEST(PartingScan, GrowsWithTheBacklash) {
  NormalizedServo servo{.damping = 0.2, .inertia_ratio = 2.0, .friction_ratio = 0.1};
  servo.backlash = 0.3;
  const double one = largest_lasting_parting(servo_dynamics(servo));
  servo.backlash = 0.6;
  EXPECT_DOUBLE_EQ(largest_lasting_parting(servo_dynamics(servo)), 2.0 * one);
}

TEST(EdgePartingScan, WithoutDampingThereIsNoBound) {
  const NormalizedServo servo{.damping = 0.0,
                              .inertia_ratio = 2.0,
                              .friction_ratio = 0.5,
                              .backlash = 0.3,
                              .restitution = 0.3};
  EXPECT_TRUE(std::isinf(largest_lasting_parting(servo_dynamics(servo))));
}

/// The norms' two branches meet at ζ = 1.
TEST(EdgePartingScan, ContinuousAtCriticalDamping) {
  const auto bound = [](double damping) {
    return largest_lasting_parting(servo_dynamics({.damping = damping,
                                                   .inertia_ratio = 2.0,
                                                   .friction_ratio = 0.5,
                                                   .backlash = 0.3,
                                                   .restitution = 0.3}));
  };
  EXPECT_GE(bound(1.0), bound(1.0 - 1e-9) * (1.0 - 1e-6));  // for ζ ≥ 1 it is a bound of a norm
}

/// Amplitudes fall, growth falls with the amplitude, and the two that the cycle of this servo
/// (0.3573 rad of the load) lies between are told by its sign.
TEST(PartingScan, SamplesOfASettlingServo) {
  const NormalizedServo servo{.damping = 0.1,
                              .inertia_ratio = 2.0,
                              .friction_ratio = 0.1,
                              .backlash = 0.3,
                              .restitution = 0.3};
  const ServoDynamics dynamics = servo_dynamics(servo);
  TraversalBudget budget{dynamics};
  const PartingScan scan = scan_partings(budget, growth_at_rest(dynamics));
  ASSERT_GT(scan.samples.size(), 30U);
  int crossings = 0;
  for (std::size_t i = 1; i < scan.samples.size(); ++i) {
    const PartingSample& above = scan.samples[i - 1];
    const PartingSample& below = scan.samples[i];
    EXPECT_LT(below.amplitude, above.amplitude);
    if (!above.settles || !below.settles) continue;
    EXPECT_LT(below.next_amplitude, above.next_amplitude);
    crossings += (above.growth() < 0.0) != (below.growth() < 0.0);
  }
  EXPECT_EQ(crossings, 1);
  EXPECT_LT(scan.samples.front().growth(), 0.0);
}

}  // namespace
}  // namespace gearlash::parting_scan_test
