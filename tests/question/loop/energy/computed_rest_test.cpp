#include "question/loop/energy/computed_rest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/extent.hpp"
#include "base/seeded_draws.hpp"
#include "controllers.hpp"
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
  drive.controller = at_load(PID{.terms = PIDTerms::PD, .proportional = 10.0, .derivative = 1.0});
  return drive;
}

void expect_near(const Bounds& range, double low, double high) {
  EXPECT_NEAR(range.low, low, 1e-9);
  EXPECT_NEAR(range.high, high, 1e-9);
}

/// The only piece, if there is one; another one is a fault.
std::optional<RestPiece> rest_of(const drive::ReducedDrive& drive) {
  const std::vector<RestPiece> pieces = computed_rest(drive);
  EXPECT_LE(pieces.size(), 1U);
  if (pieces.empty()) return std::nullopt;
  return pieces.front();
}

TEST(ComputedRest, IsWhereFrictionHoldsTheTorqueOfTheError) {
  const auto rest = rest_of(dry_drive());
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->kind, RestKind::no_limit);
  expect_near(rest->load, -0.04, 0.04);   // both frictions, the faces together
  expect_near(rest->motor, -0.13, 0.13);  // at 0.14 the load would push the motor back
}

TEST(ComputedRest, OfAMotorsSensorAddsHalfTheGap) {
  drive::ReducedDrive drive = dry_drive();
  drive.sensing.load_share_of_position = 0.0;
  const auto rest = rest_of(drive);
  ASSERT_TRUE(rest);
  expect_near(rest->motor, -0.04, 0.04);
  expect_near(rest->load, -0.14, 0.14);
}

TEST(ComputedRest, LeansOnTheLoadTorqueAndOnTheWeight) {
  drive::ReducedDrive drive = dry_drive();
  drive.motor.friction = drive.load.friction = {.viscous = 1.0};
  drive.load_torque = 2.0;
  EXPECT_NEAR(rest_of(drive)->load.low, 0.2, 1e-9);
  EXPECT_NEAR(rest_of(drive)->load.high, 0.2, 1e-9);
  EXPECT_NEAR(rest_of(drive)->motor.low, 0.1, 1e-9);  // pushed on its backward face
  drive.gravity.stiffness = 10.0;
  EXPECT_NEAR(rest_of(drive)->load.high, 0.1, 1e-9);
}

TEST(ComputedRest, OfCompliantFacesGivesWay) {
  drive::ReducedDrive drive = dry_drive();
  drive.motor.friction = drive.load.friction = {.viscous = 1.0};
  drive.load_torque = 2.0;
  drive.contact = drive::CompliantContact{.stiffness = 40.0};
  EXPECT_NEAR(rest_of(drive)->load.low, 0.2, 1e-9);
  EXPECT_NEAR(rest_of(drive)->motor.low, 0.2 - 0.1 - 2.0 / 40.0, 1e-9);
}

TEST(ComputedRest, OfAnIntegratorIsItsReading) {
  drive::ReducedDrive drive = dry_drive();
  drive.reference = 0.5;
  drive.controller = at_load(PID{.terms = PIDTerms::PID, .proportional = 10.0, .integral = 3.0});
  expect_near(rest_of(drive)->load, 0.0, 0.0);
  drive.sensing.resolution = 0.02;  // 0.5 is a whole number of steps
  expect_near(rest_of(drive)->load, -0.01, 0.01);
  drive.sensing.resolution = 0.03;  // is never read
  EXPECT_FALSE(rest_of(drive));
}

TEST(ComputedRest, OfAnIntegratorIsItsReferenceWithoutRounding) {
  drive::ReducedDrive drive = dry_drive();
  for (int i = 0; i < 1000; ++i) {
    const double reference = 0.001 * i;
    drive.reference = reference;
    drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                   .proportional = 10.0 + reference,
                                   .integral = 3.0 / (1.0 + reference)});
    const auto rest = rest_of(drive);
    ASSERT_TRUE(rest) << reference;
    EXPECT_EQ(rest->load.low, 0.0) << reference;
    EXPECT_EQ(rest->load.high, 0.0) << reference;
  }
}

/// The torque of a reading k holds while |10 k step| ≤ 0.4: k ≤ 1, and the load within half a step.
TEST(ComputedRest, OfAnEncoderEndsAtTheLastStepThatFrictionHolds) {
  drive::ReducedDrive drive = dry_drive();
  drive.sensing.resolution = 0.03;
  expect_near(rest_of(drive)->load, -0.045, 0.045);
  drive.sampling = Sampling{.period = 1e-3};
  expect_near(rest_of(drive)->load, -0.045, 0.045);
}

/// A motor too weak for its friction stands anywhere.
TEST(ComputedRest, HasNoEndBelowFriction) {
  drive::ReducedDrive drive = dry_drive();
  drive.torque_limit = 0.2;
  EXPECT_FALSE(rest_of(drive));
  drive.torque_limit = 0.5;
  expect_near(rest_of(drive)->load, -0.04, 0.04);
}

