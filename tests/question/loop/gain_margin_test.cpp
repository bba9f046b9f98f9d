// Gain margin and lag of the linear loop beside formulas worked out by hand, and the gain at which
// a loop really is at the border of stability.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "controllers.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/loop_gain.hpp"
#include "question/loop/linear_loop.hpp"

namespace gearlash::drive::gain_margin_test {
namespace {

using Complex = std::complex<double>;
constexpr double turn = 2.0 * std::numbers::pi;  // from Hz to rad/s
constexpr double near = 1e-9;

/// J = 0.03 kg m², sensors on the load.
constexpr double inertia = 0.03;
ReducedDrive rigid_drive(double friction) {
  ReducedDrive drive;
  drive.motor = {0.01, {.viscous = 0.4 * friction}};
  drive.load = {0.02, {.viscous = 0.6 * friction}};
  drive.backlash = 0.01;
  drive.sensing = {.load_share_of_position = 1.0, .load_share_of_speed = 1.0};
  drive.controller = at_load(PID{.proportional = 2.0});
  return drive;
}

void expect_margin(const ReducedDrive& drive, double margin, double frequency) {
  const std::optional<LinearLoop> figures = loop_figures(drive);
  ASSERT_TRUE(figures && figures->is_stable);
  ASSERT_TRUE(figures->gain_margin && figures->phase_crossover);
  EXPECT_NEAR(*figures->gain_margin, margin, near * margin);
  EXPECT_NEAR(turn * *figures->phase_crossover, frequency, near * frequency);
}

// ---- gain margin --------------------------------------------------------------------------------

/// L = K/(F s (T s + 1)(J/F s + 1)) is −K T T′/(F (T + T′)) at ω = 1/√(T T′), T′ = J/F.
TEST(OracleGainMargin, OfTwoLagsAndAnIntegral) {
  for (const double friction : {0.03, 0.3, 3.0}) {
    for (const double lag : {1e-3, inertia / friction, 0.2}) {
      ReducedDrive drive = rigid_drive(friction);
      const double other = inertia / friction;
      const double highest = friction * (1.0 / lag + 1.0 / other);
      drive.controller = at_load(PID{.proportional = 0.3 * highest});
      drive.winding = {.time_constant = lag};
      expect_margin(drive, 1.0 / 0.3, 1.0 / std::sqrt(lag * other));
    }
  }
}

/// J s³ + (F + k D) s² + k K s + k I is stable above k = (J I/K − F)/D, with ω² = k K/J there.
TEST(OracleGainMargin, IsBelowOneWhereTheGainMayNotFall) {
  ReducedDrive drive = rigid_drive(0.01);
  drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                 .proportional = 2.0,
                                 .integral = 6.0,
                                 .derivative = 0.4,
                                 .derivative_of_speed = true});
  const double margin = (inertia * 6.0 / 2.0 - 0.01) / 0.4;
  ASSERT_LT(margin, 1.0);
  expect_margin(drive, margin, std::sqrt(margin * 2.0 / inertia));
}

/// Of a load that tips over L(0) = −K/k: the gain holds it down to k/K.
TEST(OracleGainMargin, CountsFrequencyZero) {
  ReducedDrive drive = rigid_drive(0.3);
  drive.gravity.stiffness = -0.5;
  expect_margin(drive, 0.25, 0.0);
}

TEST(EdgeGainMargin, OfASecondOrderServoThereIsNone) {
  for (const double stiffness : {0.001, 2.0, 500.0}) {
    ReducedDrive drive = rigid_drive(0.05);
    drive.controller = at_load(PID{.proportional = stiffness});
    EXPECT_FALSE(loop_figures(drive)->gain_margin);
    EXPECT_FALSE(loop_figures(drive)->phase_crossover);
    drive.controller = at_load(PID{PIDTerms::PD, stiffness, 0.0, 0.02 * stiffness});
    EXPECT_FALSE(loop_figures(drive)->gain_margin);
    drive.gravity.stiffness = 0.5;  // L(0) > 0
    EXPECT_FALSE(loop_figures(drive)->gain_margin);
  }
  ReducedDrive unstable = rigid_drive(0.05);
  unstable.gravity.stiffness = -3.0;
  EXPECT_FALSE(loop_figures(unstable)->is_stable);
  EXPECT_FALSE(loop_figures(unstable)->gain_margin);
}

