// References and load torques: what they are at any time, and what a drive is given of them.
#include "model/signal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/seeded_draws.hpp"
#include "general/assemble/drive_system.hpp"

namespace gearlash::drive::signal_test {
namespace {

const Table table{{1.0, 2.0, 4.0}, {0.5, 1.5, -0.5}};
const Trapezoid long_move{.from = 1.0, .to = -3.0, .speed = 2.0, .acceleration = 4.0, .time = 1.0};
const Trapezoid short_move{.to = 1.0, .speed = 10.0, .acceleration = 4.0};

TEST(OracleSignal, IsWhatItsNameSays) {
  EXPECT_EQ(value_at(3.0, 17.0), 3.0);
  const StepSignal step{1.0, 2.0, 0.5};
  EXPECT_EQ(value_at(step, 0.4), 1.0);
  EXPECT_EQ(value_at(step, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(value_at(Ramp{1.0, 2.0, 3.0}, 4.5), 4.0);
  EXPECT_DOUBLE_EQ(value_at(Sine{1.0, 2.0, 3.0, 0.1}, 5.0), 1.0 + 2.0 * std::sin(15.1));
  EXPECT_DOUBLE_EQ(value_at(table, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(value_at(table, 1.5), 1.0);
  EXPECT_DOUBLE_EQ(value_at(table, 3.0), 0.5);
  EXPECT_DOUBLE_EQ(value_at(table, 9.0), -0.5);
}

TEST(OracleSignal, ATrapezoidAcceleratesCruisesAndBrakes) {
  // Half a second to each speed, over 0.5 each; 3 at full speed.
  EXPECT_DOUBLE_EQ(value_at(long_move, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(value_at(long_move, 1.5), 0.5);
  EXPECT_DOUBLE_EQ(value_at(long_move, 2.5), -1.5);
  EXPECT_DOUBLE_EQ(value_at(long_move, 3.0), -2.5);
  EXPECT_DOUBLE_EQ(value_at(long_move, 3.5), -3.0);
  EXPECT_DOUBLE_EQ(settling_time(long_move), 3.5);
  // Half a second up, half a second down.
  EXPECT_DOUBLE_EQ(value_at(short_move, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(value_at(short_move, 1.0), 1.0);
  EXPECT_EQ(std::get<double>(settled(short_move)), 1.0);
}

TEST(EdgeSignal, FaultsAreNamed) {
  const auto found = faults(Table{{0.0, 2.0, 1.0, 1.0}, {0.0, 0.0, 0.0, 0.0}}, "reference");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].path, "reference.times[2]");
  EXPECT_NE(found[0].permitted.find("later than the time before it"), std::string::npos);
  EXPECT_EQ(faults(Table{{0.0}, {}}, "reference").size(), 1U);
  const auto count_of = [](const Signal& signal) {
    gearlash::Drive drive;
    drive.reference = signal;
    const std::vector<Fault> all = gearlash::faults(drive);
    return std::count_if(all.begin(), all.end(),
                         [](const Fault& fault) { return fault.path.starts_with("reference."); });
  };
  EXPECT_EQ(count_of(Trapezoid{}), 2);
  EXPECT_EQ(count_of(Sine{}), 1);
}

/// The shortest way that reaches the speed has no cruise, but for rounding.
TEST(PropertySignal, ATrapezoidWithoutACruiseIsOneOfTwoStretches) {
  constexpr std::uint64_t seed = 43;
  SeededDraws draws(seed);
  ReducedDrive drive;
  drive.motor.inertia = 1.0;
  drive.load.inertia = 1.0;
  drive.backlash = 1.0;
  for (int i = 0; i < 300; ++i) {
    const double speed = draws.log_uniform(1e-3, 10.0);
    const double acceleration = draws.log_uniform(1e-3, 100.0);
    const double start = draws.uniform(0.0, 2.0);
    drive.reference = Trapezoid{.to = speed * speed / acceleration,
                                .speed = speed,
                                .acceleration = acceleration,
                                .time = start};
    EXPECT_NO_THROW(simulate(drive_system(drive).system,
                             drive_start(drive, drive_system(drive), {}), {.until = 3.0}))
        << "seed " << seed << ", draw " << i;
  }
}

/// A motor that nothing but the controller moves: ω = ∫∫ of what is asked, by hand.
TEST(PropertySignal, ADriveIsGivenTheSignal) {
  const std::vector<Signal> all = {0.7,   StepSignal{1.0, 2.0, 0.5}, long_move, Ramp{1.0, 2.0, 3.0},
                                   table, Sine{1.0, 2.0, 3.0, 0.1},  short_move};
  ReducedDrive drive;
  drive.motor.inertia = 1.0;
  drive.load.inertia = 1.0;
  drive.backlash = 1e6;
  for (const Signal& reference : all) {
    for (const Signal& load_torque : all) {
      drive.reference = reference;
      drive.load_torque = load_torque;
      const DriveSystem built = drive_system(drive);
      const auto motion = simulate(built.system, drive_start(drive, built, {}), {.until = 6.0});
      for (const double time : {0.0, 0.3, 0.5, 1.2, 1.9, 2.5, 3.2, 5.0, 6.0}) {
        const hybrid::Vector numbers = motion.at(time).numbers;
        EXPECT_NEAR(built.reference.at(numbers), value_at(reference, time), 1e-13);
        EXPECT_NEAR(built.load_torque.at(numbers), value_at(load_torque, time), 1e-13);
      }
    }
  }
}

}  // namespace
}  // namespace gearlash::drive::signal_test
