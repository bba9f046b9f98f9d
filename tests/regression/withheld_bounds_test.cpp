// Bounds that were stated without a condition of their proof are withheld, with a reason; drives
// beside them that meet the condition keep theirs.
#include <gmock/gmock.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "analysis/ceiling/ceiling.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::withheld_bounds_test {
namespace {

using testing::HasSubstr;

Drive drive_of(const std::string& name) {
  return read_drive(std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "tests/regression/data" /
                    (name + ".toml"));
}

Ceiling ceiling(const Drive& drive) { return ceiling_of(reduce_settled(drive)); }

// ---- the mean mesh torque -----------------------------------------------------------------------

/// It was stated as at most 0.182 N m. The loop with the gap closed rests at 0.9 rad, where the
/// mesh carries 5 N m/rad · 0.4 rad = 2 N m for ever.
TEST(RegressionWithheld, MeanMeshTorqueOfAHangingLoadThatRestsElsewhere) {
  const Answer answer = analyse(drive_of("hanging-load"), {.proofs = false, .ceiling = true});
  ASSERT_TRUE(answer.ceiling && answer.rest);
  EXPECT_NEAR(answer.rest->load.high, 0.4, 1e-6);  // from the reference
  EXPECT_FALSE(answer.ceiling->mesh_torque);
  EXPECT_THAT(answer.ceiling->mesh_torque_reason, HasSubstr("by their difference alone"));
  EXPECT_TRUE(answer.ceiling->load);
}

TEST(RegressionWithheld, MeanMeshTorqueIsStatedWhereTheLoopRestsWithoutTorque) {
  const Drive hanging = drive_of("hanging-load");
  Drive error_driven = hanging;
  std::get<StateSpaceController>(error_driven.controller.law).D = {20.0, -20.0, -4.0};
  Drive at_zero = hanging;
  at_zero.reference.reset();
  at_zero.load.gravity_angle = -0.5 * std::numbers::pi;
  Drive level = hanging;
  level.load.gravity = 0.0;
  for (const Drive& drive : {error_driven, at_zero, level}) {
    const Answer answer = analyse(drive, {.proofs = false, .ceiling = true});
    EXPECT_TRUE(answer.ceiling->mesh_torque);
    EXPECT_EQ(answer.ceiling->mesh_torque_reason, "");
  }
}

/// D_r r = 40 r lets the load move twice as fast as the ramp: the torque carried is not that of the
/// ramp's own rate.
TEST(RegressionWithheld, WhetherTheLimitIsMetAlongARampThatTheLoadDoesNotFollow) {
  Drive drive = drive_of("hanging-load");
  drive.load.gravity = 0.0;
  drive.reference = RampSignal{.rate = 1.0};
  drive.motor.limit = 3.5;  // F · rate is 2 N m; the motion needs 4 N m
  EXPECT_FALSE(ceiling(drive).meets_limit);
  std::get<StateSpaceController>(drive.controller.law).D = {20.0, -20.0, -4.0};
  EXPECT_TRUE(ceiling(drive).meets_limit);
}

// ---- the gap's speed ----------------------------------------------------------------------------

/// It was stated as 0.03983 rad/s; with the acceleration at the end of each hold, before the torque
/// jumps, it is 0.04405 rad/s.
TEST(RegressionWithheld, CeilingsOfASampledTachometerWhoseTorqueJumps) {
  Drive drive = drive_of("sampled-tachometer");
  const Ceiling withheld = ceiling(drive);
  EXPECT_FALSE(withheld.load || withheld.motor || withheld.effort || withheld.safe_starts);
  EXPECT_THAT(withheld.reason, HasSubstr("a sampled tachometer"));
  EXPECT_THAT(withheld.reason, HasSubstr("the end of each hold"));

  drive.sensor.speed = ShaftName::load;
  EXPECT_FALSE(ceiling(drive).load);  // it reads the gap's speed as well

  drive.sampling->speed_by_differences = true;
  EXPECT_TRUE(ceiling(drive).load);

  drive.sampling.reset();
  EXPECT_TRUE(ceiling(drive).effort);
}

TEST(RegressionWithheld, CeilingsOfASampledTachometerAreStatedWhereTheTorqueDoesNotJump) {
  Drive drive = drive_of("sampled-tachometer");
  drive.sampling->period = 0.05;
  EXPECT_FALSE(ceiling(drive).load);
  Drive winding = drive;
  winding.motor.kind = ArmatureControl{1.0, 0.0, 1.0, 0.1};
  EXPECT_TRUE(ceiling(winding).load) << ceiling(winding).reason;
  drive.contact = CompliantContact{.stiffness = 20.0};  // all speeds are states
  EXPECT_TRUE(ceiling(drive).load) << ceiling(drive).reason;
}

// ---- safe starts --------------------------------------------------------------------------------

/// They were stated as 0.17536 rad, with the gap at the start as a position of the motor alone; by
/// their definition they are 0.17239 rad.
TEST(RegressionWithheld, SafeStartsWithCompliantFaces) {
  Drive drive = drive_of("compliant-faces");
  const Ceiling withheld = ceiling(drive);
  EXPECT_TRUE(withheld.load && withheld.effort);
  EXPECT_EQ(withheld.meets_limit, true);
  EXPECT_FALSE(withheld.safe_starts);
  EXPECT_THAT(withheld.safe_starts_reason, HasSubstr("compliant faces"));

  drive.gearbox.backlash = 0.0;  // one spring without a gap
  drive.load.friction.coulomb = 0.01;
  EXPECT_TRUE(ceiling(drive).safe_starts);
  EXPECT_EQ(ceiling(drive).safe_starts_reason, "");

  drive = drive_of("compliant-faces");
  drive.contact = RigidContact{};
  EXPECT_TRUE(ceiling(drive).safe_starts);
}

}  // namespace
}  // namespace gearlash::withheld_bounds_test
