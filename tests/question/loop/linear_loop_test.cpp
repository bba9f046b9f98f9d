// Figures of the linear loop beside formulas worked out by hand.
#include "question/loop/linear_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>

#include "controllers.hpp"

namespace gearlash::drive::linear_loop_test {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr double turn = 2.0 * pi;  // from Hz to rad/s

/// Crossings of 64 steps a decade are refined to rounding, which the loop's slopes amplify little.
constexpr double near = 1e-9;

/// J = 0.03 kg m², F = 0.05 N m s/rad, sensors on the load.
ReducedDrive rigid_drive() {
  ReducedDrive drive;
  drive.motor = {0.01, {.viscous = 0.02}};
  drive.load = {0.02, {.viscous = 0.03}};
  drive.backlash = 0.01;
  drive.sensing = {.load_share_of_position = 1.0, .load_share_of_speed = 1.0};
  drive.controller = at_load(PID{.proportional = 2.0});
  return drive;
}
constexpr double inertia = 0.03;
constexpr double friction = 0.05;

/// By bisection. Precondition: one change of sign.
template <class Function>
double root(const Function& function, double low, double high) {
  const bool is_negative = function(low) < 0.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((function(middle) < 0.0) == is_negative ? low : high) = middle;
  }
  return low;
}

/// Checks the figures of a loop with one crossover between two frequencies, by its L and its
/// reference's gain as functions of the frequency.
template <class Open, class Closed>
void expect_figures(const ReducedDrive& drive, const Open& open, const Closed& closed, double low,
                    double high) {
  const std::optional<LinearLoop> figures = loop_figures(drive);
  ASSERT_TRUE(figures);
  EXPECT_TRUE(figures->is_stable);
  const double crossover = root([&](double w) { return std::log(std::abs(open(w))); }, low, high);
  ASSERT_TRUE(figures->crossover && figures->phase_margin && figures->bandwidth);
  EXPECT_NEAR(turn * *figures->crossover, crossover, near * crossover);
  EXPECT_NEAR(*figures->phase_margin, pi - std::abs(std::arg(open(crossover))), near);
  const double bandwidth =
      root([&](double w) { return std::abs(closed(w)) - std::sqrt(0.5); }, low, high);
  EXPECT_NEAR(turn * *figures->bandwidth, bandwidth, near * bandwidth);
}

TEST(OracleLinearLoop, IsThatOfASecondOrderServo) {
  for (const double stiffness : {0.001, 0.02, 2.0, 500.0}) {
    ReducedDrive drive = rigid_drive();
    drive.controller = at_load(PID{.proportional = stiffness});
    const auto open = [&](double w) { return stiffness / Complex(-inertia * w * w, friction * w); };
    const auto closed = [&](double w) { return open(w) / (1.0 + open(w)); };
    expect_figures(drive, open, closed, 1e-4, 1e4);
  }
}

TEST(OracleLinearLoop, HasFilterWindingAndWeight) {
  ReducedDrive drive = rigid_drive();
  const PID pid{.terms = PIDTerms::PID,
                .proportional = 5.0,
                .integral = 8.0,
                .derivative = 0.4,
                .filter = 4e-3};
  drive.controller = at_load(pid);
  drive.winding = {.time_constant = 2e-3, .back_emf = 0.07};
  drive.gravity = {.torque = 0.0, .stiffness = 0.6, .angle = 0.0};
  const auto open = [&](double w) {
    const Complex s{0.0, w};
    const Complex controller =
        pid.proportional + pid.integral / s + pid.derivative * s / (pid.filter * s + 1.0);
    const Complex lag = 1.0 + 2e-3 * s;
    return controller / (lag * (inertia * s * s + friction * s + 0.6) + 0.07 * s);
  };
  const auto closed = [&](double w) { return open(w) / (1.0 + open(w)); };
  expect_figures(drive, open, closed, 5.0, 100.0);
}

