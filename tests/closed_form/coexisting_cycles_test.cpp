// Servos with bounces that have several cycles at once: none is missed, none is listed as another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "closed_form/limit_cycle.hpp"

namespace gearlash::coexisting_cycles_test {
namespace {

struct Expected {
  CycleKind kind;
  double amplitude;
  double period;
  bool stable;
};

constexpr auto symmetric = CycleKind::symmetric;
constexpr auto asymmetric = CycleKind::asymmetric;
constexpr auto subharmonic = CycleKind::subharmonic;

/// How often a cycle is listed, to the six digits that are given.
long times_listed(const LimitCycleAnalysis& analysis, const Expected& expected) {
  constexpr double printed = 5e-6;
  return std::count_if(
      analysis.cycles.begin(), analysis.cycles.end(), [&](const LimitCycle& cycle) {
        return cycle.kind == expected.kind && cycle.stable == expected.stable &&
               std::abs(cycle.amplitude - expected.amplitude) <= printed * expected.amplitude &&
               std::abs(cycle.period - expected.period) <= printed * expected.period;
      });
}

/// Of a servo's damping, inertia and friction ratio, backlash and restitution each cycle is listed
/// once. Longer unstable ones may be listed besides. That a cycle returns to itself is tested
/// elsewhere.
void expect_cycles(const NormalizedServo& servo, const std::vector<Expected>& expected) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  for (const Expected& cycle : expected) {
    EXPECT_EQ(times_listed(analysis, cycle), 1) << cycle.amplitude;
  }
}

/// The stable ones are these and no others.
void expect_stable(const NormalizedServo& servo, const std::vector<Expected>& expected) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const auto stable = std::count_if(analysis.cycles.begin(), analysis.cycles.end(),
                                    [](const LimitCycle& cycle) { return cycle.stable; });
  EXPECT_EQ(static_cast<std::size_t>(stable), expected.size());
  for (const Expected& cycle : expected) {
    EXPECT_EQ(times_listed(analysis, cycle), 1) << cycle.amplitude;
  }
}

/// One of eight motions ends in the first, which repeats after twelve crossings of the gap.
TEST(CoexistingCycles, TwoStableOnes) {
  expect_stable({0.1, 1.0, 0.2, 0.3, 0.9}, {{subharmonic, 0.209036, 33.703174, true},
                                            {subharmonic, 0.207071, 22.193648, true}});
}

/// With bounces that settle on one and do not on the other, and the border between them.
TEST(CoexistingCycles, TwoStableOnesAndTheirBorder) {
  expect_cycles({0.31080011774044658, 0.50430488091103387, 0.40399169280360947, 0.3, 0.3},
                {{symmetric, 0.150349018, 7.822701, true},
                 {symmetric, 0.146112241, 7.915650, false},
                 {symmetric, 0.144659386, 7.943506, true}});
}

/// The largest is between amplitudes of a scan four times as coarse.
TEST(CoexistingCycles, TheScanIsFineEnough) {
  expect_cycles(
      {0.12958038746223441, 3.7427216142860131, 0.30865510795801154, 0.3, 0.92472818955456493},
      {{symmetric, 0.140915, 6.63259, false},
       {symmetric, 0.140304, 6.08952, true},
       {symmetric, 0.120543, 6.51219, false}});
}

/// Three of them differ by some 1e-5 … 1e-4: Newton's method on the way to one passes by another.
TEST(CoexistingCycles, NeighboursAreToldApart) {
  expect_cycles(
      {0.048970436296528357, 0.31095601338847551, 0.41058147176417631, 0.3, 0.62171935005586854},
      {{subharmonic, 1.2163, 18.3924, false},
       {symmetric, 1.21622, 6.131, false},
       {subharmonic, 1.21608, 12.2615, false},
       {symmetric, 1.21008, 6.12807, false},
       {symmetric, 1.19815, 6.12284, true}});
}

/// The first is found by three of its periods.
TEST(CoexistingCycles, OneGoneRoundSeveralTimesIsItself) {
  expect_cycles(
      {0.091062287546922679, 2.9163421631616244, 0.44677188367358722, 0.3, 0.79268403616092142},
      {{asymmetric, 0.183249, 6.03087, true},
       {symmetric, 0.178473, 5.95531, false},
       {symmetric, 0.16661, 6.34564, false}});
}

TEST(CoexistingCycles, OfThreeTraversals) {
  expect_cycles(
      {0.15162290609739482, 0.32060342957060811, 0.84808193673730847, 0.3, 0.69707352914265508},
      {{symmetric, 0.41531, 6.39705, true},
       {symmetric, 0.400449, 6.50192, false},
       {subharmonic, 0.397496, 19.5445, false},
       {subharmonic, 0.387818, 19.5998, false},
       {subharmonic, 0.377803, 13.0834, false},
       {symmetric, 0.371911, 6.5406, false}});
}

}  // namespace
}  // namespace gearlash::coexisting_cycles_test