/// Without friction, of a tachometer, a = K T²/(2J) and b = D T/J:
///   L = (a (z + 1) + b (z − 1))/(z − 1)²,
/// which is −b/2 at z = −1: the gain may grow by 2/b. With a delay of T the pair of roots on the
/// unit circle is at k = (b − 3a)/(a − b)², cos ωT = 1 + k (a − b)/2 (Jury).
TEST(OracleGainMargin, OfASampledLoopIsThatInZ) {
  const double period = 4e-3;
  for (const double derivative : {0.3, 0.9, 2.0}) {
    ReducedDrive drive = rigid_drive(0.0);
    drive.controller = at_load(PID{PIDTerms::PD, 2.0, 0.0, derivative});
    drive.sampling = Sampling{.period = period, .speed_by_differences = false};
    const double a = 2.0 * period * period / (2.0 * inertia);
    const double b = derivative * period / inertia;
    expect_margin(drive, 2.0 / b, std::numbers::pi / period);
    drive.sampling->delay = period;
    const double margin = (b - 3.0 * a) / std::pow(a - b, 2.0);
    expect_margin(drive, margin, std::acos(1.0 + 0.5 * margin * (a - b)) / period);
  }
}

ReducedDrive random_drive(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, share(random));
  };
  const auto one_in = [&](double n) { return share(random) * n < 1.0; };
  ReducedDrive drive = rigid_drive(between(0.01, 1.0));
  drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                 .proportional = between(0.5, 20.0),
                                 .integral = one_in(2.0) ? between(0.1, 30.0) : 0.0,
                                 .derivative = between(0.02, 1.0),
                                 .filter = between(1e-4, 1e-2),
                                 .derivative_of_speed = one_in(2.0)});
  if (one_in(3.0)) drive.contact = CompliantContact{between(50.0, 5e3), between(0.01, 1.0)};
  if (one_in(2.0)) drive.sensing.load_share_of_position = drive.sensing.load_share_of_speed = 0.0;
  if (one_in(3.0)) drive.winding = {.time_constant = between(1e-4, 1e-2), .back_emf = 0.05};
  if (one_in(3.0)) drive.gravity.stiffness = one_in(2.0) ? -0.3 : 0.4;
  if (one_in(3.0)) drive.sampling = Sampling{between(1e-4, 5e-3), between(1e-5, 5e-3)};
  return drive;
}

bool is_stable(ReducedDrive drive, double gain) {
  for (double& number : drive.controller.output) number *= gain;
  for (double& number : drive.controller.direct) number *= gain;
  return loop_decays(linear_drive(EnclosedDrive(drive)));
}

TEST(PropertyGainMargin, IsTheGainNextToOneAtTheBorder) {
  constexpr unsigned seed = 20261130;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  int above = 0;
  int below = 0;
  int without = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const ReducedDrive drive = random_drive(random);
    const std::optional<LinearLoop> figures = loop_figures(drive);
    ASSERT_TRUE(figures);
    if (!figures->is_stable) continue;
    if (!figures->gain_margin) {
      ++without;
      for (const double gain : {1e-2, 0.3, 3.0, 1e2}) EXPECT_TRUE(is_stable(drive, gain));
      continue;
    }
    const double margin = *figures->gain_margin;
    ++(margin > 1.0 ? above : below);
    for (const double power : {0.5, 0.99, -0.5, -0.99}) {
      EXPECT_TRUE(is_stable(drive, std::pow(margin, power))) << margin << " " << power;
    }
    EXPECT_FALSE(is_stable(drive, std::pow(margin, 1.001))) << margin;
  }
  EXPECT_GT(above, 50);
  EXPECT_GT(below, 20);
  EXPECT_GT(without, 10);
}

// ---- lag ----------------------------------------------------------------------------------------

void expect_lag(const ReducedDrive& drive, double lag) {
  const std::optional<LinearLoop> figures = loop_figures(drive);
  ASSERT_TRUE(figures && figures->lag);
  EXPECT_NEAR(*figures->lag, lag, near * lag + 1e-14);
}

/// v/K_v, with K_v = K/F; what is fed back of a speed is friction, and an integral leaves nothing.
TEST(OracleLag, BehindARampIsTheVelocityError) {
  const double rate = -0.7;
  ReducedDrive drive = rigid_drive(0.05);
  drive.reference = Ramp{0.3, rate};
  expect_lag(drive, 0.7 * 0.05 / 2.0);
  PID pid{.terms = PIDTerms::PD, .proportional = 2.0, .derivative = 0.4, .filter = 1e-3};
  drive.controller = at_load(pid);
  expect_lag(drive, 0.7 * 0.05 / 2.0);
  pid.derivative_of_speed = true;
  drive.controller = at_load(pid);
  expect_lag(drive, 0.7 * 0.45 / 2.0);
  drive.winding = {.time_constant = 2e-3, .back_emf = 0.1};
  expect_lag(drive, 0.7 * 0.55 / 2.0);
  drive.sensing = {.load_share_of_position = 0.0, .load_share_of_speed = 0.0};
  drive.contact = CompliantContact{500.0, 0.3};  // twisted by the load's friction
  expect_lag(drive, 0.7 * (0.55 / 2.0 + 0.03 / 500.0));
  pid.terms = PIDTerms::PID;
  pid.integral = 3.0;
  drive.controller = at_load(pid);
  drive.sensing.load_share_of_position = 1.0;
  drive.contact = RigidContact{};
  expect_lag(drive, 0.0);
  drive.gravity.stiffness = 0.6;  // its torque grows: e′ I = v k
  expect_lag(drive, 0.7 * 0.6 / 3.0);
}

