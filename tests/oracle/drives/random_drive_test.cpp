// The generator of industrial drives.
#include "random_drive.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>

#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "plain_drive.hpp"

namespace gearlash::oracle::random_drive_test {
namespace {

TEST(PropertyRandomDrive, IsSoundAndWithinItsRanges) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Drive drive = random_drive(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_TRUE(faults(drive).empty());
    const PlainDrive plain = plain_drive(drive);
    const double ratio = plain.load.inertia / plain.motor.inertia;
    EXPECT_GE(ratio, 0.199);
    EXPECT_LE(ratio, 10.01);
    EXPECT_GE(plain.backlash, 0.49 / 3438.0);
    EXPECT_LE(plain.backlash, 10.1 / 3437.0);
    EXPECT_GE(plain.delay, 0.5 * plain.period);
    const double dry = (plain.motor.coulomb + plain.load.coulomb) / (plain.limit / 3.0);
    EXPECT_GE(dry, 0.0099);
    EXPECT_LE(dry, 0.1001);
  }
}

TEST(PropertyRandomDrive, IsTheSameOnEveryMachine) {
  const Drive drive = random_drive(1);
  EXPECT_EQ(drive, random_drive(1));
  EXPECT_EQ(drive.gearbox.ratio, 8.0);
  EXPECT_EQ(drive.motor.inertia, 2.1459949493873864e-05);
  EXPECT_EQ(drive.sampling->period, 0.00025);
}

TEST(PropertyRandomDrive, HasNoComputerWhereItIsContinuous) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Drive drive = continuous_drive(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_TRUE(faults(drive).empty());
    EXPECT_EQ(plain_drive(drive).small_length(), drive.gearbox.backlash);
    if (seed % 2 == 0) {
      EXPECT_EQ(plain_drive(drive).load.breakaway, plain_drive(drive).load.coulomb);
    }
  }
}

TEST(PropertyRandomDrive, ReadsBackFromItsFile) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Drive drive = random_drive(seed);
    EXPECT_EQ(to_toml(parse_drive(to_toml(drive))), to_toml(drive)) << "seed " << seed;
  }
}

TEST(PropertyRandomDrive, ComesInEveryKind) {
  std::set<std::string> kinds;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const PlainDrive plain = plain_drive(random_drive(seed));
    kinds.insert(plain.contact != PlainContact::rigid ? "compliant"
                 : plain.restitution > 0.0            ? "bouncing"
                                                      : "plastic");
    kinds.insert(plain.controller.law == PlainLaw::cascade ? "cascade" : "PID");
    const bool has_weight = plain.gravity_stiffness != 0.0;
    if (plain.load_torque != 0.0) kinds.insert(has_weight ? "weight" : "load torque");
    if (plain.motor.breakaway == plain.motor.coulomb) kinds.insert("no breakaway above Coulomb");
    if (plain.has_tachometer) kinds.insert("tachometer");
    if (plain.reads_load != plain.speed_of_load) kinds.insert("both shafts");
  }
  EXPECT_EQ(kinds.size(), 10U);
}

}  // namespace
}  // namespace gearlash::oracle::random_drive_test
