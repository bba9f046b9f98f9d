// The fixed-step simulator's laws, delays and moving signals against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "computer.hpp"
#include "ending.hpp"
#include "mechanism.hpp"

namespace gearlash::oracle::simulator_laws_test {
namespace {

ShaftReadings motor_at(double position) { return {.motor_position = position}; }

/// A controller of a motor of 1 kg m² far from its load, whose motor alone is read.
Drive drive_with(const Controller& controller, GainShaft shaft = GainShaft::load,
                 double ratio = 1.0) {
  Drive drive;
  drive.motor.inertia = 1.0 / (ratio * ratio);
  drive.gearbox = {.ratio = ratio, .backlash = 1000.0};
  drive.load.inertia = 1.0;
  drive.sensor.position = SensorPlace::motor;
  drive.controller = controller;
  drive.controller.shaft = shaft;
  return drive;
}

PlainDrive sampled(const Controller& controller, Discretization method = Discretization::tustin,
                   double delay = 0.0) {
  Drive drive = drive_with(controller);
  drive.sampling = Sampling{.period = 0.1, .delay = delay, .method = method};
  return plain_drive(drive);
}

Controller pd(double proportional, double derivative) {
  return {PID{.terms = PIDTerms::PD, .proportional = proportional, .derivative = derivative}};
}

// ---- laws ---------------------------------------------------------------------------------------

/// The motor's position after a sampled controller's motion from rest at 1.
double motor_after(const PlainDrive& drive, double until) {
  Mechanism mechanism(drive, motor_at(1.0));
  Computer computer(drive, motor_at(1.0));
  for (int i = 0; (i + 0.5) * drive.period < until; ++i) {
    computer.sample(mechanism.shafts(), i * drive.period);
    mechanism.advance(drive.period, {computer.torque()});
  }
  return mechanism.shafts().motor_position;
}

/// A cascade with a filter, speed 5/3, position 0.6, filter 1/6: s³ + 6 s² + 11 s + 6.
const Controller filtered_cascade = {
    CascadeController{.position = 0.6, .speed = 5.0 / 3.0, .filter = 1.0 / 6.0}};
const Controller its_states = {StateSpaceController{
    .gain = 5.0 / 3.0, .A = {{-6.0}}, .B = {{0.0, 0.0, 6.0}}, .C = {-1.0}, .D = {0.6, -0.6, 0.0}}};

TEST(OracleLaws, AFilteredCascadeTendsToItsAnswerWithThePeriod) {
  for (const Controller& controller : {filtered_cascade, its_states}) {
    PlainDrive drive = plain_drive(drive_with(controller));
    const double time = 1.5;  // from x = 1, x' = 0, x'' = −1
    const double exact =
        2.5 * std::exp(-time) - 2.0 * std::exp(-2.0 * time) + 0.5 * std::exp(-3.0 * time);
    const auto error = [&](double period) {
      drive.period = period;
      return std::abs(motor_after(drive, time) - exact);
    };
    EXPECT_LT(error(1e-3), 1e-3);
    EXPECT_LT(error(5e-4), 0.6 * error(1e-3));  // held torques lag: of first order
  }
}

/// Torques of two computers that read the same, as a share of the largest.
double largest_difference(const PlainDrive& one, const PlainDrive& other) {
  Computer first(one, motor_at(0.0));
  Computer second(other, motor_at(0.0));
  double largest = 0.0;
  double difference = 0.0;
  for (int i = 0; i < 60; ++i) {
    const ShaftReadings shafts = motor_at(std::sin(0.4 * i) + 0.3 * std::cos(1.7 * i));
    first.sample(shafts);
    second.sample(shafts);
    largest = std::max(largest, std::abs(first.torque()));
    difference = std::max(difference, std::abs(first.torque() - second.torque()));
  }
  return difference / largest;
}

constexpr std::array methods = {Discretization::tustin, Discretization::backward,
                                Discretization::forward};

TEST(OracleLaws, PIDIsItsStateSpaceAndItsTransferFunction) {
  constexpr double p = 3.0;
  constexpr double i = 2.0;
  constexpr double d = 0.7;
  constexpr double T = 0.25;
  const Controller pid = {
      PID{.terms = PIDTerms::PID, .proportional = p, .integral = i, .derivative = d, .filter = T}};
  const Controller states = {StateSpaceController{.gain = 2.0,
                                                  .A = {{0.0, 0.0}, {0.0, -1.0 / T}},
                                                  .B = {{1.0}, {1.0 / T}},
                                                  .C = {0.5 * i, -0.5 * d / T},
                                                  .D = {0.5 * (p + d / T)}}};
  const Controller function = {TransferFunctionController{
      .gain = 1.0, .numerator = {0.0, p * T + d, p + i * T, i}, .denominator = {T, 1.0, 0.0}}};
  for (const Discretization method : methods) {
    EXPECT_LT(largest_difference(sampled(pid, method), sampled(states, method)), 1e-13);
    EXPECT_LT(largest_difference(sampled(pid, method), sampled(function, method)), 1e-13);
  }
}

TEST(OracleLaws, AFilteredCascadeWithIntegralIsItsStateSpace) {
  constexpr double w = 4.0;
  constexpr double k = 3.0;
  constexpr double i = 2.0;
  constexpr double T = 0.25;
  const Controller cascade = {
      CascadeController{.position = w, .speed = k, .speed_integral = i, .filter = T}};
  const Controller states = {StateSpaceController{.gain = 1.0,
                                                  .A = {{0.0, -i}, {0.0, -1.0 / T}},
                                                  .B = {{i * w, -i * w, 0.0}, {0.0, 0.0, 1.0 / T}},
                                                  .C = {1.0, -k},
                                                  .D = {k * w, -k * w, 0.0}}};
  for (const Discretization method : methods) {
    EXPECT_LT(largest_difference(sampled(cascade, method), sampled(states, method)), 1e-13);
  }
}

TEST(OracleLaws, ALeadLagIsItsTransferFunction) {
  const Controller lead = {LeadLagController{.gain = 3.0, .zero = 2.0, .pole = 9.0}};
  const Controller function = {TransferFunctionController{
      .gain = 3.0, .numerator = {1.0 / 2.0, 1.0}, .denominator = {1.0 / 9.0, 1.0}}};
  EXPECT_LT(largest_difference(sampled(lead), sampled(function)), 1e-15);
}

TEST(OracleLaws, AFunctionOfZIsItsDifferenceEquation) {
  Computer computer(sampled({TransferFunctionController{.gain = 2.0,
                                                        .numerator = {3.0, 1.0},
                                                        .denominator = {2.0, -1.0, 0.5},
                                                        .is_sampled = true}}),
                    motor_at(0.0));
  std::array<double, 3> e{};
  std::array<double, 3> u{};
  for (int i = 0; i < 30; ++i) {  // 2 u₀ − u₁ + 0.5 u₂ = 2 (3 e₁ + e₂)
    e = {std::sin(0.9 * i), e[0], e[1]};
    u = {0.5 * (u[0] - 0.5 * u[1] + 2.0 * (3.0 * e[1] + e[2])), u[0], u[1]};
    computer.sample(motor_at(-e[0]));
    EXPECT_NEAR(computer.torque(), u[0], 1e-12);
  }
}

TEST(OracleLaws, NumbersOfTheMotorAreReferredByTheRatio) {
  Drive drive = drive_with(its_states, GainShaft::motor, 5.0);
  drive.controller.dead_band.width = 0.4;
  drive.controller.compensation = {.friction = 0.3, .friction_speed = 2.0};
  const PlainDrive plain = plain_drive(drive);
  EXPECT_DOUBLE_EQ(plain.controller.system.D[0], 25.0);
  EXPECT_DOUBLE_EQ(plain.controller.system.C[0], -125.0 / 3.0);
  EXPECT_DOUBLE_EQ(plain.controller.width, 0.08);
  EXPECT_DOUBLE_EQ(plain.controller.friction, 1.5);
  EXPECT_DOUBLE_EQ(plain.controller.friction_speed, 0.4);
  drive.controller.law = RelayController{.level = 3.0};
  drive.motor.kind = TorqueControl{.torque_constant = 0.1};
  drive.motor.current_limit = 6.0;
  drive.motor.no_load_current = 2.0;
  drive.gearbox.inertia = 2.0 * drive.motor.inertia;
  const PlainDrive other = plain_drive(drive);
  EXPECT_DOUBLE_EQ(other.controller.proportional, 15.0);
  EXPECT_DOUBLE_EQ(other.limit, 3.0);
  EXPECT_DOUBLE_EQ(other.motor.coulomb, 1.0);
  EXPECT_DOUBLE_EQ(other.motor.breakaway, 1.0);
  EXPECT_DOUBLE_EQ(other.motor.inertia, 3.0);
}

// ---- between error and law, and delays ----------------------------------------------------------

/// What a law of gain 1 gives for errors one after the other.
std::vector<double> answers(const PlainDrive& drive, const std::vector<double>& errors) {
  Computer computer(drive, motor_at(-errors.front()));
  std::vector<double> torques;
  for (const double error : errors) {
    computer.sample(motor_at(-error));
    torques.push_back(computer.torque());
  }
  return torques;
}

TEST(OracleErrorRule, IsThatOfDeadBandsRelaysAndTakeUp) {
  Controller controller = pd(1.0, 0.0);
  controller.dead_band = {.width = 1.0};
  EXPECT_EQ(answers(sampled(controller), {0.5, 1.5, -3.0}), (std::vector{0.0, 0.5, -2.0}));
  controller.dead_band = {.width = 1.0, .hysteresis = 0.25, .form = DeadBandForm::whole};
  EXPECT_EQ(answers(sampled(controller), {1.2, 1.3, 0.8, 0.7, 1.2, -1.3, 0.8}),
            (std::vector{0.0, 1.3, 0.8, 0.0, 0.0, -1.3, 0.0}));
  controller.law = RelayController{.level = 3.0};
  EXPECT_EQ(answers(sampled(controller), {1.2, 1.3, 0.8, 0.7, -1.3}),
            (std::vector{0.0, 3.0, 3.0, 0.0, -3.0}));
  controller.dead_band = {.hysteresis = 0.25};
  EXPECT_EQ(answers(sampled(controller), {0.1, -0.25, -0.3, 0.25, 0.3}),
            (std::vector{3.0, 3.0, -3.0, -3.0, 3.0}));
  controller = pd(1.0, 0.0);
  controller.compensation = {
      .backlash = 4.0, .input = CompensationInput::error, .take_up_angle = 0.5};
  EXPECT_EQ(answers(sampled(controller), {0.25, -1.0}), (std::vector{1.25, -3.0}));
  controller = {StateSpaceController{.gain = 1.0, .D = {2.0, -2.0, 0.0}}};
  controller.dead_band = {.width = 1.0};
  EXPECT_EQ(answers(sampled(controller), {0.5, 1.5, -3.0}), (std::vector{0.0, 1.0, -4.0}));
}

TEST(OracleErrorRule, ADeadBandOfWholeCountsHoldsAsMany) {
  Controller controller = pd(1.0, 0.0);
  controller.dead_band = {.width = 0.3, .form = DeadBandForm::whole};
  PlainDrive drive = sampled(controller);
  drive.step = 0.1;
  drive.reference = 1.1;
  ASSERT_GT(1.1 - 0.8, 0.3);  // by rounding
  Computer computer(drive, motor_at(0.8));
  computer.sample(motor_at(0.8));
  EXPECT_EQ(computer.torque(), 0.0);
  computer.sample(motor_at(0.7));
  EXPECT_NEAR(computer.torque(), 0.4, 1e-15);
  drive.controller.rule = PlainErrorRule::excess;
  Computer of_excess(drive, motor_at(0.8));
  of_excess.sample(motor_at(0.8));
  EXPECT_EQ(of_excess.torque(), 0.0);
}

TEST(OracleErrorRule, AShaftStopsAtTheEdgeOfItsDeadBand) {
  Controller controller = pd(40.0, 0.0);
  controller.dead_band.width = 0.03;
  PlainDrive drive = plain_drive(drive_with(controller));
  drive.motor.viscous = 20.0;
  const Extremes found = extremes_between(drive, motor_at(1.0), 30.0, 31.0);
  EXPECT_NEAR(found.motor.low, 0.03, 1e-9);
  EXPECT_NEAR(found.motor.high, 0.03, 1e-9);
  EXPECT_TRUE(found.stands && found.is_whole);
}

TEST(OracleDelay, OfTwoAndAHalfPeriodsAndOfThreeByHand) {
  for (const double periods : {2.5, 3.0}) {
    Computer computer(sampled(pd(1.0, 0.0), Discretization::tustin, 0.1 * periods), motor_at(0.0));
    ASSERT_EQ(computer.gives_out_later(), periods == 2.5);
    EXPECT_NEAR(computer.output_after(), periods == 2.5 ? 0.05 : 0.1, 1e-12);
    for (int i = 0; i < 8; ++i) {
      computer.sample(motor_at(-10.0 - i));
      EXPECT_EQ(computer.torque(), i < 3 ? 0.0 : 10.0 + (i - 3)) << periods << " " << i;
      if (!computer.gives_out_later()) continue;
      computer.give_out();
      EXPECT_EQ(computer.torque(), i < 2 ? 0.0 : 10.0 + (i - 2)) << i;
    }
  }
}

// ---- signals ------------------------------------------------------------------------------------

TEST(OracleSignals, GoTheirCourses) {
  const auto value = [](const Signal& signal, double time) {
    const PlainSignal plain = plain_signal(signal);
    return plain.constant + plain.course.at(time);
  };
  const Signal step = StepSignal{.before = 2.0, .after = 5.0, .time = 1.0};
  EXPECT_EQ(value(step, 0.9), 2.0);
  EXPECT_EQ(value(step, 1.0), 5.0);
  const Signal ramp = RampSignal{.value = 2.0, .rate = -3.0, .time = 1.0};
  EXPECT_EQ(value(ramp, 0.5), 2.0);
  EXPECT_EQ(value(ramp, 3.0), -4.0);
  const Signal table = TableSignal{.times = {1.0, 2.0, 4.0}, .values = {7.0, 9.0, 8.0}};
  EXPECT_EQ(value(table, 0.0), 7.0);
  EXPECT_EQ(value(table, 1.25), 7.5);
  EXPECT_EQ(value(table, 3.0), 8.5);
  EXPECT_EQ(value(table, 9.0), 8.0);
  // 10 rad at 2 rad/s with 4 rad/s²: 0.5 s, 4.5 s, 0.5 s
  const Signal move = TrapezoidSignal{.from = 1.0, .to = -9.0, .speed = 2.0, .acceleration = 4.0};
  EXPECT_EQ(value(move, 0.25), 1.0 - 0.125);
  EXPECT_EQ(value(move, 0.5), 0.5);
  EXPECT_EQ(value(move, 3.0), -4.5);
  EXPECT_DOUBLE_EQ(value(move, 5.25), -9.0 + 0.125);
  EXPECT_EQ(value(move, 6.0), -9.0);
  EXPECT_EQ(plain_signal(move).course.rate_at(3.0), -2.0);
  EXPECT_EQ(plain_signal(move).course.rate_at(0.25), -1.0);
  // 1 rad at most: 0.5 s up, 0.5 s down
  const Signal peak = TrapezoidSignal{.to = 1.0, .speed = 5.0, .acceleration = 4.0};
  EXPECT_EQ(value(peak, 0.5), 0.5);
  EXPECT_EQ(value(peak, 0.75), 1.0 - 0.125);
  EXPECT_EQ(plain_signal(peak).course.settling_time(), 1.0);
}

TEST(OracleSignals, SettleToWhatASearchHas) {
  const auto course = [](const Signal& signal) { return plain_signal(signal).course.settled(); };
  EXPECT_FALSE(course(TableSignal{.times = {1.0, 2.0}, .values = {7.0, 9.0}}).moves());
  const PlainCourse ramp = course(RampSignal{.value = 2.0, .rate = -3.0, .time = 4.0});
  EXPECT_EQ(ramp.at(1.0), -3.0);
  EXPECT_EQ(ramp.rate_at(0.0), -3.0);
  EXPECT_EQ(course(SineSignal{.amplitude = 2.0, .frequency = 0.5}).at(1.0), 2.0 * std::sin(0.5));
}

TEST(OracleSignals, TheReferencesMotionIsFedForward) {
  Controller controller = pd(2.0, 0.0);
  controller.compensation = {.friction = 0.5, .friction_speed = 4.0, .backlash = 0.2};
  PlainDrive drive = sampled(controller);
  drive.reference_course =
      plain_signal(TrapezoidSignal{.to = -8.0, .speed = 8.0, .acceleration = 4.0, .time = 1.0})
          .course;
  drive.reference = -8.0;
  Computer computer(drive, motor_at(0.0));
  const auto torque_at = [&](double time) {
    computer.sample(motor_at(0.0), time);
    return computer.torque();
  };
  EXPECT_EQ(torque_at(0.5), 0.0);                               // before the first motion
  EXPECT_DOUBLE_EQ(torque_at(1.5), 2.0 * (-0.5 - 0.1) - 0.25);  // at −2 rad/s
  EXPECT_DOUBLE_EQ(torque_at(2.25), 2.0 * (-3.125 - 0.1) - 0.5);
  EXPECT_DOUBLE_EQ(torque_at(9.0), 2.0 * (-8.0 - 0.1));
}

TEST(OracleSignals, HalfAnAssumedGapIsTakenUpWithItsTimeConstant) {
  Controller controller = pd(1.0, 0.0);
  controller.compensation = {.backlash = 0.2, .take_up_time = 0.4};
  PlainDrive drive = sampled(controller);
  drive.reference_course = plain_signal(RampSignal{.rate = 1e-9}).course;
  Computer computer(drive, motor_at(0.0));
  for (int i = 0; i <= 6; ++i) {
    computer.sample(motor_at(0.0), 0.1 * i);
    EXPECT_NEAR(computer.torque(), 0.1 * (1.0 - std::exp(-0.1 * i / 0.4)), 1e-8);
  }
}

// ---- moving references --------------------------------------------------------------------------

/// Both shafts joined by a spring; the load is read.
PlainDrive joined() {
  PlainDrive drive;
  drive.motor = {.inertia = 0.4, .viscous = 0.3};
  drive.load = {.inertia = 0.6, .viscous = 0.5};
  drive.contact = PlainContact::spring_damping_limited;
  drive.stiffness = 900.0;
  drive.damping = 1.5;
  drive.has_tachometer = true;
  drive.controller.proportional = 25.0;
  drive.controller.derivative = 4.0;
  return drive;
}

TEST(OracleMovingReference, ASineIsFollowedAsTheTransferFunctionSays) {
  using namespace std::complex_literals;
  PlainDrive drive = joined();
  drive.reference = 0.2;
  drive.reference_course = {.amplitude = 0.1, .frequency = 6.0, .phase = 1.0};
  const auto s = 6.0i;
  const auto spring = drive.stiffness + drive.damping * s;
  const auto of_motor = drive.motor.inertia * s * s + drive.motor.viscous * s + spring;
  const auto of_load = drive.load.inertia * s * s + drive.load.viscous * s + spring;
  const auto gain = 25.0 + 4.0 * s;  // of the load's position
  const auto load = 25.0 * 0.1 / (of_motor * of_load / spring - spring + gain);
  const auto motor = load * of_load / spring;
  for (const bool is_sampled : {false, true}) {
    if (is_sampled) drive.period = 1e-5;
    const double allowed = is_sampled ? 1e-5 : 1e-7;
    const Extremes found = extremes_between(drive, {}, 40.0, 45.0, {.longest_step = 1e-4});
    EXPECT_NEAR(found.load.amplitude(), std::abs(load), allowed);
    EXPECT_NEAR(found.motor.amplitude(), std::abs(motor), allowed);
    EXPECT_NEAR(found.error.amplitude(), std::abs(0.1 - load), allowed);
    EXPECT_NEAR(0.5 * (found.load.low + found.load.high), 0.2, allowed);
    EXPECT_FALSE(found.stands);
  }
  const Ending ending = ending_of(drive, {}, {.longest_step = 1e-4, .first_time = 1.0});
  EXPECT_EQ(ending.kind, EndKind::hunts);
  EXPECT_NEAR(ending.amplitude, std::abs(load), 1e-5);
  EXPECT_NEAR(ending.time, 12.0 * 2.0 * std::numbers::pi / 6.0, 1e-2);
}

TEST(OracleMovingReference, ASineOfTheLoadTorqueShakesTheLoad) {
  PlainDrive drive;
  drive.backlash = 1000.0;
  drive.load = {.inertia = 0.5, .viscous = 2.0};
  drive.load_torque_course = {.amplitude = 0.3, .frequency = 5.0};
  const Extremes found = extremes_between(drive, {}, 10.0, 15.0, {.longest_step = 1e-4});
  EXPECT_NEAR(found.load.amplitude(), 0.3 / std::hypot(0.5 * 25.0, 2.0 * 5.0), 1e-7);
}

TEST(OracleMovingReference, ARampIsFollowedWithItsSteadyError) {
  PlainDrive drive = joined();
  drive.load.coulomb = drive.load.breakaway = 0.7;
  drive.reference = 0.1;
  drive.reference_course = plain_signal(RampSignal{.rate = 0.6}).course;
  const double error = ((0.3 + 0.5 + 4.0) * 0.6 + 0.7) / 25.0;
  const Extremes found = extremes_between(drive, {}, 20.0, 22.0, {.longest_step = 1e-4});
  EXPECT_NEAR(found.error.low, error, 1e-7);
  EXPECT_NEAR(found.error.high, error, 1e-7);
  EXPECT_NEAR(found.load.high, -error, 1e-7);
  EXPECT_TRUE(found.stands);
  const Ending ending = ending_of(drive, {}, {.longest_step = 1e-4, .first_time = 20.0});
  EXPECT_EQ(ending.kind, EndKind::fades);
  EXPECT_NEAR(ending.load_position, -error, 1e-7);
  drive.controller.integral = 40.0;
  const Ending integrated = ending_of(drive, {}, {.longest_step = 1e-4, .first_time = 80.0});
  EXPECT_EQ(integrated.kind, EndKind::fades);
  EXPECT_EQ(integrated.time, 80.0);
  EXPECT_NEAR(integrated.load_position, 0.0, 1e-9);
}

TEST(OracleMovingReference, AShaftSticksAndSlipsBehindARamp) {
  PlainDrive drive = joined();
  drive.motor = {.inertia = 0.05};
  drive.load = {.inertia = 0.95, .coulomb = 2.0, .breakaway = 3.0};
  drive.stiffness = 1e4;
  drive.damping = 20.0;
  drive.controller.derivative = 0.0;
  drive.reference_course = plain_signal(RampSignal{.rate = 0.1}).course;
  const Ending ending =
      ending_of(drive, {}, {.longest_step = 1e-4, .first_time = 40.0, .trace_period = 5e-3});
  EXPECT_EQ(ending.kind, EndKind::hunts);
  // About the error of sliding, from the breakaway to its mirror image.
  EXPECT_NEAR(ending.amplitude, std::hypot(1.0 / 25.0, 0.1 / 5.0), 2e-4);
}

TEST(OracleMovingReference, AnEncoderCountsARampForEver) {
  PlainDrive drive = joined();
  drive.period = drive.step = 1e-3;
  drive.reference_course = plain_signal(RampSignal{.rate = 0.05 + 5e-6}).course;
  // Readings are late by up to a 20th of a step, over a beat of 10 s, and shrink as it ends.
  const Ending ending = ending_of(drive, {}, {.longest_step = 1e-3, .first_time = 26.0});
  EXPECT_EQ(ending.kind, EndKind::hunts);
  EXPECT_NEAR(ending.amplitude, 0.025e-3, 0.005e-3);
}

TEST(OracleMovingReference, AShaftThatFrictionHoldsRestsUnderASine) {
  PlainDrive drive = joined();
  drive.controller.proportional = 1.0;
  drive.load.coulomb = drive.load.breakaway = drive.motor.coulomb = drive.motor.breakaway = 0.2;
  drive.reference_course = {.amplitude = 0.1, .frequency = 6.0};
  for (const double integral : {0.0, 0.1, 0.5}) {
    drive.controller.integral = integral;  // it swings by integral · 0.1/6
    const Ending ending = ending_of(drive, {}, {.longest_step = 1e-4, .first_time = 20.0});
    EXPECT_EQ(ending.kind, EndKind::fades) << integral;
  }
  drive.reference = 1e-3;  // which is integrated, until it breaks away
  EXPECT_NE(ending_of(drive, {}, {.longest_step = 1e-4, .first_time = 20.0}).kind, EndKind::fades);
}

TEST(OracleMovingReference, RestIsNotSeenBeforeTheReferenceHasCome) {
  PlainDrive drive = joined();
  drive.load.coulomb = drive.load.breakaway = drive.motor.coulomb = drive.motor.breakaway = 1.0;
  drive.period = 1e-3;
  drive.reference_course =
      plain_signal(StepSignal{.before = 0.0, .after = 0.5, .time = 3.0}).course;
  drive.reference = 0.5;
  const Extremes found = extremes_between(drive, {}, 2.0, 20.0);
  EXPECT_EQ(found.load.low, 0.0);
  EXPECT_GT(found.load.high, 0.4);
  EXPECT_TRUE(found.stands);
  EXPECT_LT(found.time, 20.0);
}

TEST(OracleMovingReference, RestIsNotSeenWhileASineIsWithinADeadBand) {
  PlainDrive drive = joined();
  drive.load.coulomb = drive.load.breakaway = 0.1;
  drive.period = 1e-3;
  drive.controller.derivative = 0.0;
  drive.controller.rule = PlainErrorRule::excess;
  drive.controller.width = 0.05;
  drive.reference_course = {.amplitude = 0.1, .frequency = 6.0};
  const Ending ending = ending_of(drive, {}, {.longest_step = 1e-4, .first_time = 20.0});
  EXPECT_EQ(ending.kind, EndKind::hunts);
}

TEST(OracleExtremes, AreThoseOfTheTimesAskedFor) {
  PlainDrive drive;
  drive.backlash = 1000.0;
  drive.load.viscous = 0.5;
  const ShaftReadings start{.load_position = 1.0, .load_speed = 2.0};  // 1 + 4 (1 − exp(−t/2))
  const Extremes found = extremes_between(drive, start, 1.0, 3.0);
  EXPECT_NEAR(found.load.low, 5.0 - 4.0 * std::exp(-0.5), 0.02);
  EXPECT_NEAR(found.load.high, 5.0 - 4.0 * std::exp(-1.5), 0.02);
  EXPECT_EQ(found.error.low, -found.load.high);
  EXPECT_FALSE(found.stands);
  drive.load.coulomb = drive.load.breakaway = 1.0;
  EXPECT_TRUE(extremes_between(drive, start, 5.0, 50.0).stands);
  EXPECT_LT(extremes_between(drive, start, 5.0, 50.0).time, 5.0);
}

TEST(OracleEnding, AnIntegralThatWindsUpBehindALimitLeavesTheShaftsAtRest) {
  PlainDrive drive = joined();
  drive.controller.integral = 2.0;
  drive.limit = 0.5;
  drive.load.coulomb = drive.load.breakaway = 1.0;
  drive.motor.viscous = 3.0;
  EXPECT_EQ(ending_of(drive, {0.0, 0.0, 0.3, 0.0}, {.longest_step = 1e-4}).kind, EndKind::fades);
}

}  // namespace
}  // namespace gearlash::oracle::simulator_laws_test
