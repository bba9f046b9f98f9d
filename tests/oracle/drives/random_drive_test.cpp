// The generator of industrial drives.
#include "random_drive.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

constexpr std::array new_kinds = {DriveKind::filtered_cascade, DriveKind::weight_at_limit,
                                  DriveKind::state_space,      DriveKind::moving_reference,
                                  DriveKind::two_rates,        DriveKind::without_integral,
                                  DriveKind::extreme};

TEST(PropertyRandomDrive, OfEveryKindIsSoundAndReadsBack) {
  for (const DriveKind kind : new_kinds) {
    std::size_t with_computer = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const Drive drive = random_drive(seed, kind);
      SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + ", seed " +
                   std::to_string(seed));
      EXPECT_TRUE(faults(drive).empty());
      EXPECT_EQ(to_toml(parse_drive(to_toml(drive))), to_toml(drive));
      EXPECT_NO_THROW((void)plain_drive(drive));
      with_computer += drive.sampling ? 1U : 0U;
    }
    EXPECT_EQ(with_computer, kind == DriveKind::extreme ? 100U : 50U);
  }
}

TEST(PropertyRandomDrive, HasWhatItsKindSays) {
  std::set<std::string> seen;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Drive cascade = random_drive(seed, DriveKind::filtered_cascade);
    EXPECT_GT(std::get<CascadeController>(cascade.controller.law).filter, 0.0);
    EXPECT_GT(cascade.motor.friction.stribeck_speed, 0.0);
    const Drive weight = random_drive(seed, DriveKind::weight_at_limit);
    const double holding = weight.load.gravity * std::cos(weight.load.gravity_angle);
    const double share = holding / (*weight.motor.limit * weight.gearbox.ratio);
    EXPECT_GE(share, 0.599);
    EXPECT_LE(share, 1.101);
    if (weight.controller.dead_band.width > 0.0) seen.insert("dead band");
    if (weight.controller.compensation.friction > 0.0) seen.insert("friction compensated");
    if (weight.controller.compensation.backlash > 0.0) seen.insert("backlash compensated");
    const auto order =
        std::get<StateSpaceController>(random_drive(seed, DriveKind::state_space).controller.law)
            .A.size();
    EXPECT_GE(order, 2U);
    seen.insert("order " + std::to_string(order));
    const Drive moving = random_drive(seed, DriveKind::moving_reference);
    seen.insert("signal " + std::to_string(moving.reference->index()));
    const Drive two_rates = random_drive(seed, DriveKind::two_rates);
    const PlainDrive plain = plain_drive(two_rates);
    if (plain.controller.position_ticks > 1) seen.insert("two rates");
    if (plain.current_rate > 0.0) seen.insert("current loop");
    if (plain.controller.speed_limit < 1e30) seen.insert("speed limit");
    if (plain.controller.inertia > 0.0 && two_rates.reference) seen.insert("acceleration fed");
    const Drive extreme = random_drive(seed, DriveKind::extreme);
    if (extreme.gearbox.backlash == 1e-6) seen.insert("small gap");
    if (extreme.sampling->delay > extreme.sampling->period) seen.insert("long delay");
    if (plain_drive(extreme).step > extreme.gearbox.backlash) seen.insert("wide step");
    const Drive free = frictionless_drive(seed);
    EXPECT_TRUE(faults(free).empty());
    EXPECT_EQ(free.motor.friction, Friction{});
    EXPECT_EQ(free.load.friction, Friction{});
  }
  EXPECT_EQ(seen,
            (std::set<std::string>{"dead band", "friction compensated", "backlash compensated",
                                   "order 2", "order 4", "order 6", "signal 2", "signal 3",
                                   "signal 4", "small gap", "long delay", "wide step", "two rates",
                                   "current loop", "speed limit", "acceleration fed"}));
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
