// Where motions end that go ever smaller rounds of events.
#include "hybrid/shrinking_rounds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gearlash::hybrid::shrinking_rounds_test {
namespace {

constexpr double center = 0.3;

/// x″ = −k (x − center) − 0.05 x′, where k is 1 beyond `border` and 4 before it; a wall at `wall`
/// leads to a mode of its own.
HybridSystem swing(double border, double wall) {
  HybridSystem system{.state_names = {"x", "speed"}};
  const auto add = [&](double stiffness, Direction direction, std::size_t target) {
    AffineMode mode;
    mode.flow = {Matrix{{0.0, 1.0}, {-stiffness, -0.05}}, Vector{{0.0, stiffness * center}}};
    mode.transitions = {
        {.guard = {Vector{{1.0, 0.0}}, -border}, .direction = direction, .target = target},
        {.guard = {Vector{{1.0, 0.0}}, -wall}, .target = 2}};
    system.modes.push_back(mode);
  };
  add(1.0, Direction::falling, 1);
  add(4.0, Direction::rising, 0);
  system.modes.emplace_back().flow = {Matrix::Zero(2, 2), Vector::Zero(2)};
  return system;
}

std::optional<RoundsLimit> limit_of(const HybridSystem& system, double until) {
  const Trajectory motion = simulate(system, {0, Vector{{1.0, 0.0}}}, {.until = until});
  return shrinking_rounds(system, motion, 0.5, 0.03);
}

TEST(ShrinkingRounds, LeadToWhereTheirGuardsAndFlowsAreZero) {
  const auto limit = limit_of(swing(center, -5.0), 100.0);
  ASSERT_TRUE(limit);
  EXPECT_NEAR(limit->numbers[0], center, 1e-12);
  EXPECT_NEAR(limit->numbers[1], 0.0, 1e-12);
  // The last round takes 1.5 π s, from e^(−0.025 (100 − 1.5 π)) on.
  EXPECT_GT(limit->off[0], 0.3 * (1.0 - center) * std::exp(-0.025 * 100.0));
  EXPECT_LT(limit->off[0], (1.0 - center) * std::exp(-0.025 * (100.0 - 10.0)));
}

/// The same rounds, and the smaller ones never end at the border: it is not where they shrink to.
TEST(ShrinkingRounds, AreNotThoseAboutAGuardBesideTheirLimit) {
  EXPECT_FALSE(limit_of(swing(center + 0.02, -5.0), 100.0));
}

/// In the mode beyond the border nothing comes to this guard, 0.01 before the limit. That is seen
/// as soon as rounds are smaller than that.
TEST(ShrinkingRounds, AreFollowedUntilOtherGuardsAreClear) {
  HybridSystem system = swing(center, -5.0);
  system.modes[0].transitions[1].guard.offset = -(center - 0.01);
  EXPECT_FALSE(limit_of(system, 100.0));
  EXPECT_TRUE(limit_of(system, 250.0));
}

TEST(ShrinkingRounds, HaveNoReadingsAndNoTicks) {
  HybridSystem system = swing(center, -5.0);
  system.modes[0].transitions[0].reset.quantizers = {
      {{Vector{{1.0, 0.0}}, 0.0}, 100.0, Vector::Zero(2)}};
  EXPECT_FALSE(limit_of(system, 100.0));
  system = swing(center, -5.0);
  system.clocks = {{.first = 1000.0, .period = 1.0}};
  system.modes[0].timed = {{.clock = 0, .target = 0}};
  EXPECT_FALSE(limit_of(system, 100.0));
}

/// Both stiffnesses pull to places of their own: the rounds stay as large as these are apart.
TEST(ShrinkingRounds, NeedOneEquilibriumForAllTheirModes) {
  HybridSystem system = swing(center, -5.0);
  system.modes[1].flow.offset[1] *= 1.05;
  EXPECT_FALSE(limit_of(system, 100.0));
}

TEST(ShrinkingRounds, NeedAResetThatLeavesTheirLimit) {
  HybridSystem system = swing(center, -5.0);
  system.modes[0].transitions[0].reset = {Matrix{{1.0, 0.0}, {0.0, 0.9}}, Vector::Zero(2)};
  EXPECT_TRUE(limit_of(system, 60.0));
  system.modes[0].transitions[0].reset.offset[1] = -0.01;
  EXPECT_FALSE(limit_of(system, 60.0));
}

TEST(ShrinkingRounds, AreEightAtLeast) {
  EXPECT_FALSE(limit_of(swing(center, -5.0), 30.0));  // six
}

/// Without damping they do not shrink, and with little of it not to a half.
TEST(ShrinkingRounds, MustShrink) {
  for (const double damping : {0.0, -0.001, 0.01}) {
    HybridSystem system = swing(center, -50.0);
    for (std::size_t i : {0U, 1U}) system.modes[i].flow.matrix(1, 1) = -damping;
    EXPECT_FALSE(limit_of(system, 100.0)) << damping;
  }
}

}  // namespace
}  // namespace gearlash::hybrid::shrinking_rounds_test
