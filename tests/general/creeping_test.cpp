// Standstills of a motion, and the law by which integral action moves a drive ever later.
#include "general/attractors/creeping.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace gearlash::drive {
namespace {

TEST(Standstills, AreThoseOfBothShafts) {
  // The load moves until 2, rests until 5, moves until 6 and rests until 9; the motor rests from 3
  // to 8, but for a move of 1e-12.
  const std::vector<Sample> load = {{0, 1}, {2, 0}, {3, 0}, {5, 0}, {6, 4}, {6, 4}, {9, 4}};
  const std::vector<Sample> motor = {{0, 0}, {3, 2}, {7, 2 + 1e-12}, {8, 2}, {9, 0}};
  const std::vector<Standstill> both = standstills(load, motor, 1e-9);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].from, 3.0);
  EXPECT_EQ(both[0].to, 5.0);
  EXPECT_EQ(both[0].load, 0.0);
  EXPECT_EQ(both[0].motor, 2.0);
  EXPECT_EQ(both[1].from, 6.0);
  EXPECT_EQ(both[1].to, 8.0);
  EXPECT_EQ(both[1].load, 4.0);
  EXPECT_EQ(duration_of(both), 4.0);
  EXPECT_EQ(duration_of(standstills(load, motor, 1e-13)), 0.0);
  EXPECT_EQ(duration_of(standstills(load, {{0, 0}, {9, 9}}, 1e-9)), 0.0);
}

/// Friction at rest is that of motion.
ReducedDrive drive_with_dry_friction() {
  ReducedDrive drive;
  drive.motor = {0.5, {.viscous = 0.1, .coulomb = 0.1, .breakaway = 0.1}};
  drive.load = {0.5, {.viscous = 0.1, .coulomb = 0.1, .breakaway = 0.1}};
  drive.backlash = 0.3;
  drive.controller = ProportionalDerivative{1.0, 0.0};
  return drive;
}

bool creeps(const ReducedDrive& drive, const std::vector<Standstill>& all, double until = 1000.0) {
  const SearchSetting setting = search_setting(drive);
  const Watch watch{.here = setting.start({}), .time = until};
  return is_creeping(all, watch, setting, {});
}

/// The load stands; the motor, which is measured, slips by 0.1, then by 0.001.
const std::vector<Standstill> of_motor = {
    {1.0, 2.0, 0.05, 0.1}, {3.0, 13.0, 0.05, 0.0}, {14.0, 1000.0, 0.05, 0.001}};

TEST(Creeping, IsEverLaterAndEverLess) {
  ReducedDrive drive = drive_with_dry_friction();
  drive.sensing.load_share_of_position = 0.0;
  EXPECT_TRUE(creeps(drive, of_motor));
  EXPECT_FALSE(creeps(drive, of_motor, 1000.5));                        // it moves by now
  EXPECT_FALSE(creeps(drive, {of_motor.begin() + 1, of_motor.end()}));  // of one slip no law
  std::vector<Standstill> other = of_motor;
  other[2].motor = 0.009;  // a slip of more than a tenth of the one before: it need not go on so
  other[0].motor = 0.08;
  EXPECT_FALSE(creeps(drive, other));
  other = of_motor;
  other[0].motor = 1.0;
  other[2].motor = 0.02;  // 0.05 · 0.3: not much less than the gap
  EXPECT_FALSE(creeps(drive, other));
  other = of_motor;
  other[1].to = 3.5;  // it stood for less than before
  EXPECT_FALSE(creeps(drive, other));
  other = of_motor;
  other[2].from = 995.0;
  EXPECT_FALSE(creeps(drive, other));
}

/// The load is measured: the motor pushes it forward, on its forward face.
TEST(Creeping, OfTheLoadNeedsTheMotorOnItsFace) {
  const auto on_face = [](const std::vector<double>& loads, double gap) {
    return std::vector<Standstill>{{1.0, 2.0, loads[0], loads[0] + gap},
                                   {3.0, 13.0, loads[1], loads[1] + gap},
                                   {14.0, 1000.0, loads[2], loads[2] + gap}};
  };
  ReducedDrive drive = drive_with_dry_friction();
  EXPECT_TRUE(creeps(drive, on_face({-0.1, -0.002, -0.001}, 0.15)));
  // It went too far: the motor will turn back, and cross the gap before it moves the load.
  EXPECT_FALSE(creeps(drive, on_face({-0.1, -0.0005, 0.0005}, 0.15)));
  drive.backlash = 0.0;
  drive.contact = CompliantContact{.stiffness = 1e3};
  EXPECT_TRUE(creeps(drive, on_face({-0.1, -1e-5, 1e-5}, 1e-6)));
}

/// A slip then has a size of its own: with integral action such drives always hunt.
TEST(Creeping, NeedsFrictionWithoutStiction) {
  for (Shaft ReducedDrive::*shaft : {&ReducedDrive::motor, &ReducedDrive::load}) {
    ReducedDrive drive = drive_with_dry_friction();
    (drive.*shaft).friction.breakaway = 0.2;
    drive.sensing.load_share_of_position = 0.0;
    EXPECT_FALSE(creeps(drive, of_motor));
  }
}

}  // namespace
}  // namespace gearlash::drive
