// Shafts with dry friction on both sides of a rigid gap: they stop as one, and one is drawn away.
#include <gtest/gtest.h>

#include <cmath>

#include "controllers.hpp"
#include "drives.hpp"

namespace gearlash::drive::dry_contact_test {
namespace {

/// J 2 and 1 kg m²; dry friction 0.2 and 0.1 N m that breaks away at 0.5 and 0.3 N m.
ReducedDrive dry_pair() {
  ReducedDrive drive;
  drive.motor = {2.0, {.coulomb = 0.2, .breakaway = 0.5}};
  drive.load = {1.0, {.coulomb = 0.1, .breakaway = 0.3}};
  drive.backlash = 0.1;
  return drive;
}

/// On a spring of 1 N m/rad the motor brakes the load, as one of 3 kg m² that swings about −0.3
/// rad, where spring and sliding friction balance. Where they stop they stay while the spring's
/// torque is within both breakaways, 0.8 N m; beyond, they swing back about 0.3 rad.
TEST(OracleDryContact, ShaftsThatStopTogetherStayWithinBothBreakaways) {
  ReducedDrive drive = dry_pair();
  drive.controller = at_load(PID{.proportional = 1.0});
  const double rate = std::sqrt(1.0 / 3.0);
  constexpr double first = 0.1;  // rad, of the load
  for (const double side : {1.0, -1.0}) {
    for (const double last : {0.4, 0.7, 1.0}) {
      const double amplitude = last + 0.3;
      const double speed = rate * std::sqrt(amplitude * amplitude - (first + 0.3) * (first + 0.3));
      const ShaftStates start = {side * (first - 0.5 * drive.backlash), side * speed, side * first,
                                 side * speed};
      const double stop = std::acos((first + 0.3) / amplitude) / rate;
      const auto motion = moved(drive, start, stop + 1.0);
      EXPECT_EQ(motion.stop_reason(), hybrid::StopReason::reached_end);
      EXPECT_NEAR(motion.at(stop).numbers[load_position], side * last, 1e-13);
      const hybrid::Vector end = motion.end().numbers;
      const bool stays = last < 0.8;
      const double wanted = stays ? last : 0.3 + (last - 0.3) * std::cos(rate);
      EXPECT_NEAR(end[load_position], side * wanted, 1e-13) << last;
      EXPECT_NEAR(end[motor_position], side * (wanted - 0.5 * drive.backlash), 1e-13) << last;
      EXPECT_EQ(end[load_speed] == 0.0, stays) << last;
    }
  }
}

/// 0.6 N m on the load break it away, not both shafts: it crosses the gap under 0.5 N m, and the
/// motor, which 0.7 N m would move, stays. Likewise backward.
TEST(OracleDryContact, ALoadIsDrawnOffAMotorThatSticks) {
  ReducedDrive drive = dry_pair();
  drive.sensing.load_share_of_position = 0.0;
  for (const double side : {1.0, -1.0}) {
    drive.load_torque = side * 0.6;
    const double half_gap = 0.5 * drive.backlash;
    const auto motion = moved(drive, {side * half_gap, 0.0, 0.0, 0.0}, 0.6);
    for (const double time : {0.2, 0.6}) {  // it meets the other face at √(2 · 0.1/0.5) = 0.632 s
      const hybrid::Vector numbers = motion.at(time).numbers;
      EXPECT_EQ(numbers[motor_position], side * half_gap);
      EXPECT_NEAR(numbers[load_position], side * 0.25 * time * time, 1e-14) << time;
    }
    drive.load_torque = side * 0.25;  // within its breakaway
    EXPECT_EQ(moved(drive, {side * half_gap, 0.0, 0.0, 0.0}, 0.6).end().numbers[load_position],
              0.0);
  }
}

/// Newton's method knows a speed of 0 to rounding only, which would move a shaft that stands for
/// hours.
TEST(PropertyDryContact, AShaftThatStandsIsMovedByNoSpeed) {
  const DriveSystem built = drive_system(dry_pair());
  std::size_t standing = 0;
  for (std::size_t i = 0; i < built.system.mode_count(); ++i) {
    const DriveMode mode = built.modes.mode(i);
    const bool of_motor = mode.motor == FrictionState::sticking;
    const bool of_load = mode.load == FrictionState::sticking;
    const bool apart = mode.contact == ContactState::apart;
    const hybrid::AffineFlow& flow = built.system.mode(i).flow;
    EXPECT_EQ(flow.matrix.row(motor_position).isZero(0.0), apart ? of_motor : of_motor || of_load);
    EXPECT_EQ(flow.matrix.row(load_position).isZero(0.0), apart ? of_load : of_motor || of_load);
    standing += of_motor && of_load ? 1 : 0;
  }
  EXPECT_EQ(standing, 3U);  // apart, and on either face
}

}  // namespace
}  // namespace gearlash::drive::dry_contact_test
