// How far beyond 0 a guard may pass unseen: never farther than its touch says, against Taylor steps
// in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/references.hpp"
#include "base/traced_draws.hpp"
#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid::grazing_band_test {
namespace {

using WideState = std::vector<Wide>;

/// x′ = A x + b watched by c·x + d.
struct Watched {
  AffineFlow flow;
  AffineForm guard;
  Vector start;

  HybridSystem system() const {
    const auto size = flow.offset.size();
    HybridSystem result{
        .state_names = std::vector<std::string>(static_cast<std::size_t>(size)),
        .modes = {{.name = "moves", .flow = flow},
                  {.name = "over", .flow = {Matrix::Zero(size, size), Vector::Zero(size)}}}};
    result.modes[0].transitions = {{.name = "passes", .guard = guard, .target = 1}};
    return result;
  }

  /// A x, and + b.
  WideState slope_at(const WideState& x, bool with_offset) const {
    WideState slope(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (with_offset) slope[i] = flow.offset[row];
      for (std::size_t j = 0; j < x.size(); ++j) {
        slope[i] += flow.matrix(row, static_cast<Eigen::Index>(j)) * x[j];
      }
    }
    return slope;
  }

  /// Steps so short that thirty terms leave less than rounding does.
  WideState at(Wide time) const {
    WideState x(start.begin(), start.end());
    constexpr int steps = 200;
    for (int step = 0; step < steps; ++step) {
      WideState term = x;
      for (int k = 1; k <= 30; ++k) {
        term = slope_at(term, k == 1);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += term[i] *= time / steps / k;
      }
    }
    return x;
  }

  /// c·x, without d, with its first two derivatives.
  std::array<Wide, 3> guarded(Wide time) const {
    WideState x = at(time);
    std::array<Wide, 3> derivatives{};
    for (std::size_t order = 0; order < 3; ++order) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        derivatives[order] += guard.normal[static_cast<Eigen::Index>(i)] * x[i];
      }
      x = slope_at(x, order == 0);
    }
    return derivatives;
  }
};

struct Lowest {
  double time;
  Wide value;   ///< of c·x
  double size;  ///< Σ|c_i| max|x_i| up to there
};

/// The first local minimum of c·x, if all before it is higher.
std::optional<Lowest> first_minimum(const Watched& watched, double until) {
  HybridSystem unwatched = watched.system();
  unwatched.modes[0].transitions.clear();
  const Trajectory motion = simulate(unwatched, {0, watched.start}, {.until = until});
  constexpr int looks = 300;
  std::vector<double> values;
  Vector largest = Vector::Zero(watched.start.size());
  for (int k = 0; k <= looks; ++k) {
    const Vector x = motion.at(until * k / looks).numbers;
    largest = largest.cwiseMax(x.cwiseAbs());
    values.push_back(watched.guard.normal.dot(x));
    const std::size_t n = values.size();
    if (n < 3 || !(values[n - 2] < values[n - 1] && values[n - 2] < values[n - 3])) continue;
    if (*std::min_element(values.begin(), values.end()) < values[n - 2]) return std::nullopt;
    Wide time = until * (k - 1) / looks;
    for (int i = 0; i < 50; ++i) {
      const auto [value, slope, curvature] = watched.guarded(time);
      const Wide step = -slope / curvature;
      time += step;
      if (!(time > 0) || !(time < until)) return std::nullopt;
      if (std::abs(step) < 1e-14 * time) {
        return Lowest{static_cast<double>(time), value,
                      watched.guard.normal.cwiseAbs().dot(largest)};
      }
    }
    return std::nullopt;
  }
  return std::nullopt;
}

struct Tally {
  double drift =
      0.0;  ///< by which a step's rounding moves the guard at most: epsilons of its terms
  int judged = 0;
  int missed = 0;
  int invented = 0;
  double deepest_missed = 0.0;  ///< of the guard's terms
  double highest_invented = 0.0;
  double widest = 0.0;  ///< Touch::within
};

/// The guard passes 0 by some share of its terms, or stays short of it.
void judge(Watched watched, const Lowest& lowest, double share, Tally& tally) {
  const double aside = share * lowest.size;
  watched.guard.offset = static_cast<double>(-lowest.value - Wide(aside));
  const Wide least = lowest.value + Wide(watched.guard.offset);
  const double terms = lowest.size + std::abs(watched.guard.offset);
  const Trajectory motion =
      simulate(watched.system(), {0, watched.start}, {.until = 1.001 * lowest.time});
  const bool fired = !motion.events().empty();
  const double depth = static_cast<double>(std::abs(least)) / terms;
  ++tally.judged;
  for (const Touch& touch : motion.touches()) {
    tally.widest = std::max(tally.widest, touch.within / terms);
  }
  if (fired && least > 0) {
    ++tally.invented;
    tally.highest_invented = std::max(tally.highest_invented, depth);
  }
  if (fired || least >= 0) return;
  ++tally.missed;
  tally.deepest_missed = std::max(tally.deepest_missed, depth);
  if (depth <= tally.drift * epsilon * static_cast<double>(motion.steps())) return;
  ASSERT_FALSE(motion.touches().empty()) << "passed by " << depth << " of its terms, unreported";
  const Touch& touch = motion.touches()[0];
  EXPECT_LE(depth,
            touch.within / terms + tally.drift * epsilon * static_cast<double>(motion.steps()));
  const Wide there = watched.guarded(touch.time)[0] + Wide(watched.guard.offset);
  // Four times the uncertainty is called 0, beside what the polynomial there is itself off by.
  EXPECT_LE(std::abs(there), 5 * Wide(touch.within));
}

