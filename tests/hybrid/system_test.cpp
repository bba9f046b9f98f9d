// The public face of the engine (gearlash/hybrid.hpp).
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "gearlash/hybrid.hpp"

namespace gearlash::hybrid::system_test {
namespace {

using testing::HasSubstr;

/// A block on a belt, held by a spring: it slides about `dry`, and breaks away at 1.
struct Block {
  static constexpr double belt = 0.2;
  static constexpr double dry = 0.6;
  System system{{"position", "speed"}};
  Mode sliding = system.mode("sliding", {{0, 1}, {-1, 0}}, {0, dry});
  Mode sticking = system.mode("sticking", {{0, 1}, {0, 0}});

  Block() {
    system.on(sticking, "slip", {{-1, 0}, 1.0}, sliding)
        .on(sliding, "stick", {{0, -1}, belt}, sticking);
  }
};

TEST(HybridSystemOracle, StickSlipHasItsPeriodAndExtremesBetweenEvents) {
  const Block block;
  const auto orbit = find_orbit(block.system, block.sticking, {0, Block::belt}, 60.0);
  ASSERT_TRUE(orbit);
  // It sticks from 0.2 to 1, and slides on a circle about 0.6 from (0.4, 0.2) to (-0.4, 0.2).
  const double half_angle = std::atan2(Block::belt, 1.0 - Block::dry);
  const double period = 0.8 / Block::belt + std::numbers::pi + 2.0 * half_angle;
  EXPECT_NEAR(orbit->period, period, 1e-13 * period);
  EXPECT_TRUE(orbit->stable);
  const double radius = std::hypot(Block::belt, 1.0 - Block::dry);
  const Bounds position = extent(block.system, *orbit, {{1, 0}});
  EXPECT_NEAR(position.high, Block::dry + radius, 1e-14);
  EXPECT_NEAR(position.low, Block::dry - radius, 1e-14);
  const Bounds speed = extent(block.system, *orbit, {{0, 1}, 1.0});
  EXPECT_NEAR(speed.high, 1.0 + Block::belt, 1e-14);
  EXPECT_NEAR(speed.low, 1.0 - radius, 1e-14);
}

TEST(HybridSystem, EventsSayTheirNamesAndModes) {
  const Block block;
  const Motion motion = simulate(block.system, block.sticking, {0, Block::belt}, 12.0);
  ASSERT_EQ(motion.events().size(), 2U);
  const Motion::Event& slip = motion.events().front();
  EXPECT_EQ(slip.name, "slip");
  EXPECT_DOUBLE_EQ(slip.time, 5.0);
  EXPECT_EQ(slip.mode, block.sticking);
  EXPECT_EQ(slip.mode_after, block.sliding);
  EXPECT_EQ(motion.mode_at(6.0), block.sliding);
  EXPECT_DOUBLE_EQ(motion.at(2.5)[0], 0.5);
  EXPECT_EQ(motion.end(), End::time);
}

TEST(HybridSystemOracle, ABallThatBouncesToRestHasALimit) {
  System ball({"height", "speed"});
  const Mode falling = ball.mode("falling", {{0, 1}, {0, 0}}, {0, -1});
  const Mode lying = ball.mode("lying", {{0, 0}, {0, 0}});
  ball.on(falling, "bounce", {{1, 0}}, falling, Direction::falling, {{{1, 0}, {0, -0.5}}, {}})
      .settling(lying, {{{0, 0}, {0, 0}}, {}});
  const Motion motion = simulate(ball, falling, {0.5, 0}, 10.0);
  const Motion::Event& last = motion.events().back();
  EXPECT_TRUE(last.is_limit);
  EXPECT_EQ(last.mode_after, lying);
  // 1 + 2 (1/2 + 1/4 + …), summed up to where 1e-10 is left.
  EXPECT_NEAR(last.time, 3.0, 1e-10);
}

TEST(HybridSystem, TimersTick) {
  System system({"number"});
  const Mode only = system.mode("only", {{0}});
  const Timer timer = system.timer("clock", 0.25, 0.5);
  system.on_tick(only, "tick", timer, only, {{}, {1}});
  EXPECT_EQ(simulate(system, only, {0}, 1.0).at(1.0), Row{3});
}

TEST(HybridSystem, CopiesPartWhenOneIsChanged) {
  Block block;
  const System before = block.system;
  block.system.on(block.sticking, "early", {{-1, 0}, 0.5}, block.sliding);
  EXPECT_EQ(simulate(before, block.sticking, {0, 0.2}, 4.0).events().size(), 0U);
  EXPECT_GT(simulate(block.system, block.sticking, {0, 0.2}, 4.0).events().size(), 0U);
}

std::string faults_of(const System& system) {
  try {
    static_cast<void>(simulate(system, Mode{0}, {0, 0}, 1.0));
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(HybridSystem, EveryFaultIsReportedAtOnce) {
  System ragged({"position", "speed"});
  const Mode mode = ragged.mode("free", {{0, 1}, {-1}});
  ragged.on(Mode{7}, "lost", {{1, 0}}, mode).settling(mode);
  EXPECT_THAT(faults_of(ragged), HasSubstr("mode \"free\".flow.matrix"));
  EXPECT_THAT(faults_of(ragged), HasSubstr("event \"lost\".mode"));
  EXPECT_THAT(faults_of(ragged), HasSubstr("settling"));
  Block block;
  block.system.on(block.sliding, "nowhere", {{1}}, Mode{9});
  EXPECT_THAT(faults_of(block.system), HasSubstr("nowhere"));
  EXPECT_THAT(faults_of(block.system), HasSubstr("must be one of 2 modes"));
  EXPECT_THROW(static_cast<void>(simulate(Block().system, Mode{0}, {0}, 1.0)), InvalidInput);
}

}  // namespace
}  // namespace gearlash::hybrid::system_test
