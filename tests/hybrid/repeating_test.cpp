// Rounds of ticks that repeat one affine map are passed over, and nothing is missed thereby.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid::repeating_test {
namespace {

/// Numbers: place, speed, force, filtered reading. A clock reads the place to whole steps and
/// filters it; another one, a little later, sets the force from that. Between two walls, at which
/// it turns back with a share of its speed, the mass moves against viscous friction.
struct Slide {
  double period = 1e-3;
  double delay = 2.5e-4;
  double step = 0.5;
  double gain = 1e-3;
  double filter = 0.02;
  double friction = 0.3;
  double wall = 1.7;
  double limit = 1.0;  ///< a force beyond it is cut to it, in a mode of its own
};

enum { place, speed, force, filtered };

AffineMode moving(const Slide& slide, std::size_t index, bool is_limited) {
  AffineMode mode{.name = is_limited ? "limited" : "free",
                  .flow = {Matrix::Zero(4, 4), Vector::Zero(4)}};
  mode.flow.matrix(place, speed) = 1.0;
  mode.flow.matrix(speed, speed) = -slide.friction;
  if (is_limited) {
    mode.flow.offset[speed] = slide.limit;
  } else {
    mode.flow.matrix(speed, force) = 1.0;
  }
  Matrix bounce = Matrix::Identity(4, 4);
  bounce(speed, speed) = -0.8;
  for (const double side : {1.0, -1.0}) {
    mode.transitions.push_back({.name = "wall",
                                .guard = {Vector(side * Vector::Unit(4, place)), -slide.wall},
                                .direction = Direction::rising,
                                .reset = {bounce, {}, {}},
                                .target = index});
  }
  AffineReset reads{Matrix::Identity(4, 4), {}, {}};
  reads.matrix(filtered, filtered) = 1.0 - slide.filter;
  reads.quantizers = {{{Vector::Unit(4, place), 0.0},
                       slide.step,
                       Vector(slide.filter * Vector::Unit(4, filtered))}};
  AffineReset sets{Matrix::Identity(4, 4), Vector(0.4 * Vector::Unit(4, force)), {}};
  sets.matrix.row(force) = (-slide.gain * Vector::Unit(4, filtered)).transpose();
  mode.timed = {{.name = "reads", .clock = 0, .reset = reads, .target = index},
                {.name = "sets",
                 .clock = 1,
                 .reset = sets,
                 .target = 0,
                 .alternatives = {{{{Vector::Unit(4, force), -slide.limit}}, 1}}}};
  return mode;
}

HybridSystem system_of(const Slide& slide) {
  return {.state_names = {"place", "speed", "force", "filtered"},
          .modes = {moving(slide, 0, false), moving(slide, 1, true)},
          .clocks = {{.name = "reads", .first = 0.0, .period = slide.period},
                     {.name = "sets", .first = slide.delay, .period = slide.period}}};
}

/// Pieces follow each other.
struct Counted : MotionObserver {
  double to = 0.0;
  void moved(double from, double until, const Vector&, const Vector&) override {
    EXPECT_EQ(from, to);
    to = until;
  }
};

/// The observer must see the speed change its sign.
struct Watching : Counted {
  std::vector<AffineForm> forms{{Vector::Unit(4, speed), 0.0}};
  const std::vector<AffineForm>& watched() const override { return forms; }
};

std::size_t transitions_of(const Trajectory& motion) {
  return static_cast<std::size_t>(
      std::count_if(motion.events().begin(), motion.events().end(),
                    [](const Event& event) { return event.kind == EventKind::transition; }));
}

TEST(Repeating, EndsWhereTheKeptMotionEnds) {
  constexpr unsigned seed = 20;
  SCOPED_TRACE(seed);
  std::mt19937_64 dice(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(dice);
  };
  std::size_t kept = 0;
  std::size_t observed = 0;
  std::size_t transitions = 0;
  for (int i = 0; i < 60; ++i) {
    const Slide slide{.delay = 1e-3 * between(0.1, 0.9),
                      .step = between(0.05, 2.0),
                      .gain = between(0.0, 2.0),
                      .filter = std::exp(between(std::log(2e-4), std::log(0.5))),
                      .friction = between(0.0, 2.0),
                      .wall = between(0.3, 2.0),
                      .limit = between(0.3, 2.0)};
    const PreparedSystem system(system_of(slide));
    Vector start = Vector::Zero(4);
    start[place] = between(-0.2, 0.2);
    start[speed] = between(-0.5, 0.5);
    const double until = 20.0003;
    const Trajectory motion = simulate(system, {0, start}, {.until = until});
    Watching observer;
    const Observed end = observe(system, {0, start}, {.until = until}, observer);
    ASSERT_EQ(end.stop_reason, motion.stop_reason()) << i;
    EXPECT_NEAR(end.time, motion.end_time(), 1e-9) << i;
    EXPECT_EQ(end.end.mode, motion.end().mode) << i;
    EXPECT_LT((end.end.numbers - motion.end().numbers).cwiseAbs().maxCoeff(), 1e-8) << i;
    kept += motion.events().size();
    observed += end.events;
    transitions += transitions_of(motion);
  }
  EXPECT_GT(transitions, 100U);
  EXPECT_LT(observed, kept / 3);
}

/// The wall is met at the instant at which it is met tick by tick: the mass is slow, and far.
TEST(Repeating, MeetsAGuardThatManyRoundsApproach) {
  Slide slide{.step = 10.0, .gain = 0.0, .friction = 0.0, .wall = 1.0, .limit = 10.0};
  HybridSystem system = system_of(slide);
  for (AffineMode& mode : system.modes) mode.timed[1].reset.offset.setZero();
  Vector start = Vector::Zero(4);
  start[speed] = 1e-3;
  Counted observer;
  const Observed end = observe(PreparedSystem(system), {0, start},
                               {.until = 1500.0, .event_limit = 100'000}, observer);
  EXPECT_EQ(end.stop_reason, StopReason::reached_end);
  EXPECT_LT(end.events, 10'000U);  // of 3,000,000 ticks
  // There and, with 0.8 of the speed, 500 s back.
  EXPECT_NEAR(end.end.numbers[place], 1.0 - 0.8e-3 * 500.0, 1e-9);
}

/// A turn of what is watched is at the end of a piece, or within a step of the series.
TEST(Repeating, SeesAWatchedFormChangeItsSign) {
  Slide slide{.step = 100.0, .gain = 0.0, .friction = 0.0, .wall = 40.0, .limit = 10.0};
  HybridSystem system = system_of(slide);
  for (AffineMode& mode : system.modes) mode.timed[1].reset.offset *= -1e-3;  // a force of −0.0004
  Vector start = Vector::Zero(4);
  start[speed] = 0.1;
  struct Turned : Watching {
    double longest = 0.0;
    void moved(double from, double until, const Vector& before, const Vector& after) override {
      if (before[speed] * after[speed] < 0.0) longest = std::max(longest, until - from);
    }
  } observer;
  const Observed end = observe(PreparedSystem(system), {0, start}, {.until = 400.0}, observer);
  EXPECT_LT(end.end.numbers[speed], 0.0);
  EXPECT_GT(observer.longest, 0.0);
  EXPECT_LE(observer.longest, slide.period);
}

}  // namespace
}  // namespace gearlash::hybrid::repeating_test
