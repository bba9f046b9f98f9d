// The bound of the mesh torque's mean, beside motion that is followed.
#include "question/loop/energy/mesh_torque.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/drive_count.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/motion.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::mesh_torque_test {
namespace {

/// |∫N dt| of the load between two moments, by its momentum and friction.
double push(const Drive& drive, const Shafts& from, const Shafts& to) {
  const drive::Shaft load = reduce(drive).load;
  return std::abs(load.inertia * (to.load_speed - from.load_speed) +
                  load.friction.viscous * (to.load_position - from.load_position));
}

/// ∫|N| over the time: N has one sign while the faces stay together, and none while they are apart.
double mean_mesh_torque(const Drive& drive, const Motion& motion, double from) {
  double sum = 0.0;
  double time = from;
  Shafts last = motion.at(from).shafts;
  for (const MotionEvent& event : motion.events()) {
    if (event.time < from) continue;
    sum += push(drive, last, event.before);
    sum += push(drive, event.before, event.after);
    last = event.after;
    time = event.time;
  }
  return sum / (time - from);
}

TEST(PropertyMeshTorque, IsNotExceededByTheMeanOfMotionThatIsFollowed) {
  SeededDraws draws(20261129);
  int bounded = 0;
  double nearest = 0.0;
  for (int i = 0; i < 80; ++i) {
    Drive drive = normal_form(draws.log_uniform(0.05, 0.4), draws.log_uniform(0.2, 10.0),
                              draws.uniform(0.05, 0.5), 1.0, draws.one_of({0.0, 0.0, 0.4, 0.8}));
    const auto highest = highest_mean_mesh_torque(reduce(drive));
    if (!highest) continue;
    const Motion motion = simulate(drive, {.until = 600.0, .start = Start{.load_position = 1.0}});
    if (motion.stop() != MotionStop::reached_end || motion.events().size() < 20) continue;
    ++bounded;
    SCOPED_TRACE("drive " + std::to_string(i));
    const double mean = mean_mesh_torque(drive, motion, 300.0);
    EXPECT_LE(mean, *highest * (1.0 + 1e-6));
    nearest = std::max(nearest, mean / *highest);
  }
  std::printf("%d servos; the nearest came to %.3f of the bound\n", bounded, nearest);
  EXPECT_GT(bounded, 20);
  EXPECT_GT(nearest, 0.3);
}

/// A hanging or leaning load behind a controller of any gain of the reference, with a load torque:
/// (k_g + P) y = (D_r − P) r + w by statics, and the faces carry k_g y − w.
TEST(PropertyMeshTorque, IsNoLessThanThatOfRest) {
  SeededDraws draws(20261130);
  int bounded = 0;
  double nearest = 0.0;
  for (int i = 0; i < test::drive_count(60); ++i) {
    const double proportional = draws.log_uniform(5.0, 50.0);
    const double of_reference = proportional * draws.one_of({0.0, 0.5, 1.0, 2.0});
    const double stiffness = draws.either_sign(0.1, 4.0);
    Drive drive;
    drive.motor = {.kind = TorqueControl{}, .inertia = 0.2, .friction = {.viscous = 1.0}};
    drive.load = {.inertia = draws.log_uniform(0.1, 2.0),
                  .friction = {.viscous = draws.log_uniform(0.2, 2.0)}};
    drive.gearbox = {.ratio = 1.0, .backlash = draws.log_uniform(1e-4, 0.05)};
    StateSpaceController controller{.gain = 1.0};
    controller.D = {of_reference, -proportional, -draws.log_uniform(1.0, 6.0)};
    drive.controller.law = controller;
    drive::ReducedDrive reduced = reduce(drive);
    const double reference = draws.uniform(-1.0, 1.0);
    const double load_torque = draws.one_of({0.0, 1.0}) * draws.uniform(-2.0, 2.0);
    reduced.reference = reference;
    reduced.load_torque = load_torque;
    reduced.gravity.stiffness = stiffness;
    const auto highest = highest_mean_mesh_torque(reduced);
    if (!highest) continue;
    ++bounded;
    SCOPED_TRACE("drive " + std::to_string(i));
    const double position =
        ((of_reference - proportional) * reference + load_torque) / (stiffness + proportional);
    const double carried = std::abs(stiffness * position - load_torque);
    EXPECT_GE(*highest, carried);
    nearest = std::max(nearest, carried / *highest);
  }
  EXPECT_GT(bounded, 30);
  EXPECT_GT(nearest, 0.9);
}

TEST(EdgeMeshTorque, HasNoBoundWhereTheTheoremSaysNothing) {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3);
  EXPECT_TRUE(highest_mean_mesh_torque(reduce(drive)));
  drive.load_torque = SineSignal{.amplitude = 0.1, .frequency = 1.0};
  EXPECT_FALSE(highest_mean_mesh_torque(reduce(drive)));
  drive.load_torque.reset();
  drive::ReducedDrive with_dead_band = reduce(drive);
  with_dead_band.error_shape = {.begins = 0.01, .ends = 0.01, .inner_gain = 0.0, .offset = -0.01};
  EXPECT_FALSE(highest_mean_mesh_torque(with_dead_band));
  drive.contact = CompliantContact{.stiffness = 100.0};
  EXPECT_FALSE(highest_mean_mesh_torque(reduce(drive)));
  drive.contact = RigidContact{};
  drive.servo->friction_ratio = 0.0;  // Im H does not vanish as fast as Re H grows
  EXPECT_TRUE(highest_mean_mesh_torque(reduce(drive)));
  drive.servo->damping = 0.0;
  EXPECT_FALSE(highest_mean_mesh_torque(reduce(drive)));
}

}  // namespace
}  // namespace gearlash::mesh_torque_test