Watched random_system(SeededDraws& draws) {
  Watched watched;
  const Eigen::Index size = draws.happens(0.5) ? 2 : 3;
  watched.flow = {Matrix::Zero(size, size), Vector::Zero(size)};
  watched.guard.normal = Vector::Zero(size);
  watched.start = Vector::Zero(size);
  const double rate = draws.log_uniform(1e-2, 1e2);
  Vector units(size);
  for (Eigen::Index i = 0; i < size; ++i) units[i] = draws.log_uniform(1e-3, 1e3);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      watched.flow.matrix(i, j) = rate * draws.uniform(-1.0, 1.0) * units[i] / units[j];
    }
    watched.flow.matrix(i, i) -= 0.5 * rate;
    watched.flow.offset[i] = rate * draws.uniform(-1.0, 1.0) * units[i];
    watched.guard.normal[i] = draws.uniform(-1.0, 1.0) / units[i];
    watched.start[i] = draws.uniform(-1.0, 1.0) * units[i];
  }
  return watched;
}

TEST(OracleGrazing, NoPassageOfRandomSystemsIsDeeperThanItsTouchSays) {
  TracedDraws draws(1962);
  Tally tally{.drift = 16.0};
  for (int i = 0; i < 600 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Watched watched = random_system(draws);
    const double rate = watched.flow.matrix.cwiseAbs().diagonal().maxCoeff();
    const auto lowest = first_minimum(watched, 30.0 / rate);
    if (!lowest || !(lowest->size > 0.0)) continue;
    for (int k = 0; k < 20; ++k) judge(watched, *lowest, draws.either_sign(1e-18, 1e-10), tally);
  }
  EXPECT_GT(tally.judged, 3000);
  EXPECT_GT(tally.missed, tally.judged / 10);  // draws go as far as rounding
  // What hybrid_trajectory.hpp says was seen (1.6e-13 of 10⁵), and what its formula comes to.
  EXPECT_LE(tally.deepest_missed, 2e-13);
  EXPECT_LE(tally.highest_invented, 2e-13);
  EXPECT_LE(tally.widest, 2.4e-13);
}

/// cos t + 1 − δ, from an angle such that the lowest point is where a step ends, and before and
/// after.
TEST(EdgeGrazing, APassageOfTheUnitOscillatorIsReportedWhereverStepsEnd) {
  const double at_end = std::numbers::pi - 2.0;  // steps are 2 long
  for (const double angle : {0.0, 1.0, 2.0, at_end - 1e-9, at_end, at_end + 1e-9}) {
    SCOPED_TRACE(angle);
    Watched watched{.flow = {Matrix{{0.0, 1.0}, {-1.0, 0.0}}, Vector::Zero(2)},
                    .guard = {Vector{{1.0, 0.0}}, 1.0},
                    .start = Vector{{std::cos(angle), -std::sin(angle)}}};
    const Wide amplitude = std::hypot(Wide(watched.start[0]), Wide(watched.start[1]));
    Tally tally;
    for (double depth = 1e-16; depth < 1e-12; depth *= 1.3) {
      const double time = std::numbers::pi - angle;
      judge(watched, {time, -amplitude, 1.0}, -depth, tally);
      judge(watched, {time, -amplitude, 1.0}, depth, tally);
    }
    EXPECT_GT(tally.judged, 60);
    EXPECT_LE(tally.deepest_missed, 0.8e-13);  // of 2
  }
}

TEST(EdgeGrazing, APassageDeeperThanTheBandFires) {
  const Watched watched{.flow = {Matrix{{0.0, 1.0}, {-1.0, 0.0}}, Vector::Zero(2)},
                        .guard = {Vector{{1.0, 0.0}}, 1.0 - 5e-13},
                        .start = Vector{{1.0, 0.0}}};
  const Trajectory motion = simulate(watched.system(), {0, watched.start}, {.until = 6.0});
  ASSERT_EQ(motion.events().size(), 1U);
  EXPECT_TRUE(motion.touches().empty());
}

/// A throw of ½ at a height of which a double has digits to 2⁻²² only.
TEST(EdgeGrazing, WhatIsUnknownOfTheStartMayHideAPassage) {
  constexpr double height = 0x1p30;
  constexpr double digit = 0x1p-22;
  HybridSystem system{
      .state_names = {"position", "speed"},
      .modes = {{.name = "flies", .flow = {Matrix{{0.0, 1.0}, {0.0, 0.0}}, Vector{{0.0, -1.0}}}}}};
  for (int digits = -4; digits <= 4; ++digits) {
    system.modes[0].transitions = {{.name = "passes",
                                    .guard = {Vector::Unit(2, 0), -(height + 0.5 + digits * digit)},
                                    .direction = Direction::rising}};
    const Trajectory motion = simulate(system, {0, Vector{{height, 1.0}}}, {.until = 2.0});
    EXPECT_TRUE(motion.events().empty()) << digits;
    ASSERT_EQ(motion.touches().size(), 1U) << digits;
    EXPECT_GE(motion.touches()[0].within, 4.0 * digit) << digits;
  }
}

}  // namespace
}  // namespace gearlash::hybrid::grazing_band_test
