// A motion that is observed is the motion that is kept, without the ticks of a standstill.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid::observe_test {
namespace {

/// Keeps what it receives.
struct Kept : MotionObserver {
  struct Piece {
    double from;
    double to;
    Vector before;
    Vector after;
  };
  std::vector<Piece> pieces;
  void moved(double from, double to, const Vector& before, const Vector& after) override {
    pieces.push_back({from, to, before, after});
  }
};

/// A mass (place, speed) under a held force, which a clock sets to −(1.2 place + 0.3 speed), and an
/// integral. It sticks while the force is within ±stiction, and then its friction is 0.5.
HybridSystem stuck_mass(double period, double gain, double stiction) {
  enum { place, speed, force, integral };
  Matrix tick = Matrix::Identity(4, 4);
  tick.row(integral) << gain, 0.0, 0.0, 1.0;
  tick.row(force) << -1.2, -0.3, 0.0, -1.0;
  const auto clocked = [&](std::size_t mode) {
    return std::vector<TimedTransition>{
        {.name = "tick", .clock = 0, .reset = {tick, {}, {}}, .target = mode}};
  };
  const auto moving = [&](const char* name, double way, std::size_t index) {
    AffineMode mode{.name = name,
                    .flow = {Matrix::Zero(4, 4), Vector{{0.0, -0.5 * way, 0.0, 0.0}}}};
    mode.flow.matrix(place, speed) = 1.0;
    mode.flow.matrix(speed, force) = 1.0;
    Matrix stop = Matrix::Identity(4, 4);
    stop(speed, speed) = 0.0;
    mode.transitions.push_back({.name = "stops",
                                .guard = {Vector{{0.0, 1.0, 0.0, 0.0}}, 0.0},
                                .direction = way > 0.0 ? Direction::falling : Direction::rising,
                                .reset = {stop, {}, {}},
                                .target = 0});
    mode.timed = clocked(index);
    return mode;
  };
  AffineMode sticks{.name = "sticks", .flow = {Matrix::Zero(4, 4), Vector::Zero(4)}};
  sticks.flow.matrix(place, speed) = 1.0;
  sticks.transitions = {{.name = "forward",
                         .guard = {Vector{{0.0, 0.0, 1.0, 0.0}}, -stiction},
                         .direction = Direction::rising,
                         .target = 1},
                        {.name = "backward",
                         .guard = {Vector{{0.0, 0.0, 1.0, 0.0}}, stiction},
                         .direction = Direction::falling,
                         .target = 2}};
  sticks.timed = clocked(0);
  return {.state_names = {"place", "speed", "force", "integral"},
          .modes = {sticks, moving("forward", 1.0, 1), moving("backward", -1.0, 2)},
          .clocks = {{.name = "clock", .first = 0.0, .period = period}}};
}

TEST(Observe, EndsWhereTheKeptMotionEnds) {
  for (const double gain : {2e-4, 2.5e-4, 3e-4}) {
    const PreparedSystem system(stuck_mass(1e-3, gain, 0.8));
    const State start{0, Vector{{0.31, 0.0, 0.0, 0.0}}};
    const Trajectory motion = simulate(system, start, {.until = 90.00005});
    Kept kept;
    const Observed observed = observe(system, start, {.until = 90.00005}, kept);
    std::size_t moves = 0;
    for (const Event& event : motion.events()) moves += event.kind == EventKind::transition ? 1 : 0;
    ASSERT_GT(moves, 3U);
    EXPECT_EQ(observed.end.mode, motion.end().mode);
    EXPECT_EQ(observed.time, motion.end_time());
    EXPECT_LT((observed.end.numbers - motion.end().numbers).cwiseAbs().maxCoeff(), 1e-9);
    // Most ticks are those of standstills, which are not counted.
    EXPECT_LT(observed.events, motion.events().size() / 3);
    EXPECT_LT(kept.pieces.size(), motion.events().size() / 2);
    for (std::size_t i = 0; i + 1 < kept.pieces.size(); ++i) {
      ASSERT_EQ(kept.pieces[i].to, kept.pieces[i + 1].from);
    }
  }
}

/// The force grows by the same amount a tick: the mass breaks away at the tick at which it first
/// exceeds the stiction, 0.8 = 0.3·1.2 + n·0.3·gain.
TEST(Observe, StopsStandingAtTheTickThatBreaksAway) {
  const double gain = 1.1e-6;
  const PreparedSystem system(stuck_mass(1e-3, gain, 0.8));
  Kept kept;
  // The first tick is at 0. Each sets the integral, then the force from the integral before.
  const double ticks = std::floor((0.8 - 0.36) / (0.3 * gain)) + 1.0;
  const Observed before =
      observe(system, {0, Vector{{-0.3, 0.0, 0.0, 0.0}}}, {.until = (ticks - 0.5) * 1e-3}, kept);
  EXPECT_EQ(before.end.mode, 0U);
  EXPECT_EQ(before.end.numbers[1], 0.0);
  EXPECT_LT(kept.pieces.size(), 200U);
  const Observed after =
      observe(system, {0, Vector{{-0.3, 0.0, 0.0, 0.0}}}, {.until = (ticks + 0.5) * 1e-3}, kept);
  EXPECT_EQ(after.end.mode, 1U);
  EXPECT_GT(after.end.numbers[1], 0.0);
}

/// Its integral decays by 1e-4 of itself at each tick, so that no two changes are alike. Ten such
/// ticks count as an event.
TEST(Observe, AnEndlessStandstillOfTicksThatDifferEndsByItsEvents) {
  HybridSystem system = stuck_mass(1e-3, 0.0, 10.0);
  Matrix& tick = system.modes[0].timed[0].reset.matrix;
  tick(3, 3) = 1.0 - 1e-4;
  Kept kept;
  const Observed observed = observe(PreparedSystem(system), {0, Vector{{0.0, 0.0, 0.0, 1.0}}},
                                    {.until = 1e9, .event_limit = 2000}, kept);
  EXPECT_EQ(observed.stop_reason, StopReason::event_limit);
  EXPECT_GE(observed.events, 2000U);
  EXPECT_LT(observed.time, 50.0);
}

/// Ticks that change nothing are passed over, however many they are.
TEST(Observe, PassesOverTicksThatChangeNothing) {
  const PreparedSystem system(stuck_mass(1e-6, 0.0, 0.8));
  Kept kept;
  const Observed observed =
      observe(system, {0, Vector{{0.1, 0.0, 0.0, 0.0}}}, {.until = 1e6}, kept);
  EXPECT_EQ(observed.stop_reason, StopReason::reached_end);
  EXPECT_EQ(observed.time, 1e6);
  EXPECT_EQ(observed.end.numbers[0], 0.1);
  EXPECT_LT(kept.pieces.size(), 100U);
}

}  // namespace
}  // namespace gearlash::hybrid::observe_test