TEST(OracleLinearLoop, OfACascadeFeedsTheSpeedOfTheMotorBack) {
  ReducedDrive drive = rigid_drive();
  const CascadeController cascade{
      .position = 6.0, .speed = 0.9, .speed_integral = 4.0, .filter = 3e-3};
  drive.controller = at_load(cascade);
  drive.sensing = {.load_share_of_position = 1.0, .load_share_of_speed = 0.0};
  drive.contact = CompliantContact{.stiffness = 900.0, .damping = 0.1};
  const auto speed_controller = [&](const Complex& s) {
    return cascade.speed + cascade.speed_integral / s;
  };
  const auto faces = [](const Complex& s) { return 900.0 + 0.1 * s; };
  const auto load = [&](const Complex& s) { return 0.02 * s * s + 0.03 * s + faces(s); };
  const auto motor_position = [&](const Complex& s) {
    return 1.0 / (0.01 * s * s + 0.02 * s + faces(s) - faces(s) * faces(s) / load(s));
  };
  const auto load_position = [&](const Complex& s) {
    return faces(s) / load(s) * motor_position(s);
  };
  const auto open = [&](double w) {
    const Complex s{0.0, w};
    return speed_controller(s) *
           (cascade.position * load_position(s) + s / (3e-3 * s + 1.0) * motor_position(s));
  };
  const auto closed = [&](double w) {
    const Complex s{0.0, w};
    return speed_controller(s) * cascade.position * load_position(s) / (1.0 + open(w));
  };
  const std::optional<LinearLoop> figures = loop_figures(drive);
  ASSERT_TRUE(figures);
  EXPECT_TRUE(figures->is_stable);
  // The resonance of both shafts makes three crossovers: all are found by steps of 1e-5.
  double least = pi;
  double at_least = 0.0;
  int count = 0;
  for (double w = 1.0; w < 1e4; w *= 1.00001) {
    if ((std::abs(open(w)) < 1.0) == (std::abs(open(w * 1.00001)) < 1.0)) continue;
    const double crossover =
        root([&](double at) { return std::log(std::abs(open(at))); }, w, w * 1.00001);
    ++count;
    const double margin = pi - std::abs(std::arg(open(crossover)));
    if (margin >= least) continue;
    least = margin;
    at_least = crossover;
  }
  EXPECT_EQ(count, 3);
  EXPECT_GT(at_least, 100.0);  // not the first
  EXPECT_NEAR(*figures->phase_margin, least, near);
  EXPECT_NEAR(turn * *figures->crossover, at_least, near * at_least);
  double w = 0.1;
  while (std::abs(closed(w)) > std::sqrt(0.5)) w *= 1.001;
  const double bandwidth =
      root([&](double at) { return std::abs(closed(at)) - std::sqrt(0.5); }, w / 1.001, w);
  EXPECT_NEAR(turn * *figures->bandwidth, bandwidth, near * bandwidth);
}

/// L(z) of proportional control with speed by differences of a shaft without friction, held and
/// delayed.
struct SampledByHand {
  double period;
  int whole_periods;
  double rest;
  double proportional;
  double derivative;

  Complex open(double w) const {
    const Complex z = std::polar(1.0, w * period);
    const double left = period - rest;
    const Complex earlier = std::pow(z, -whole_periods - 1);
    const Complex later = std::pow(z, -whole_periods);
    const Complex to_speed = (rest * earlier + left * later) / inertia;
    const Complex to_position =
        (0.5 * (period * period - left * left) * earlier + 0.5 * left * left * later) / inertia;
    const Complex position =
        ((z - 1.0) * to_position + period * to_speed) / ((z - 1.0) * (z - 1.0));
    return (proportional + derivative * (1.0 - 1.0 / z) / period) * position;
  }
  Complex closed(double w) const {
    const Complex z = std::polar(1.0, w * period);
    const Complex feedback = proportional + derivative * (1.0 - 1.0 / z) / period;
    return proportional / feedback * open(w) / (1.0 + open(w));
  }
};

TEST(OracleLinearLoop, OfASampledDriveIsExact) {
  for (const double periods : {0.0, 0.4, 1.0, 3.25}) {
    const double period = 4e-3;
    const double whole = periods == 0.0 ? 0.0 : std::ceil(periods) - 1.0;
    const SampledByHand hand{.period = period,
                             .whole_periods = static_cast<int>(whole),
                             .rest = (periods - whole) * period,
                             .proportional = 2.0,
                             .derivative = 0.5};
    ReducedDrive drive = rigid_drive();
    drive.motor.friction.viscous = drive.load.friction.viscous = 0.0;
    drive.controller = at_load(PID{PIDTerms::PD, 2.0, 0.0, 0.5});
    drive.sampling = Sampling{.period = period, .delay = periods * period};
    expect_figures(
        drive, [&](double w) { return hand.open(w); }, [&](double w) { return hand.closed(w); },
        4.0, 100.0);
  }
}

TEST(OracleLinearLoop, OfAFastSampledDriveIsThatOfADelay) {
  const PID pid{.terms = PIDTerms::PID,
                .proportional = 5.0,
                .integral = 8.0,
                .derivative = 0.4,
                .filter = 4e-3};
  ReducedDrive drive = rigid_drive();
  drive.controller = at_load(pid);
  const double delay = 5e-3;
  // The hold counts as half a period; Tustin's rule and the hold err by (ωT)²/12.
  const double period = 1e-4;
  drive.sampling = Sampling{.period = period, .delay = delay};
  const auto open = [&](double w) {
    const Complex s{0.0, w};
    return (pid.proportional + pid.integral / s + pid.derivative * s / (pid.filter * s + 1.0)) /
           (inertia * s * s + friction * s) * std::exp(-s * (delay + 0.5 * period));
  };
  const double crossover = root([&](double w) { return std::log(std::abs(open(w))); }, 5.0, 100.0);
  const std::optional<LinearLoop> figures = loop_figures(drive);
  ASSERT_TRUE(figures && figures->phase_margin);
  const double error = std::pow(crossover * period, 2.0);
  EXPECT_NEAR(turn * *figures->crossover, crossover, error * crossover);
  EXPECT_NEAR(*figures->phase_margin, pi + std::arg(open(crossover)), error);
}

