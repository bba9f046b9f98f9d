// The fixed-step simulator against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "computer.hpp"
#include "ending.hpp"
#include "mechanism.hpp"

namespace gearlash::oracle::simulator_test {
namespace {

/// Far from both faces: each shaft moves alone.
PlainDrive shafts_apart() {
  PlainDrive drive;
  drive.backlash = 1000.0;
  return drive;
}

/// The servo with ω_n = 1 rad/s, K = 1 N m/rad, J_M + J_L = 1 kg m², ζ 0.19, J_L/J_M 2, F_L/F 0.1,
/// b 0.3 rad, plastic. Its exact cycle: amplitude 0.241611108 rad, period 6.456205 s.
PlainDrive plastic_servo() {
  PlainDrive drive;
  drive.motor = {.inertia = 1.0 / 3.0, .viscous = 0.342};
  drive.load = {.inertia = 2.0 / 3.0, .viscous = 0.038};
  drive.backlash = 0.3;
  drive.controller.proportional = 1.0;
  return drive;
}

TEST(OracleMechanism, AgreesWithTheExactCycleOfThePlasticServo) {
  Mechanism mechanism(plastic_servo(), {0.45, 0.0, 0.3, 0.0});
  constexpr double step = 1e-3;
  constexpr double from = 1000.0;
  constexpr double until = 1200.0;
  std::vector<double> passings;
  for (int i = 1; i * step <= until; ++i) {
    const double before = mechanism.shafts().load_position;
    mechanism.advance(step, {.stiffness = 1.0});
    const double after = mechanism.shafts().load_position;
    if (i * step < from) {
      mechanism.forget_extremes();
    } else if (before < 0.0 && after >= 0.0) {
      passings.push_back((i - after / (after - before)) * step);
    }
  }
  ASSERT_GT(passings.size(), 20U);
  const double amplitude = 0.5 * (mechanism.highest_load() - mechanism.lowest_load());
  const double period =
      (passings.back() - passings.front()) / static_cast<double>(passings.size() - 1);
  // Of second order: some (step/s)² times the number of accelerations, and extremes of the steps.
  EXPECT_NEAR(amplitude, 0.241611108, 2e-6);
  EXPECT_NEAR(period, 6.456205, 1e-5);
}

TEST(OracleEnding, OfThePlasticServoIsItsCycle) {
  const Ending ending =
      ending_of(plastic_servo(), {0.45, 0.0, 0.3, 0.0},
                {.longest_step = 2e-3, .first_time = 400.0, .trace_period = 10e-3});
  EXPECT_EQ(ending.kind, EndKind::hunts);
  EXPECT_NEAR(ending.amplitude, 0.241611108, 1e-5);
  EXPECT_NEAR(ending.frequency, 1.0 / 6.456205, 0.02);
}

/// The same servo: a cascade without integral is stiffness and friction on the motor.
TEST(OracleEnding, OfAContinuousCascadeTendsToTheExactCycleWithTheStep) {
  PlainDrive drive = plastic_servo();
  drive.has_tachometer = true;
  drive.speed_of_load = false;
  constexpr double speed_gain = 0.05;
  drive.motor.viscous -= speed_gain;
  drive.controller = {
      .law = PlainLaw::cascade, .position = 1.0 / speed_gain, .proportional = speed_gain};
  const auto error = [&](double step) {
    const Ending ending =
        ending_of(drive, {0.45, 0.0, 0.3, 0.0},
                  {.longest_step = step, .first_time = 400.0, .trace_period = 10e-3});
    EXPECT_EQ(ending.kind, EndKind::hunts);
    return std::abs(ending.amplitude - 0.241611108);
  };
  // Held torques lag by half a step: of first order.
  EXPECT_LT(error(1e-3), 4e-4);
  EXPECT_LT(error(5e-4), 0.6 * error(1e-3));
}

TEST(OraclePlainDrive, LinearisesAWeightAboutTheReference) {
  Drive drive;
  drive.motor.inertia = 1.0;
  drive.gearbox = {.ratio = 1.0, .backlash = 1000.0};
  drive.load.inertia = 0.5;
  drive.load.gravity = 3.0;
  drive.load.gravity_angle = -0.4;
  drive.reference = -0.1;
  drive.controller.law = PID{.terms = PIDTerms::PD, .proportional = 1.0};
  Mechanism mechanism(plain_drive(drive), {0.0, 0.0, -0.1, 0.0});
  for (int i = 0; i < 5000; ++i) mechanism.advance(1e-3, {});
  // J y'' = −k y − m g l cos φ, k = −m g l sin φ, φ = −0.5, y = 0 at the reference
  const double rate = std::sqrt(3.0 * std::sin(0.5) / 0.5);
  const double y = -std::cos(0.5) / std::sin(0.5) * (1.0 - std::cos(rate * 5.0));
  EXPECT_NEAR(mechanism.shafts().load_position, -0.1 + y, 1e-4);
}

TEST(OracleMechanism, StopsASlidingMassByCoulombFriction) {
  PlainDrive drive = shafts_apart();
  drive.load = {.inertia = 2.0, .coulomb = 1.5, .breakaway = 1.5};
  Mechanism mechanism(drive, {0.0, 0.0, 0.0, 3.0});
  for (int i = 0; i < 3999; ++i) mechanism.advance(1e-3, {});
  EXPECT_GT(mechanism.shafts().load_speed, 0.0);
  for (int i = 0; i < 100; ++i) mechanism.advance(1e-3, {});
  EXPECT_EQ(mechanism.shafts().load_speed, 0.0);             // after J v/C = 4 s
  EXPECT_NEAR(mechanism.shafts().load_position, 6.0, 1e-9);  // J v²/(2 C)
}

TEST(OracleMechanism, AShaftSticksUpToItsBreakawayTorque) {
  PlainDrive drive = shafts_apart();
  drive.motor = {.inertia = 0.5, .coulomb = 1.0, .breakaway = 2.0};
  Mechanism mechanism(drive, {});
  for (int i = 0; i < 100; ++i) mechanism.advance(0.01, {.held = 2.0});
  EXPECT_TRUE(mechanism.stands());
  for (int i = 0; i < 100; ++i) mechanism.advance(0.01, {.held = 2.5});
  EXPECT_NEAR(mechanism.shafts().motor_speed, 3.0, 1e-12);  // (2.5 − 1)/0.5 for 1 s
}

TEST(OracleMechanism, ASpringMassDecaysByItsDamping) {
  PlainDrive drive = shafts_apart();
  drive.motor = {.inertia = 1.0, .viscous = 0.2};
  drive.reads_load = false;
  Mechanism mechanism(drive, {1.0, 0.0, 0.0, 0.0});
  for (int i = 0; i < 20'000; ++i) mechanism.advance(1e-3, {.stiffness = 4.0});
  const double rate = std::sqrt(4.0 - 0.01);
  const double time = 20.0;
  const double exact =
      std::exp(-0.1 * time) * (std::cos(rate * time) + 0.1 / rate * std::sin(rate * time));
  EXPECT_NEAR(mechanism.shafts().motor_position, exact, 3e-6);
}

TEST(OracleMechanism, CompliantFacesExchangeSpeedsWithinHalfASwing) {
  PlainDrive drive;
  drive.motor.inertia = 1.0;
  drive.load.inertia = 3.0;
  drive.backlash = 0.2;
  drive.contact = PlainContact::spring_damping_full;
  drive.stiffness = 300.0;
  const double contact_time = std::numbers::pi * std::sqrt(0.75 / 300.0);
  const double flight = 0.2;  // from the backward face to the forward one, at 1 rad/s
  Mechanism mechanism(drive, {-0.1, 1.0, 0.0, 0.0});
  constexpr double step = 1e-4;
  const auto go_on = [&](double time) {
    for (int i = 0; i < static_cast<int>(std::lround(time / step)); ++i) {
      mechanism.advance(step, {});
    }
  };
  go_on(flight + 0.98 * contact_time);
  EXPECT_GT(mechanism.shafts().motor_position - mechanism.shafts().load_position, 0.1);
  go_on(0.04 * contact_time);
  EXPECT_LT(mechanism.shafts().motor_position - mechanism.shafts().load_position, 0.1);
  EXPECT_NEAR(mechanism.shafts().motor_speed, -0.5, 1e-5);  // (J_M − J_L)/J
  EXPECT_NEAR(mechanism.shafts().load_speed, 0.5, 1e-5);    // 2 J_M/J
}

TEST(OracleMechanism, BouncesComeToAnEndAtTheirLimit) {
  PlainDrive drive;
  drive.motor = {.inertia = 1e12, .coulomb = 10.0, .breakaway = 10.0};
  drive.load.inertia = 1.0;
  drive.backlash = 1.0;
  drive.restitution = 0.5;
  drive.load_torque = 2.0;
  // The load falls from the forward face to the backward one: 1 s, then 2 e/(1 − e) s of bounces.
  Mechanism mechanism(drive, {0.5, 0.0, 0.0, 0.0});
  for (int i = 0; i < 2990; ++i) mechanism.advance(1e-3, {});
  EXPECT_NE(mechanism.shafts().load_speed, 0.0);
  for (int i = 0; i < 15; ++i) mechanism.advance(1e-3, {});
  EXPECT_NEAR(mechanism.shafts().load_speed, 0.0, 1e-9);
  EXPECT_NEAR(mechanism.shafts().load_position, 1.0, 1e-9);
}

TEST(OracleMechanism, AMotorThatFollowsKeepsPushingALoadThatItsOwnTorqueMoves) {
  PlainDrive drive;
  drive.motor = {.inertia = 1.0, .coulomb = 1.0, .breakaway = 2.0};
  drive.load = {.inertia = 3.0, .coulomb = 1.0, .breakaway = 2.0};
  drive.backlash = 0.1;
  drive.load_torque = -5.0;
  Mechanism mechanism(drive, {-0.05, 0.0, 0.0, 0.0});
  for (int i = 0; i < 1000; ++i) mechanism.advance(1e-3, {.held = -21.0});
  EXPECT_NEAR(mechanism.shafts().load_speed, -6.0, 1e-9);  // −(21 + 5 − 2)/4
  EXPECT_NEAR(mechanism.shafts().motor_speed, -6.0, 1e-9);
  EXPECT_EQ(mechanism.left_out(), 0.0);
}

TEST(OracleMechanism, AMotorPulledBackLeavesTheLoadBehind) {
  PlainDrive drive;
  drive.motor = {.inertia = 1.0, .coulomb = 1.0, .breakaway = 2.0};
  drive.load = {.inertia = 3.0, .coulomb = 1.0, .breakaway = 2.0};
  drive.backlash = 10.0;
  Mechanism mechanism(drive, {5.0, 0.0, 0.0, 0.0});
  for (int i = 0; i < 1000; ++i) mechanism.advance(1e-3, {.held = -7.0});
  EXPECT_EQ(mechanism.shafts().load_speed, 0.0);
  EXPECT_NEAR(mechanism.shafts().motor_speed, -6.0, 1e-9);
}

PlainDrive sampled_drive() {
  PlainDrive drive;
  drive.controller.proportional = 2.0;
  drive.controller.integral = 3.0;
  drive.period = 0.1;
  drive.reads_load = false;
  return drive;
}

ShaftReadings motor_at(double position) { return {.motor_position = position}; }

TEST(OracleComputer, IntegratesByTheTrapezoidalRule) {
  Computer computer(sampled_drive(), motor_at(-1.0));
  computer.sample(motor_at(-1.0));
  EXPECT_NEAR(computer.torque(), 2.0 + 0.15, 1e-15);
  computer.sample(motor_at(-1.0));
  EXPECT_NEAR(computer.torque(), 2.0 + 0.45, 1e-15);
}

TEST(OracleComputer, ReadsWholeStepsHalvesAwayFromZero) {
  PlainDrive drive = sampled_drive();
  drive.controller.integral = 0.0;
  drive.step = 0.25;
  Computer computer(drive, {});
  for (const auto& [position, torque] : {std::pair{0.125, -0.5}, {-0.125, 0.5}, {0.124, 0.0}}) {
    computer.sample(motor_at(position));
    EXPECT_EQ(computer.torque(), torque) << position;
  }
}

TEST(OracleComputer, GivesOutAfterTheDelay) {
  PlainDrive drive = sampled_drive();
  drive.controller.integral = 0.0;
  drive.delay = 0.05;
  Computer half(drive, {});
  half.sample(motor_at(-1.0));
  EXPECT_EQ(half.torque(), 0.0);
  half.give_out();
  EXPECT_EQ(half.torque(), 2.0);
  drive.delay = drive.period;
  Computer whole(drive, {});
  whole.sample(motor_at(-1.0));
  EXPECT_EQ(whole.torque(), 0.0);
  whole.sample(motor_at(5.0));
  EXPECT_EQ(whole.torque(), 2.0);
}

TEST(OracleComputer, AntiWindupSeesTheLimitOneSampleLate) {
  PlainDrive drive = sampled_drive();
  drive.limit = 1.0;
  drive.controller.tracking_time = 0.2;
  Computer computer(drive, {});
  computer.sample(motor_at(-1.0));  // asks for 2.15: the integral is 0.3 and not drawn back yet
  EXPECT_EQ(computer.torque(), 1.0);
  computer.sample(motor_at(0.0));  // reads 0.3; then it is drawn back by 0.1/0.2 · 1.15
  EXPECT_NEAR(computer.torque(), 0.3, 1e-15);
  computer.sample(motor_at(0.0));
  EXPECT_NEAR(computer.torque(), 0.3 - 0.575, 1e-15);
}

TEST(OracleComputer, TakesTheSpeedFromDifferencesOfReadings) {
  PlainDrive drive = sampled_drive();
  drive.controller = {.law = PlainLaw::cascade, .position = 10.0, .proportional = 2.0};
  drive.speed_of_load = true;
  drive.speed_step = 0.01;
  Computer computer(drive, {.load_speed = 0.5});  // read at −0.05 one period ago
  computer.sample({.load_position = 0.02});
  EXPECT_NEAR(computer.torque(), -2.0 * 0.7, 1e-12);
  computer.sample({.load_position = 0.024});
  EXPECT_NEAR(computer.torque(), 0.0, 1e-12);
}

}  // namespace
}  // namespace gearlash::oracle::simulator_test
