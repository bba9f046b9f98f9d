// The return map with bounces, its exact derivative against differences.
#include "closed_form/return_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/traced_draws.hpp"

namespace gearlash::return_map_test {
namespace {

TEST(PropertyReturnMap, DerivativeAgainstCentralDifferences) {
  TracedDraws draws(901);
  int compared = 0;
  for (int i = 0; i < 600 && !testing::Test::HasFailure(); ++i) {
    const NormalizedServo servo{.damping = draws.uniform(0.02, 0.9),
                                .inertia_ratio = draws.log_uniform(0.1, 10.0),
                                .friction_ratio = draws.uniform(0.05, 0.95),
                                .backlash = 0.3,
                                .restitution = draws.uniform(0.1, 1.0)};
    const ServoDynamics dynamics = servo_dynamics(servo);
    const Arrival arrival{draws.uniform(-0.5, 0.5), draws.uniform(-0.5, 0.5),
                          draws.uniform(0.05, 0.5)};
    const Traversal traversal = traverse(dynamics, arrival);
    if (traversal.outcome != Traversal::Outcome::arrived) continue;
    constexpr double step = 1e-6;
    Eigen::Matrix3d differences;
    bool comparable = traversal.impacts < 60;
    for (Eigen::Index column = 0; column < 3; ++column) {
      Arrival above = arrival;
      Arrival below = arrival;
      above(column) += step;
      below(column) -= step;
      const Traversal up = traverse(dynamics, above);
      const Traversal down = traverse(dynamics, below);
      comparable = comparable && up.outcome == Traversal::Outcome::arrived &&
                   down.outcome == Traversal::Outcome::arrived && up.impacts == traversal.impacts &&
                   down.impacts == traversal.impacts && up.settled == traversal.settled &&
                   down.settled == traversal.settled;
      if (!comparable) break;
      differences.col(column) = (up.next - down.next) / (2.0 * step);
    }
    if (!comparable) continue;  // a graze nearby: the map has a kink or a square root there
    ++compared;
    // The second difference would be step² times the third derivative, which a late soft impact
    // raises: 1e-4 of the derivative's own size is left for it.
    const double size = std::max(1.0, differences.cwiseAbs().maxCoeff());
    ASSERT_LE((differences - traversal.slope).cwiseAbs().maxCoeff(), 1e-4 * size)
        << "damping " << servo.damping << " inertia_ratio " << servo.inertia_ratio
        << " friction_ratio " << servo.friction_ratio << " restitution " << servo.restitution
        << " arrival " << arrival.transpose() << " settled " << traversal.settled << " impacts "
        << traversal.impacts << "\n"
        << differences << "\nagainst\n"
        << traversal.slope;
  }
  EXPECT_GT(compared, 200);
}

TEST(PropertyReturnMap, HomogeneousOfDegreeOneInArrivalAndBacklash) {
  SeededDraws draws(902);
  for (int i = 0; i < 200; ++i) {
    NormalizedServo servo{.damping = draws.uniform(0.02, 0.9),
                          .inertia_ratio = draws.log_uniform(0.1, 10.0),
                          .friction_ratio = draws.uniform(0.05, 0.95),
                          .backlash = 0.3,
                          .restitution = draws.uniform(0.1, 0.9)};
    const Arrival arrival{draws.uniform(-0.5, 0.5), draws.uniform(-0.5, 0.5),
                          draws.uniform(0.05, 0.5)};
    const Traversal one = traverse(servo_dynamics(servo), arrival);
    servo.backlash *= 4.0;
    const Traversal other = traverse(servo_dynamics(servo), 4.0 * arrival);
    ASSERT_EQ(one.outcome, other.outcome);
    ASSERT_EQ(one.duration, other.duration);
    ASSERT_EQ(one.impacts, other.impacts);
    ASSERT_EQ(4.0 * one.next, other.next);
    ASSERT_EQ(one.slope, other.slope);
  }
}

}  // namespace
}  // namespace gearlash::return_map_test