/// Whole periods of delay turn L and leave its size.
TEST(PropertyLinearLoop, TheMarginIsTheDelayThatMakesItUnstable) {
  constexpr unsigned seed = 20261124;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.5, 2.0);
  for (int i = 0; i < 20; ++i) {
    ReducedDrive drive = rigid_drive();
    drive.controller = at_load(PID{PIDTerms::PD, 2.0 * share(random), 0.0, 0.3 * share(random)});
    drive.sampling = Sampling{.period = 3e-3 * share(random)};
    const std::optional<LinearLoop> figures = loop_figures(drive);
    ASSERT_TRUE(figures && figures->phase_margin);
    const double period = drive.sampling->period;
    const double periods =
        std::floor(*figures->phase_margin / (turn * *figures->crossover * period));
    drive.sampling->delay = periods * period;
    EXPECT_TRUE(loop_figures(drive)->is_stable);
    drive.sampling->delay = (periods + 1.0) * period;
    EXPECT_FALSE(loop_figures(drive)->is_stable);
  }
}

void expect_none(const std::optional<LinearLoop>& figures) {
  ASSERT_TRUE(figures);
  EXPECT_FALSE(figures->is_stable);
  EXPECT_FALSE(figures->bandwidth);
  EXPECT_FALSE(figures->phase_margin);
  EXPECT_FALSE(figures->crossover);
}

TEST(EdgeLinearLoop, AnUnstableLoopHasNoFigures) {
  ReducedDrive drive = rigid_drive();
  // s³ J + s² F + K s + I is stable up to I = F K/J.
  const double most = friction * 2.0 / inertia;
  drive.controller =
      at_load(PID{.terms = PIDTerms::PID, .proportional = 2.0, .integral = 0.999 * most});
  EXPECT_TRUE(loop_figures(drive)->is_stable);
  EXPECT_TRUE(loop_figures(drive)->phase_margin);
  drive.controller =
      at_load(PID{.terms = PIDTerms::PID, .proportional = 2.0, .integral = 1.001 * most});
  expect_none(loop_figures(drive));
  drive = rigid_drive();
  drive.motor.friction.viscous = drive.load.friction.viscous = 0.0;
  expect_none(loop_figures(drive));  // swings for ever
  drive = rigid_drive();
  drive.controller = at_load(PID{});
  expect_none(loop_figures(drive));  // may stand anywhere
}

TEST(EdgeLinearLoop, WhatThereIsNotIsAbsent) {
  ReducedDrive drive = rigid_drive();
  drive.gravity.stiffness = 4.0;
  drive.motor.friction.viscous = 1.0;  // no resonance
  std::optional<LinearLoop> figures = loop_figures(drive);
  ASSERT_TRUE(figures);
  EXPECT_TRUE(figures->is_stable);
  EXPECT_FALSE(figures->phase_margin);  // |L| is at most 2/4
  EXPECT_FALSE(figures->crossover);
  EXPECT_TRUE(figures->bandwidth);
  drive.controller = at_load(PID{});
  figures = loop_figures(drive);
  ASSERT_TRUE(figures);
  EXPECT_TRUE(figures->is_stable);
  EXPECT_FALSE(figures->phase_margin);
  EXPECT_FALSE(figures->bandwidth);  // no reference acts
}

TEST(EdgeLinearLoop, OfARelayThereIsNone) {
  ReducedDrive drive = rigid_drive();
  drive.error_shape = {.begins = 0.01,
                       .ends = -0.01,
                       .inner_gain = 0.0,
                       .outer_gain = 0.0,
                       .offset = 1.0,
                       .jumps = true};
  EXPECT_FALSE(loop_figures(drive));
}

TEST(EdgeLinearLoop, WhatIsNotLinearIsLeftOut) {
  const ReducedDrive plain = rigid_drive();
  ReducedDrive drive = plain;
  drive.motor.friction.coulomb = drive.motor.friction.breakaway = 0.3;
  drive.torque_limit = 0.1;
  drive.sensing.resolution = 0.01;
  drive.error_shape = {.begins = 0.1, .ends = 0.1, .inner_gain = 0.0, .offset = -0.1};
  EXPECT_EQ(loop_figures(drive)->bandwidth, loop_figures(plain)->bandwidth);
  EXPECT_EQ(loop_figures(drive)->phase_margin, loop_figures(plain)->phase_margin);
}

TEST(EdgeLinearLoop, AFaultyDriveIsRefused) {
  ReducedDrive drive = rigid_drive();
  drive.load.inertia = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(loop_figures(drive), InvalidInput);
}

}  // namespace
}  // namespace gearlash::drive::linear_loop_test