/// Of T = K/(J s² + F s + K) with r + l ṙ for the reference, and the torque M r̈: a lead of F/K and
/// the whole inertia follow any reference exactly.
TEST(OracleLag, FallsWithFeedForward) {
  ReducedDrive drive = rigid_drive(0.05);
  drive.reference = Ramp{0.3, 0.7};
  drive.feedforward.lead = 0.01;
  expect_lag(drive, 0.7 * (0.05 / 2.0 - 0.01));
  drive.feedforward.lead = 0.05;
  expect_lag(drive, 0.7 * (0.05 - 0.05 / 2.0));  // ahead of it
  drive.reference = Sine{.mean = 0.1, .amplitude = 0.2, .frequency = 3.0};
  drive.feedforward = {.lead = 0.05 / 2.0, .inertia = inertia};
  expect_lag(drive, 0.0);
  drive.feedforward.inertia = 0.0;
  const std::complex<double> s{0.0, 3.0};
  expect_lag(drive, 0.2 * std::abs(inertia * s * s / (inertia * s * s + 0.05 * s + 2.0)));
}

/// A held torque is constant in the end, so that its delay does not count.
TEST(OracleLag, OfASampledLoopBehindARamp) {
  for (const double delay : {0.0, 3e-3, 1e-2}) {
    ReducedDrive drive = rigid_drive(0.05);
    drive.reference = Ramp{0.0, 0.7};
    drive.sampling = Sampling{.period = 4e-3, .delay = delay};
    expect_lag(drive, 0.7 * 0.05 / 2.0);
    drive.controller = at_load(PID{.terms = PIDTerms::PD,
                                   .proportional = 2.0,
                                   .derivative = 0.2,
                                   .derivative_of_speed = true});
    expect_lag(drive, 0.7 * 0.25 / 2.0);
  }
}

TEST(OracleLag, BehindASineIsItsShareOfTheSensitivity) {
  for (const double frequency : {0.01, 0.4, 8.0, 90.0}) {
    ReducedDrive drive = rigid_drive(0.05);
    drive.reference = Sine{0.5, 0.2, frequency, 0.3};
    drive.load_torque = 0.1;  // droop
    const Complex s{0.0, frequency};
    const Complex plant = inertia * s * s + 0.05 * s;
    expect_lag(drive, 0.2 * std::abs(plant / (plant + 2.0)));
    drive.gravity.stiffness = 0.5;  // droop of what moves is lag
    expect_lag(drive, 0.2 * std::abs((plant + 0.5) / (plant + 2.5)));
  }
}

/// θ(z) = T²/(2J) (z + 1)/(z − 1)² of the held torque K e − D v, v(z) = T/J/(z − 1).
TEST(OracleLag, OfASampledLoopBehindASineIsThatInZ) {
  const double period = 4e-3;
  for (const double frequency : {0.4, 8.0, 90.0, 500.0}) {
    ReducedDrive drive = rigid_drive(0.0);
    drive.controller = at_load(PID{.terms = PIDTerms::PD,
                                   .proportional = 2.0,
                                   .derivative = 0.5,
                                   .derivative_of_speed = true});
    drive.sampling = Sampling{.period = period, .speed_by_differences = false};
    drive.reference = Sine{0.0, 0.2, frequency, 0.0};
    const Complex z = std::polar(1.0, frequency * period);
    const Complex position = period * period / (2.0 * inertia) * (z + 1.0) / std::pow(z - 1.0, 2.0);
    const Complex speed = period / inertia / (z - 1.0);
    expect_lag(drive, 0.2 * std::abs(1.0 - 2.0 * position / (1.0 + 2.0 * position + 0.5 * speed)));
  }
}

TEST(EdgeLag, OfWhatStandsOrGrowsThereIsNone) {
  ReducedDrive drive = rigid_drive(0.05);
  EXPECT_FALSE(loop_figures(drive)->lag);
  drive.reference = 0.4;
  EXPECT_FALSE(loop_figures(drive)->lag);
  drive.reference = Ramp{0.0, 1.0};
  drive.gravity.stiffness = 1e-3;  // droop that grows
  EXPECT_FALSE(loop_figures(drive)->lag);
  drive.gravity.stiffness = 0.0;
  EXPECT_TRUE(loop_figures(drive)->lag);
  drive.controller =
      at_load(PID{.terms = PIDTerms::PID, .proportional = 2.0, .integral = 1e3});  // unstable
  EXPECT_FALSE(loop_figures(drive)->lag);
}

}  // namespace
}  // namespace gearlash::drive::gain_margin_test
