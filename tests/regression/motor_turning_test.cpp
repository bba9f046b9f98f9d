// The motor's size was wrong by up to 81 % where the guess at its turning point lay at an extremum
// of its speed, at which Halley's step is as short as at a zero; and by up to 8e-9 where the load's
// decay, not the motor's, is fast.
#include <gtest/gtest.h>

#include "base/bracketed_root.hpp"
#include "closed_form/extremes.hpp"
#include "closed_form/limit_cycle.hpp"
#include "closed_form/trajectory.hpp"
#include "question/map/servo_grids.hpp"

namespace gearlash::motor_turning_test {
namespace {

struct Known {
  double damping, inertia_ratio, friction_ratio;
  double motor_amplitude;  ///< worked out in sixty digits, for a backlash of 1
};

constexpr Known known[] = {
    {0.75301793624945368, 2.862359161235303, 0.00023657105803378943, 0.36169533173516475},
    {0.99, 1.0724810495425217, 0.00010855023998510215, 0.34736245093157165},
    {0.96740729569509776, 1321.6742630316994, 0.9999, 0.50000122170230255},
    {0.59477736347793786, 2.247704970748797, 0.89676936817045927, 0.51218874604756209},
    {0.29855024802459817, 5674.2271991383941, 0.99921107993840164, 0.50000049139773637}};

TEST(RegressionMotorTurning, IsFoundOneByOneAndSideBySide) {
  for (const Known& one : known) {
    const NormalizedServo servo{.damping = one.damping,
                                .inertia_ratio = one.inertia_ratio,
                                .friction_ratio = one.friction_ratio,
                                .backlash = 1.0};
    EXPECT_NEAR(analyse_limit_cycles(servo).cycles.at(0).motor_amplitude, one.motor_amplitude,
                1e-13 * one.motor_amplitude);
    for (const VectorUnit unit : available_vector_units()) {
      Table table = table_of(1);
      find_limit_cycles({&servo, 1}, columns_of(table), unit);
      EXPECT_NEAR(table[Quantity::motor_amplitude].front(), one.motor_amplitude,
                  1e-13 * one.motor_amplitude);
    }
  }
}

TEST(RegressionMotorTurning, IsWhereTheSimulatorTurns) {
  const NormalizedServo servo{.damping = 1.46767004541306640,
                              .inertia_ratio = 0.0020524752465697189,
                              .friction_ratio = 1.0360180589219513e-08,
                              .backlash = 1.0};
  const LimitCycle cycle = analyse_limit_cycles(servo).cycles.at(0);
  const Trajectory motion =
      simulate(servo, cycle.start, {.until = 1.5 * cycle.period, .reference = 0.0});
  const Extremes turns = extremes(motion, 0.25 * cycle.period, 1.25 * cycle.period);
  EXPECT_NEAR(cycle.motor_amplitude, turns.motor_amplitude(), 1e-9 * cycle.motor_amplitude);
}

/// x³ − 12 x + 20 has its zero at −4.27…, a minimum at 2 and a maximum at −2.
TEST(RegressionMotorTurning, RootFinderDoesNotTakeAnExtremumForAZero) {
  const auto cubic = [](double x) {
    return ValueAndSlope{x * x * x - 12.0 * x + 20.0, 3.0 * x * x - 12.0, 6.0 * x};
  };
  const auto mirrored = [&](double x) {  // brackets begin at 0 or above
    const ValueAndSlope at = cubic(5.0 - x);
    return ValueAndSlope{at.value, -at.slope, at.curvature};
  };
  const double root = bracketed_root(mirrored, 0.0, 20.0, 7.0 + 1e-9, -1.0, 1e-3);
  EXPECT_NEAR(cubic(5.0 - root).value, 0.0, 0.1);
}

}  // namespace
}  // namespace gearlash::motor_turning_test
