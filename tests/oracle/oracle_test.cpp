// The everyday part of the oracle: random servos that are not stiff against Boost.odeint, stiff
// ones against the matrix exponential. oracle_run does a thousand
// (docs/explanation/verification.md).

#include <gtest/gtest.h>

#include <cstdint>

#include "comparison.hpp"
#include "dissipation.hpp"
#include "raw_equations.hpp"
#include "reference_cycle.hpp"

namespace gearlash::oracle::oracle_test {
namespace {

constexpr std::uint64_t seed = 1960;

/// Filter: the explicit method's time grows with the fastest rate, so the everyday part leaves to
/// it the servos with all rates below this; every third servo drawn is stiffer.
constexpr double everyday_rate = 30.0;

bool suits_odeint(const NormalizedServo& servo) {
  return raw_servo<double>(servo).fastest_rate() <= everyday_rate;
}

/// Compares the first `wanted` cases of the seed for which the filter gives `odeint`.
void expect_agreement(int wanted, bool odeint) {
  ComparisonOptions options;
  options.fastest_rate_for_odeint = everyday_rate;
  std::uint64_t index = 0;
  for (int taken = 0; taken < wanted; ++index) {
    const RandomCase drawn = random_case(seed, index);
    if (suits_odeint(drawn.servo) != odeint) continue;
    ++taken;
    const CaseReport report = compare(drawn, options);
    EXPECT_EQ(report.failure, "") << "seed " << seed << ", servo " << index << ": "
                                  << describe(drawn);
    EXPECT_LT(report.reference_difference, 1e-14) << "the references disagree: servo " << index;
  }
}

TEST(Oracle, TrajectoriesAgreeWithBoostOdeintInExtendedPrecision) { expect_agreement(100, true); }

TEST(Oracle, StiffTrajectoriesAgreeWithTheMatrixExponential) { expect_agreement(60, false); }

TEST(Oracle, LimitCyclesAreWhatLongRunsOfTheReferenceSettleOn) {
  for (const CycleCheck& check : check_known_cycles()) {
    EXPECT_TRUE(check.agrees) << "damping " << check.servo.damping << ", restitution "
                              << check.servo.restitution << ": amplitude "
                              << check.library_amplitude << " against " << check.reference_amplitude
                              << ", period " << check.library_period << " against "
                              << check.reference_period;
  }
}

TEST(Oracle, ServosThatOnlyTakeEnergyFromTheGapComeToRest) {
  int followed = 0;
  for (std::uint64_t index = 0; index < 100; ++index) {
    const DissipationCheck check = check_dissipation(seed, index);
    followed += check.exhausted ? 0 : 1;
    EXPECT_FALSE(check.hunts) << "seed " << seed << ", " << describe(check.drawn) << ": "
                              << check.late << " after " << check.early;
  }
  EXPECT_GT(followed, 80);
}

TEST(Oracle, IrregularHuntingIsAsLargeAsInALongRunOfTheReference) {
  const IrregularCheck check = check_irregular_motion();
  EXPECT_TRUE(check.agrees) << check.library_amplitude << " against " << check.reference_amplitude;
}

}  // namespace
}  // namespace gearlash::oracle::oracle_test