/// An inverted load of 2 N m, and a motor of 2 N m whose friction is 0.1 N m: at a limit it holds
/// the weight of a load that leans by 1 ± 0.05 rad.
TEST(ComputedRest, IsInPiecesWhereTheTorqueIsLimited) {
  drive::ReducedDrive drive = dry_drive();
  drive.motor.friction = {.viscous = 0.1, .coulomb = 0.1, .breakaway = 0.1};
  drive.load.friction = {.viscous = 0.1};
  drive.gravity.stiffness = -2.0;
  drive.controller = at_load(PID{.terms = PIDTerms::PD, .proportional = 20.0, .derivative = 2.0});
  ASSERT_EQ(computed_rest(drive).size(), 1U);
  drive.torque_limit = 2.0;
  const std::vector<RestPiece> pieces = computed_rest(drive);
  ASSERT_EQ(pieces.size(), 3U);
  expect_near(pieces[0].load, -0.1 / 18.0, 0.1 / 18.0);
  EXPECT_EQ(pieces[1].kind, RestKind::torque_limit);
  EXPECT_EQ(pieces[1].side, 1.0);
  expect_near(pieces[1].load, -1.05, -0.95);
  EXPECT_EQ(pieces[2].side, -1.0);
  expect_near(pieces[2].load, 0.95, 1.05);
  // The current's limit does the same, though the controller may ask for more.
  drive.winding.torque_limit = 2.0;
  drive.torque_limit = 30.0;
  const std::vector<RestPiece> of_current = computed_rest(drive);
  ASSERT_EQ(of_current.size(), 3U);
  expect_near(of_current[1].load, -1.05, -0.95);
}

/// The motor holds −1 ± 0.3 N m of 2 N m ± 0.1 N m, and a spring of 4 N m/rad the rest. Its
/// integral winds up, or is held back.
TEST(ComputedRest, IsWhereAnIntegralWindsUpBehindALimit) {
  drive::ReducedDrive drive = dry_drive();
  drive.load_torque = 2.0;
  drive.gravity.stiffness = 4.0;
  drive.torque_limit = 1.0;
  for (const double tracking_time : {0.0, 0.2}) {
    drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                   .proportional = 10.0,
                                   .integral = 3.0,
                                   .tracking_time = tracking_time});
    for (const bool is_sampled : {false, true}) {
      drive.sampling.reset();
      if (is_sampled) drive.sampling = Sampling{.period = 0.01};
      ASSERT_TRUE(rest_of(drive));
      EXPECT_EQ(rest_of(drive)->kind, RestKind::torque_limit);
      EXPECT_EQ(rest_of(drive)->side, -1.0);
      expect_near(rest_of(drive)->load, 0.15, 0.35);
    }
  }
}

/// Gain 10 N m/rad, frictions 0.4 N m together: beyond the band it stands as far off as without it.
TEST(ComputedRest, OfADeadBandIsAPieceOfItsOwn) {
  drive::ReducedDrive drive = dry_drive();
  drive.error_shape = {.begins = 0.5, .ends = 0.5, .inner_gain = 0.0, .offset = -0.5};
  const std::vector<RestPiece> pieces = computed_rest(drive);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].kind, RestKind::dead_band);
  expect_near(pieces[0].load, -0.5, 0.5);
  EXPECT_EQ(pieces[1].kind, RestKind::no_limit);
  expect_near(pieces[1].load, -0.54, 0.54);
  drive.sensing.resolution = 0.3;  // the band has three readings, and friction holds no more
  const std::vector<RestPiece> read = computed_rest(drive);
  ASSERT_FALSE(read.empty());
  expect_near(read[0].load, -0.45, 0.45);
}

/// A relay of 1 N m moves what 0.4 N m hold, and one of 0.3 N m does not.
TEST(ComputedRest, OfARelayIsWhereItIsOff) {
  drive::ReducedDrive drive = dry_drive();
  drive.controller = at_load(PID{.proportional = 1.0});
  drive.error_shape = {.begins = 0.2,
                       .ends = 0.1,
                       .inner_gain = 0.0,
                       .outer_gain = 0.0,
                       .offset = 1.0,
                       .jumps = true};
  expect_near(rest_of(drive)->load, -0.2, 0.2);
  EXPECT_EQ(rest_of(drive)->kind, RestKind::dead_band);
  drive.error_shape.offset = 0.3;
  EXPECT_FALSE(rest_of(drive));  // anywhere
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
    const std::vector<RestPiece> rest = computed_rest(reduced);
    constexpr double until = 150.0;
    const double start = draws.uniform(-1.0, 1.0);
    const Motion motion = simulate(drive, {.until = until, .start = Start{.load_position = start}});
    if (motion.stop() != MotionStop::reached_end) continue;
    Extent last;
    for (const double share : {0.8, 0.85, 0.9, 0.95, 1.0}) {
      last.include(motion.at(share * until).shafts.load_position);
    }
    if (last.width() > 0.0) continue;
    ASSERT_FALSE(rest.empty()) << "drive " << i;  // without equilibria nothing stands
    ++standing;
    read += reduced.sensing.resolution > 0.0 ? 1 : 0;
    const double error = last.low - std::get<double>(reduced.reference);
    const bool is_held = std::any_of(rest.begin(), rest.end(), [&](const RestPiece& piece) {
      return piece.load.low - 1e-7 <= error && error <= piece.load.high + 1e-7;
    });
    EXPECT_TRUE(is_held) << "drive " << i << " at " << error;
  }
  EXPECT_GT(standing, 50);
  EXPECT_GT(read, 15);
}

}  // namespace
}  // namespace gearlash::computed_rest_test
