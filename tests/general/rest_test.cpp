// Rest is recognised where rounding makes events of it.
#include <gtest/gtest.h>

#include "drives.hpp"
#include "general/attractors/cycle_closing.hpp"
#include "general/attractors/motion_watch.hpp"

namespace gearlash::drive::rest_test {
namespace {

using hybrid::StopReason;

/// A servo on whose motor the loop's torque is all that its dry friction holds.
constexpr double edge = 0.125;

ReducedDrive held_servo() {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.motor.friction.coulomb = drive.motor.friction.breakaway = edge;
  drive.sensing.load_share_of_position = 0.0;
  return drive;
}

Watch watch_of(const SearchSetting& setting, const ShaftStates& shafts) {
  Watch watch;
  watch.here = setting.start(shafts);
  watch.all.resize(static_cast<std::size_t>(watch.here.numbers.size()));
  for (Extent& extent : watch.all) {
    extent.include(-1.0);
    extent.include(1.0);
  }
  return watch;
}

/// A shaft at its friction's edge stops and breaks away by rounding alone.
TEST(Rest, IsWhereEventsComeWithoutEndAndNothingMoves) {
  const SearchSetting setting = search_setting(held_servo());
  const Watch held = watch_of(setting, {.motor_position = edge});
  const Watch moving = watch_of(setting, {.motor_position = edge, .motor_speed = -1.0});
  for (const StopReason reason : {StopReason::zeno, StopReason::chattering}) {
    Stretch endless;
    endless.stop_reason = reason;
    EXPECT_TRUE(is_at_rest(held, endless, setting, {}));
    EXPECT_FALSE(is_at_rest(moving, endless, setting, {}));
  }
  EXPECT_FALSE(is_at_rest(held, {}, setting, {}));  // not watched for long enough
}

/// It recurs after any time, and was divided into shorter orbits.
TEST(Rest, IsNoOrbitOfSeveralRounds) {
  const SearchSetting setting = search_setting(held_servo());
  const hybrid::State start = setting.start({.motor_position = edge});
  hybrid::PeriodicOrbit orbit;
  orbit.start = start;
  orbit.period = 1.0;
  for (const double time : {0.25, 0.5, 0.75, 1.0}) {
    hybrid::Event event;
    event.time = time;
    event.before = event.after = start.numbers;
    orbit.events.push_back(event);
  }
  const AttractorOptions options;
  const hybrid::PeriodicOrbit found = CycleClosing(setting, options).shortest(orbit);
  EXPECT_EQ(found.period, 1.0);
  EXPECT_EQ(found.events.size(), 4U);
}

}  // namespace
}  // namespace gearlash::drive::rest_test
