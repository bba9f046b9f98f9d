// The series of a drive in the fixed-step simulator, the textbook's gains, and tasks of design.
#include "series_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "design_task.hpp"
#include "gearlash/input.hpp"
#include "textbook_gains.hpp"

namespace gearlash::oracle::series_check_test {
namespace {

PlainDrive industrial(const std::string& name) {
  return plain_drive(read_drive(std::string(GEARLASH_SOURCE_DIRECTORY) +
                                "/tests/regression/data/industrial/" + name));
}

TEST(PropertySeries, UnitsKeepTheirTolerances) {
  const PlainDrive drive = industrial("rnd16.toml");
  const SeriesOptions options;
  double lowest_gap = 1.0;
  for (std::size_t i = 0; i < 300; ++i) {
    const SeriesUnit unit = unit_of(drive, i, options);
    SCOPED_TRACE(i);
    EXPECT_NEAR(unit.drive.motor.inertia, unit.motor_inertia * drive.motor.inertia,
                1e-15 * drive.motor.inertia);
    EXPECT_NEAR(unit.motor_inertia, 1.0, options.inertia);
    EXPECT_NEAR(unit.drive.load.coulomb / drive.load.coulomb, 1.0, options.friction);
    EXPECT_NEAR(unit.drive.load.breakaway / unit.drive.load.coulomb,
                drive.load.breakaway / drive.load.coulomb, 1e-14);
    EXPECT_LE(unit.drive.backlash, drive.backlash);
    EXPECT_LE(std::abs(unit.start.motor_position - unit.start.load_position),
              0.5 * unit.drive.backlash);
    lowest_gap = std::min(lowest_gap, unit.gap);
  }
  EXPECT_LT(lowest_gap, 0.05);
  EXPECT_EQ(unit_of(drive, 7, options).start, unit_of(drive, 7, options).start);
  EXPECT_NE(unit_of(drive, 7, options).start, unit_of(drive, 7, {.seed = 2}).start);
}

/// rnd05 rests from wherever it starts, rnd16 hunts by some steps if disturbed (expected.csv
/// there).
TEST(OracleSeries, CountsUnitsThatHunt) {
  const SeriesCheck rests = check_series(industrial("rnd05.toml"), {.units = 6});
  EXPECT_EQ(rests.resting, 6U);
  EXPECT_EQ(rests.kept(), 6U);
  const SeriesCheck hunts = check_series(industrial("rnd16.toml"), {.units = 6});
  EXPECT_GT(hunts.beyond, 0U);
  EXPECT_EQ(hunts.kept() + hunts.beyond + hunts.running_away, 6U);
  EXPECT_GT(hunts.worst_amplitude, industrial("rnd16.toml").step);
}

/// A speed gain of the wrong sign without a torque limit: every unit runs away.
TEST(OracleSeries, CountsUnitsThatRunAway) {
  PlainDrive drive = industrial("rnd05.toml");
  drive.controller.proportional *= -1.0;
  drive.limit = std::numeric_limits<double>::infinity();
  const SeriesCheck check = check_series(drive, {.units = 3});
  EXPECT_EQ(check.running_away, 3U);
  EXPECT_EQ(check.kept(), 0U);
}

/// 1 kHz, half a period of delay: T = 0.5 + 0.5 + 0.5 ms.
TEST(OracleTextbookGains, AreThoseOfTheSymmetricOptimum) {
  PlainDrive drive;
  drive.motor.inertia = 1.0;
  drive.load.inertia = 2.0;
  drive.period = 1e-3;
  drive.delay = 0.5e-3;
  const PlainController gains = with_textbook_gains(drive).controller;
  EXPECT_NEAR(gains.proportional, 1000.0, 1e-9);
  EXPECT_NEAR(gains.integral, 1000.0 / 6e-3, 1e-6);
  EXPECT_NEAR(gains.tracking_time, 6e-3, 1e-15);
  EXPECT_NEAR(gains.position, 1.0 / 24e-3, 1e-9);
  drive.has_tachometer = true;
  EXPECT_NEAR(with_textbook_gains(drive).controller.position, 1.0 / 16e-3, 1e-9);
}

/// design_drives has more (docs/explanation/verification.md).
TEST(PropertyDesignTask, ItsAnswersHoldWhenPutBack) {
  for (const std::uint64_t seed : {3U, 9U}) {
    const DesignTask task = random_design_task(seed);
    SCOPED_TRACE(std::to_string(seed) + " " + task.text);
    const DesignCheck check = checked_design(task);
    EXPECT_TRUE(check.ends_that_miss.empty());
    EXPECT_TRUE(check.inner_that_miss.empty());
    EXPECT_TRUE(check.missed.empty());
  }
}

}  // namespace
}  // namespace gearlash::oracle::series_check_test
