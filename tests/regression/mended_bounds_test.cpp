// Bounds that version 0.2 stated without a condition of their proof.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "question/loop/energy/mesh_torque.hpp"

namespace gearlash::mended_bounds_test {
namespace {

Drive drive_of(const std::string& name) {
  return read_drive(std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "tests/regression/data" /
                    (name + ".toml"));
}

Ceiling ceiling(const Drive& drive) { return ceiling_of(reduce_settled(drive)); }

// ---- the mean mesh torque -----------------------------------------------------------------------

/// It was stated as at most 0.182 N m. The loop with the gap closed rests at 0.9 rad, where the
/// mesh carries 5 N m/rad · 0.4 rad = 2 N m for ever.
TEST(RegressionBound, MeanMeshTorqueOfAHangingLoadIncludesThatOfItsRest) {
  const Drive hanging = drive_of("hanging-load");
  const Answer answer = analyse(hanging, {.proofs = false, .ceiling = true});
  ASSERT_TRUE(answer.ceiling && answer.rest);
  EXPECT_NEAR(answer.rest->load.high, 0.4, 1e-6);  // from the reference
  ASSERT_TRUE(answer.ceiling->mesh_torque);
  Drive level = hanging;  // the same loop about 0
  level.reference.reset();
  level.load.gravity_angle = -0.5 * std::numbers::pi;
  const auto swinging = highest_mean_mesh_torque(reduce_settled(level));
  ASSERT_TRUE(swinging);
  EXPECT_NEAR(*answer.ceiling->mesh_torque, 2.0 + *swinging, 2e-3);
}

/// A load torque of 0.1 N m is all that the faces carry where nothing else acts.
TEST(RegressionBound, MeanMeshTorqueIncludesALoadTorque) {
  Drive drive = drive_of("hanging-load");
  drive.load.gravity = 0.0;
  const auto without = highest_mean_mesh_torque(reduce_settled(drive));
  drive.load_torque = 0.1;
  const auto with = highest_mean_mesh_torque(reduce_settled(drive));
  ASSERT_TRUE(without && with);
  EXPECT_NEAR(*with, *without + 0.1, 1e-9);
}

/// Motion at a limit of torque or current is not the linear one of its proof.
TEST(RegressionBound, MeanMeshTorqueIsOfMotionBelowTheLimit) {
  Drive drive = drive_of("hanging-load");
  const Answer unlimited = analyse(drive, {.proofs = false, .ceiling = true});
  drive.motor.limit = 40.0;
  const Answer limited = analyse(drive, {.proofs = false, .ceiling = true});
  ASSERT_TRUE(unlimited.ceiling->mesh_torque && limited.ceiling->mesh_torque);
  EXPECT_FALSE(unlimited.ceiling->is_below_limit);
  EXPECT_TRUE(limited.ceiling->is_below_limit);
}

/// The motor's speed jumps with the mesh torque: the gap's has no bound, and so the effort that
/// contains it.
TEST(RegressionBound, AMotorWithoutInertiaHasNoGapSpeed) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .friction = {.viscous = 0.01}};
  drive.gearbox = {.ratio = 1.0, .backlash = 2e-3};
  drive.load = {.inertia = 0.01, .friction = {.viscous = 0.1}};
  drive.sensor.position = SensorPlace::both;
  drive.controller.law = PID{.terms = PIDTerms::PD, .proportional = 20.0, .derivative = 0.5};
  for (const double inertia : {0.0, 0.01}) {
    drive.motor.inertia = inertia;
    ASSERT_TRUE(faults(drive).empty());
    const Ceiling found = ceiling(drive);
    EXPECT_TRUE(found.load);
    EXPECT_EQ(found.effort.has_value(), inertia > 0.0);
    EXPECT_EQ(found.effort_reason.empty(), inertia > 0.0);
  }
}

/// The motor carries the weight's torque and the reference's: at 0.4 rad from the reference 40 r −
/// 20 θ = 2 N m. Gains of a constant torque and of a constant reference bound it from above.
TEST(RegressionBound, WhetherTheLimitIsMetByAHangingLoadThatRestsElsewhere) {
  Drive drive = drive_of("hanging-load");
  drive.motor.limit = 2.0;
  EXPECT_EQ(ceiling(drive).meets_limit, false);
  drive.motor.limit = 40.0;
  EXPECT_EQ(ceiling(drive).meets_limit, true);
}

/// D_r r = 40 r lets the load move twice as fast as the ramp: the torque carried is not that of the
/// ramp's own rate.
TEST(RegressionBound, WhetherTheLimitIsMetAlongARampThatTheLoadDoesNotFollow) {
  Drive drive = drive_of("hanging-load");
  drive.load.gravity = 0.0;
  drive.reference = RampSignal{.rate = 1.0};
  drive.motor.limit = 3.5;  // F · rate is 2 N m; the motion needs 4 N m
  EXPECT_FALSE(ceiling(drive).meets_limit);
  std::get<StateSpaceController>(drive.controller.law).D = {20.0, -20.0, -4.0};
  EXPECT_TRUE(ceiling(drive).meets_limit);
  // 20 and −20 may stand for decimals of more digits, which are not opposite.
  drive.is_rounded = true;
  EXPECT_FALSE(ceiling(drive).meets_limit);
}

// ---- the gap's speed ----------------------------------------------------------------------------

/// It was stated as 0.03983 rad/s; with the acceleration at the end of each hold, before the torque
/// jumps, the formula gives 0.04405 rad/s, of which the proved bound is a little above.
TEST(RegressionBound, GapSpeedOfASampledTachometerWhoseTorqueJumps) {
  const Ceiling found = ceiling(drive_of("sampled-tachometer"));
  ASSERT_FALSE(found.terms.empty()) << found.reason;
  EXPECT_EQ(found.terms.back().source, "gap speed");
  EXPECT_GT(found.terms.back().size, 0.04405);
  EXPECT_LT(found.terms.back().size, 0.0444);
}

// ---- safe starts --------------------------------------------------------------------------------

/// They were stated as 0.17536 rad, with the gap at the start as a position of the motor alone; by
/// their definition, in floating point (scipy's eigenvalues, 2,000,000 steps), they are
/// 0.172417547.
TEST(RegressionBound, SafeStartsWithCompliantFaces) {
  const Ceiling found = ceiling(drive_of("compliant-faces"));
  EXPECT_EQ(found.meets_limit, true);
  ASSERT_TRUE(found.safe_starts);
  EXPECT_NEAR(found.safe_starts->position, 0.1724175, 1e-7);
  EXPECT_LT(found.safe_starts->position, 0.172417547);
}

}  // namespace
}  // namespace gearlash::mended_bounds_test
