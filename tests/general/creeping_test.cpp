// Standstills of a motion, and the law by which integral action moves a drive ever later.
#include "general/attractors/creeping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "controllers.hpp"

namespace gearlash::drive::creeping_test {
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

/// Friction at rest is that of motion, and the error is integrated.
ReducedDrive drive_with_dry_friction() {
  ReducedDrive drive;
  drive.motor = {0.5, {.viscous = 0.1, .coulomb = 0.1, .breakaway = 0.1}};
  drive.load = {0.5, {.viscous = 0.1, .coulomb = 0.1, .breakaway = 0.1}};
  drive.backlash = 0.3;
  drive.controller = at_load(PID{PIDTerms::PID, 1.0, 0.01, 0.0, 0.0});
  return drive;
}

/// A place at which the measured shaft pauses.
struct Pausing {
  double from;
  double to;
  double at;
};

const std::vector<Pausing> ever_later = {
    {10.0, 20.0, 0.1}, {30.0, 130.0, 0.01}, {140.0, 10'000.0, 0.001}};

/// The shaft that is not measured goes to and fro meanwhile.
bool creeps(const ReducedDrive& drive, const std::vector<Pausing>& all) {
  std::vector<Sample> pausing;
  std::vector<Sample> other;
  for (const Pausing& one : all) {
    pausing.push_back({one.from, one.at});
    pausing.push_back({one.to, one.at});
    other.push_back({one.from, -0.15});
    other.push_back({one.to, 0.15});
  }
  const SearchSetting setting = search_setting(drive);
  const bool is_of_load = drive.sensing.load_share_of_position == 1.0;
  const Watch watch{.here = setting.start({}),
                    .load = is_of_load ? pausing : other,
                    .motor = is_of_load ? other : pausing};
  return creeping(watch, setting, {}).has_value();
}

TEST(Creeping, IsEverLaterAndNearerByOneRatio) {
  for (const double share_of_load : {0.0, 1.0}) {
    ReducedDrive drive = drive_with_dry_friction();
    drive.sensing.load_share_of_position = share_of_load;
    EXPECT_TRUE(creeps(drive, ever_later));
    EXPECT_FALSE(creeps(drive, {ever_later.begin() + 1, ever_later.end()}));  // two are no law
    std::vector<Pausing> other = ever_later;
    other[2].at = -0.001;  // on the other side: another ratio
    EXPECT_FALSE(creeps(drive, other));
    other[1].at = -0.01;  // from side to side
    other[2].at = 0.001;
    EXPECT_TRUE(creeps(drive, other));
    other = ever_later;
    other[2].at = 0.0011;  // may end at 0.0001
    EXPECT_FALSE(creeps(drive, other));
    other = ever_later;
    for (Pausing& one : other) one.at *= 4.0;  // from beyond the gap, of 0.3
    EXPECT_FALSE(creeps(drive, other));
    other = ever_later;
    other[1].to = 35.0;  // for less than before
    EXPECT_FALSE(creeps(drive, other));
    other = ever_later;
    other[2].from = 9950.0;
    EXPECT_FALSE(creeps(drive, other));
  }
}

/// A slip then has a size of its own: with integral action such drives always hunt.
TEST(Creeping, NeedsFrictionWithoutStiction) {
  for (Shaft ReducedDrive::*shaft : {&ReducedDrive::motor, &ReducedDrive::load}) {
    ReducedDrive drive = drive_with_dry_friction();
    (drive.*shaft).friction.breakaway = 0.2;
    EXPECT_FALSE(creeps(drive, ever_later));
  }
}

/// Samples at bounces look like pauses.
TEST(Creeping, NeedsDryFriction) {
  ReducedDrive drive = drive_with_dry_friction();
  drive.motor.friction = {.viscous = 0.1};
  EXPECT_TRUE(creeps(drive, ever_later));
  drive.load.friction = {.viscous = 0.1};
  EXPECT_FALSE(creeps(drive, ever_later));
}

/// The load slides on within the gap, or stands as long as the motor does.
TEST(Creeping, NeedsBothShaftsToStandWhereFrictionHoldsTheOtherAlone) {
  ReducedDrive drive = drive_with_dry_friction();
  drive.load.friction = {.viscous = 0.1};
  EXPECT_FALSE(creeps(drive, ever_later));
  const SearchSetting setting = search_setting(drive);
  Watch watch{.here = setting.start({})};
  for (const Pausing& one : ever_later) {
    for (const double time : {one.from, one.to}) {
      watch.load.push_back({time, one.at});
      watch.motor.push_back({time, one.at + 0.15});
    }
  }
  EXPECT_TRUE(creeping(watch, setting, {}));
}

TEST(Creeping, NeedsIntegralActionOfTheErrorItself) {
  ReducedDrive drive = drive_with_dry_friction();
  drive.controller = at_load(PID{.proportional = 1.0});
  EXPECT_FALSE(creeps(drive, ever_later));
  drive = drive_with_dry_friction();
  drive.sensing.resolution = 1.0;  // larger than every error
  EXPECT_FALSE(creeps(drive, ever_later));
  drive = drive_with_dry_friction();
  drive.error_shape = {.begins = 1e-6, .ends = 1e-6, .inner_gain = 0.0, .offset = -1e-6};
  EXPECT_FALSE(creeps(drive, ever_later));
}

TEST(Creeping, NeedsPausesLongerThanASwing) {
  std::vector<Pausing> faster = ever_later;
  for (Pausing& one : faster) {
    one.from *= 0.1;
    one.to *= 0.1;
  }
  EXPECT_FALSE(creeps(drive_with_dry_friction(), faster));
}

TEST(StandsForLong, OfADriveWithoutStictionThatStandsByNow) {
  ReducedDrive drive = drive_with_dry_friction();
  const std::vector<Standstill> all = {{1.0, 10'000.0, 0.0, 0.0}};
  const auto stands = [&](double until) {
    const SearchSetting setting = search_setting(drive);
    return stands_for_long(all, {.here = setting.start({}), .time = until}, setting, {});
  };
  EXPECT_TRUE(stands(10'000.0));
  EXPECT_FALSE(stands(10'001.0));  // it moves
  drive.motor.friction = drive.load.friction = {.viscous = 0.1};
  EXPECT_FALSE(stands(10'000.0));
  drive = drive_with_dry_friction();
  drive.load.friction.breakaway = 0.2;
  EXPECT_FALSE(stands(10'000.0));
}

}  // namespace
}  // namespace gearlash::drive::creeping_test
