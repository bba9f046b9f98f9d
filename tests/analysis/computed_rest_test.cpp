#include "analysis/energy/computed_rest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/extent.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/motion.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::computed_rest_test {
namespace {

/// At the load's shaft: gap 0.2 rad, frictions 0.3 and 0.1 N m, gain 10 N m/rad.
drive::ReducedDrive dry_drive() {
  drive::ReducedDrive drive;
  drive.motor = {.inertia = 1.0, .friction = {.viscous = 1.0, .coulomb = 0.3, .breakaway = 0.3}};
  drive.load = {.inertia = 2.0, .friction = {.viscous = 0.1, .coulomb = 0.05, .breakaway = 0.1}};
  drive.backlash = 0.2;
  drive.controller = drive::ProportionalDerivative{.proportional = 10.0, .derivative = 1.0};
  return drive;
}

void expect_near(const Bounds& range, double low, double high) {
  EXPECT_NEAR(range.low, low, 1e-9);
  EXPECT_NEAR(range.high, high, 1e-9);
}

TEST(ComputedRest, IsWhereFrictionHoldsTheTorqueOfTheError) {
  const auto rest = computed_rest(dry_drive());
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->certainty, Certainty::computed);
  expect_near(rest->load, -0.04, 0.04);   // both frictions, the faces together
  expect_near(rest->motor, -0.13, 0.13);  // at 0.14 the load would push the motor back
}

TEST(ComputedRest, OfAMotorsSensorAddsHalfTheGap) {
  drive::ReducedDrive drive = dry_drive();
  drive.sensing.load_share_of_position = 0.0;
  const auto rest = computed_rest(drive);
  ASSERT_TRUE(rest);
  expect_near(rest->motor, -0.04, 0.04);
  expect_near(rest->load, -0.14, 0.14);
}

TEST(ComputedRest, LeansOnTheLoadTorqueAndOnTheWeight) {
  drive::ReducedDrive drive = dry_drive();
  drive.motor.friction = drive.load.friction = {.viscous = 1.0};
  drive.load_torque = 2.0;
  EXPECT_NEAR(computed_rest(drive)->load.low, 0.2, 1e-9);
  EXPECT_NEAR(computed_rest(drive)->load.high, 0.2, 1e-9);
  EXPECT_NEAR(computed_rest(drive)->motor.low, 0.1, 1e-9);  // pushed on its backward face
  drive.gravity.stiffness = 10.0;
  EXPECT_NEAR(computed_rest(drive)->load.high, 0.1, 1e-9);
}

TEST(ComputedRest, OfCompliantFacesGivesWay) {
  drive::ReducedDrive drive = dry_drive();
  drive.motor.friction = drive.load.friction = {.viscous = 1.0};
  drive.load_torque = 2.0;
  drive.contact = drive::CompliantContact{.stiffness = 40.0};
  EXPECT_NEAR(computed_rest(drive)->load.low, 0.2, 1e-9);
  EXPECT_NEAR(computed_rest(drive)->motor.low, 0.2 - 0.1 - 2.0 / 40.0, 1e-9);
}

TEST(ComputedRest, OfAnIntegratorIsItsReading) {
  drive::ReducedDrive drive = dry_drive();
  drive.reference = 0.5;
  drive.controller = drive::ProportionalIntegralDerivative{.proportional = 10.0, .integral = 3.0};
  expect_near(computed_rest(drive)->load, 0.0, 0.0);
  drive.sensing.resolution = 0.02;  // 0.5 is a whole number of steps
  expect_near(computed_rest(drive)->load, -0.01, 0.01);
  drive.sensing.resolution = 0.03;  // is never read
  EXPECT_FALSE(computed_rest(drive));
}

/// The torque of a reading k holds while |10 k step| ≤ 0.4: k ≤ 1, and the load within half a step.
TEST(ComputedRest, OfAnEncoderEndsAtTheLastStepThatFrictionHolds) {
  drive::ReducedDrive drive = dry_drive();
  drive.sensing.resolution = 0.03;
  expect_near(computed_rest(drive)->load, -0.045, 0.045);
  drive.sampling = drive::Sampling{.period = 1e-3};
  expect_near(computed_rest(drive)->load, -0.045, 0.045);
}

/// A motor too weak for its friction stands anywhere.
TEST(ComputedRest, HasNoEndBelowFriction) {
  drive::ReducedDrive drive = dry_drive();
  drive.torque_limit = 0.2;
  EXPECT_FALSE(computed_rest(drive));
  drive.torque_limit = 0.5;
  expect_near(computed_rest(drive)->load, -0.04, 0.04);
}

Drive drawn_drive(SeededDraws& draws) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = draws.log_uniform(0.2, 2.0)};
  drive.motor.friction = {.viscous = draws.log_uniform(0.3, 3.0),
                          .coulomb = draws.uniform(0.01, 0.1)};
  drive.gearbox.backlash = draws.log_uniform(0.01, 0.3);
  drive.load = {.inertia = draws.log_uniform(0.2, 2.0)};
  drive.load.friction = {.viscous = draws.log_uniform(0.3, 3.0),
                         .coulomb = draws.uniform(0.0, 0.1)};
  if (draws.happens(0.3)) {
    drive.contact = CompliantContact{.stiffness = draws.log_uniform(10.0, 100.0),
                                     .damping = draws.log_uniform(0.1, 5.0)};
  }
  drive.sensor.position = draws.happens(0.5) ? SensorPlace::load : SensorPlace::motor;
  drive.controller.law = PID{.terms = PIDTerms::PD, .proportional = 1.0, .derivative = 0.5};
  if (draws.happens(0.5)) drive.sensor.encoder.resolution = draws.log_uniform(0.01, 0.2);
  if (draws.happens(0.5)) drive.motor.limit = draws.log_uniform(0.3, 3.0);
  if (draws.happens(0.5)) drive.sampling = Sampling{.period = 0.01, .delay = 0.005};
  drive.load_torque = draws.happens(0.5) ? draws.uniform(-0.2, 0.2) : 0.0;
  drive.reference = draws.happens(0.5) ? draws.uniform(-0.5, 0.5) : 0.0;
  return drive;
}

/// Every drive that stands still in the end stands within the computed ends.
TEST(PropertyComputedRest, HoldsEveryStandstill) {
  SeededDraws draws(2026);
  int standing = 0;
  int read = 0;
  for (int i = 0; i < 150; ++i) {
    const Drive drive = drawn_drive(draws);
    if (!faults(drive).empty()) continue;  // a continuous controller on the edge of a count
    const drive::ReducedDrive reduced = reduce(drive);
    const auto rest = computed_rest(reduced);
    constexpr double until = 150.0;
    const double start = draws.uniform(-1.0, 1.0);
    const Motion motion = simulate(drive, {.until = until, .start = Start{.load_position = start}});
    if (motion.stop() != MotionStop::reached_end) continue;
    Extent last;
    for (const double share : {0.8, 0.85, 0.9, 0.95, 1.0}) {
      last.include(motion.at(share * until).shafts.load_position);
    }
    if (last.width() > 0.0) continue;
    ASSERT_TRUE(rest) << "drive " << i;  // without equilibria nothing stands
    ++standing;
    read += reduced.sensing.resolution > 0.0 ? 1 : 0;
    const double error = last.low - std::get<double>(reduced.reference);
    EXPECT_GE(error, rest->load.low - 1e-7) << "drive " << i;
    EXPECT_LE(error, rest->load.high + 1e-7) << "drive " << i;
  }
  EXPECT_GT(standing, 50);
  EXPECT_GT(read, 15);
}

}  // namespace
}  // namespace gearlash::computed_rest_test
