// Modes made when a motion first enters them are those of a list.
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "hybrid/periodic_orbit.hpp"
#include "servo_system.hpp"

namespace gearlash::hybrid::mode_source_test {
namespace {

/// A ball that rests after `bounces` bounces, a mode for each of them.
constexpr std::size_t bounces = 1000;
constexpr double gravity = 9.80665;

AffineMode flight_after(std::size_t index) {
  const Matrix fall{{0.0, 1.0}, {0.0, 0.0}};
  const Matrix turned{{1.0, 0.0}, {0.0, -0.9}};
  return {.name = "after " + std::to_string(index) + " bounces",
          .flow = {fall, Vector{{0.0, -gravity}}},
          .transitions = {{.name = "bounce",
                           .guard = {Vector{{1.0, 0.0}}, 0.0},
                           .reset = {.matrix = turned},
                           .target = index + 1}}};
}

HybridSystem counted_bounces() {
  HybridSystem system{.state_names = {"height", "speed"}};
  system.source = ModeSource(bounces, flight_after);
  return system;
}

const State dropped{0, Vector{{1.0, 0.0}}};

TEST(ModeSource, MakesOnlyTheModesThatAreEntered) {
  const HybridSystem system = counted_bounces();
  EXPECT_EQ(system.mode_count(), bounces);
  EXPECT_TRUE(faults(system).empty());
  EXPECT_EQ(system.source.made(), 0U);
  const Trajectory motion = simulate(system, dropped, {.until = 100.0, .event_limit = 5});
  EXPECT_EQ(motion.end().mode, 5U);
  EXPECT_EQ(system.source.made(), 6U);
  const HybridSystem copy = system;
  EXPECT_EQ(copy.mode(3).name, "after 3 bounces");
  EXPECT_EQ(copy.source.made(), 6U);
}

TEST(ModeSource, GivesTheMotionOfAList) {
  const HybridSystem system = counted_bounces();
  HybridSystem listed{.state_names = system.state_names};
  for (std::size_t i = 0; i < bounces; ++i) listed.modes.push_back(flight_after(i));
  listed.modes.back().transitions[0].target = 0;
  const SimulationOptions options{.until = 100.0, .event_limit = 20};
  const Trajectory motion = simulate(system, dropped, options);
  const Trajectory expected = simulate(listed, dropped, options);
  ASSERT_EQ(motion.events().size(), expected.events().size());
  for (std::size_t i = 0; i < motion.events().size(); ++i) {
    EXPECT_EQ(motion.events()[i].time, expected.events()[i].time);
    EXPECT_EQ(motion.events()[i].after, expected.events()[i].after);
  }
  EXPECT_EQ(motion.end().numbers, expected.end().numbers);
}

TEST(ModeSource, MayBeUsedBySeveralThreads) {
  const PreparedSystem prepared(counted_bounces());
  std::vector<double> ends(8);
  std::vector<std::thread> threads;
  for (double& end : ends) {
    threads.emplace_back([&end, &prepared] {
      end = simulate(prepared, dropped, {.until = 100.0, .event_limit = 20}).end_time();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double end : ends) EXPECT_EQ(end, ends.front());
  EXPECT_EQ(prepared.system().source.made(), 21U);
}

TEST(ModeSource, ClosesTheOrbitsOfAList) {
  const HybridSystem listed = servo_system({.damping = 0.19,
                                            .inertia_ratio = 2.0,
                                            .friction_ratio = 0.1,
                                            .backlash = 0.3,
                                            .restitution = 0.0});
  HybridSystem made{.state_names = listed.state_names};
  made.source = ModeSource(listed.modes.size(), [&](std::size_t i) { return listed.modes[i]; });
  const State start{0, Vector{{0.0, 1.0, 0.0, 0.0}}};
  const Trajectory motion = simulate(listed, start, {.until = 200.0});
  const auto expected = closing_orbit(listed, motion);
  const auto orbit = closing_orbit(made, motion);
  ASSERT_TRUE(expected && orbit);
  EXPECT_EQ(orbit->period, expected->period);
  EXPECT_EQ(orbit->start.numbers, expected->start.numbers);
  EXPECT_EQ(orbit->multipliers, expected->multipliers);
}

TEST(EdgeModeSource, FaultsAreFoundWhereAModeIsEntered) {
  HybridSystem system{.state_names = {"height", "speed"}};
  system.source = ModeSource(2, flight_after);  // the second one leads beyond the last
  EXPECT_TRUE(faults(system).empty());
  EXPECT_TRUE(faults_of_mode(system, 0).empty());
  EXPECT_EQ(faults_of_mode(system, 1).size(), 1U);
  const PreparedSystem prepared(system);
  EXPECT_NO_THROW(simulate(prepared, dropped, {.until = 0.1}));
  for (int again = 0; again < 2; ++again) {
    EXPECT_THROW(simulate(prepared, dropped, {.until = 10.0}), InvalidInput);
  }
}

TEST(EdgeModeSource, AListBesideASourceIsAFault) {
  HybridSystem system = counted_bounces();
  system.modes.push_back(flight_after(0));
  system.exogenous = {true};
  EXPECT_EQ(faults(system).size(), 2U);
}

}  // namespace
}  // namespace gearlash::hybrid::mode_source_test
