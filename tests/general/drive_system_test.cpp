// Drives beside published results and closed forms.

#include <gtest/gtest.h>

#include <numbers>

#include "base/correct_digits.hpp"
#include "closed_form/trajectory.hpp"
#include "drives.hpp"

namespace gearlash::drive::drive_system_test {
namespace {

// ---- Modelica's Rotational.Examples.Backlash ----------------------------------------------------

/// Inertia 5 kg m² against a wall behind c = 20000 N m/rad, d = 50 N m s/rad and a gap of π/4; from
/// φ = π/2 at rest. The wall is a load that nothing moves.
ReducedDrive modelica_backlash(ContactDamping law) {
  ReducedDrive drive;
  drive.motor.inertia = 5.0;
  drive.load.inertia = 1e12;
  drive.backlash = 0.25 * std::numbers::pi;
  drive.contact = CompliantContact{.stiffness = 20000.0, .damping = 50.0, .law = law};
  return drive;
}

/// The events that begin or end contact.
std::vector<hybrid::Event> partings_and_meetings(const ReducedDrive& drive,
                                                 const hybrid::Trajectory& motion) {
  const DriveSystem built = drive_system(drive);
  std::vector<hybrid::Event> found;
  for (const hybrid::Event& event : motion.events()) {
    const std::string& name = built.system.mode(event.mode).transitions[event.transition].name;
    if (name == "faces let go" || name.rfind("faces meet", 0) == 0) found.push_back(event);
  }
  return found;
}

/// The reference file carries some 1e-5; the exact numbers beside it are of 50-digit arithmetic.
TEST(OracleDriveSystem, CompliantBacklashIsModelicas) {
  const ReducedDrive drive = modelica_backlash(ContactDamping::limited);
  const auto motion = moved(drive, {.motor_position = 0.5 * std::numbers::pi}, 0.1);
  const auto events = partings_and_meetings(drive, motion);
  ASSERT_GE(events.size(), 3U);
  // Published.
  expect_digits("release_time", events[0].time, 0.0236592180, 7.0);
  expect_digits("release_position", events[0].before[motor_position], 0.5581902852, 6.2);
  expect_digits("release_speed", events[0].before[motor_speed], -66.1964949764, 5.7);
  expect_digits("recontact_time", events[1].time, 0.0380238663, 6.2);
  expect_digits("next_speed", events[2].before[motor_speed], 52.8937413834, 6.3);
  // Exact.
  expect_digits("exact_release_time", events[0].time, 0.0236592158, 8.7);
  expect_digits("exact_release_position", events[0].before[motor_position], 0.5581906266, 10.0);
  expect_digits("exact_release_speed", events[0].before[motor_speed], -66.1966179775, 11.0);
  expect_digits("exact_recontact_time", events[1].time, 0.0380238426, 9.1);
  expect_digits("exact_next_speed", events[2].before[motor_speed], 52.8937186, 9.9);
}

TEST(OracleDriveSystem, WithFullDampingTorqueJumps) {
  const ReducedDrive drive = modelica_backlash(ContactDamping::full);
  const auto motion = moved(drive, {.motor_position = 0.5 * std::numbers::pi}, 0.1);
  const auto events = partings_and_meetings(drive, motion);
  ASSERT_GE(events.size(), 3U);
  EXPECT_NEAR(events[2].before[motor_speed], 52.249860, 5e-6);
}

// ---- the servo ----------------------------------------------------------------------------------

TEST(OracleDriveSystem, TheRigidServoIsTheClosedForm) {
  for (const double restitution : {0.0, 1e-9, 1e-6, 1e-3, 0.01, 0.4}) {
    SCOPED_TRACE(restitution);
    const NormalizedServo servo{.damping = 0.19,
                                .inertia_ratio = 2.0,
                                .friction_ratio = 0.1,
                                .backlash = 0.3,
                                .restitution = restitution};
    ReducedDrive drive = servo_drive(0.19, 2.0, 0.1, restitution);
    drive.reference = 1.0;
    constexpr double until = 30.0;
    const Trajectory exact = simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = until});
    const auto motion = moved(drive, {.motor_position = 0.15}, until);
    const ServoState wanted = exact.at(until);
    const hybrid::Vector found = motion.end().numbers;
    EXPECT_NEAR(found[motor_position], wanted.motor_position, 1e-11);
    EXPECT_NEAR(found[motor_speed], wanted.motor_speed, 1e-11);
    EXPECT_NEAR(found[load_position], wanted.load_position, 1e-11);
    EXPECT_NEAR(found[load_speed], wanted.load_speed, 1e-11);
  }
}

TEST(EdgeDriveSystem, FaultsAreToldAllAtOnce) {
  ReducedDrive drive = modelica_backlash(ContactDamping::full);
  drive.backlash = -1.0;
  drive.load.inertia = 0.0;
  drive.controller.direct.clear();
  try {
    drive_system(drive);
    FAIL();
  } catch (const InvalidInput& fault) {
    EXPECT_EQ(fault.faults().size(), 3U) << fault.what();
  }
  ReducedDrive without_gap = modelica_backlash(ContactDamping::full);
  without_gap.backlash = 0.0;
  EXPECT_TRUE(faults(without_gap).empty());
  without_gap.contact = RigidContact{};
  EXPECT_EQ(faults(without_gap).size(), 1U);
}

}  // namespace
}  // namespace gearlash::drive::drive_system_test
