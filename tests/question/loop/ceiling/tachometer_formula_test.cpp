// The gap's speed behind a sampled tachometer beside its formula, summed up in floating point by
// the shafts' own equations.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "base/drive_count.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/drive.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"

namespace gearlash::tachometer_formula_test {
namespace {

/// P control of one shaft's position and D of one shaft's speed, read each `period` and put out
/// `delay` later: τ = −P (z + α u) − D (ż + β u̇). Rigid faces, |u| ≤ b/2. z = θ_L + κ u.
struct Loop {
  double motor_inertia, load_inertia, motor_friction, load_friction;
  double proportional, derivative, period, delay, backlash, restitution;
  bool position_on_load, speed_on_load;

  double inertia() const { return motor_inertia + load_inertia; }
  double friction() const { return motor_friction + load_friction; }
  double share() const { return motor_inertia / inertia(); }
  double of_gap_speed() const { return friction() * share() - motor_friction; }  // c
  double alpha() const { return (position_on_load ? 0.0 : 1.0) - share(); }
  double beta() const { return (speed_on_load ? 0.0 : 1.0) - share(); }
};

Loop random_loop(SeededDraws& draws) {
  Loop loop{.motor_inertia = draws.log_uniform(0.1, 2.0),
            .load_inertia = draws.log_uniform(0.1, 2.0),
            .motor_friction = draws.log_uniform(0.01, 0.5),
            .load_friction = draws.log_uniform(0.01, 0.5),
            .proportional = draws.log_uniform(0.05, 1.0),
            .derivative = draws.log_uniform(0.05, 1.0),
            .period = draws.log_uniform(0.03, 2.0),
            .delay = 0.0,
            .backlash = draws.log_uniform(0.01, 0.3),
            .restitution = draws.one_of({0.0, 0.0, 0.3, 0.7}),
            .position_on_load = draws.happens(0.5),
            .speed_on_load = draws.happens(0.3)};
  if (draws.happens(0.5)) loop.delay = draws.uniform(0.05, 0.95) * loop.period;
  return loop;
}

Drive drive_of(const Loop& loop) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = loop.motor_inertia,
                 .friction = {.viscous = loop.motor_friction}};
  drive.load = {.inertia = loop.load_inertia, .friction = {.viscous = loop.load_friction}};
  drive.gearbox = {.ratio = 1.0, .backlash = loop.backlash};
  drive.contact = RigidContact{loop.restitution};
  drive.sensor = {.position = loop.position_on_load ? SensorPlace::load : SensorPlace::motor,
                  .speed = loop.speed_on_load ? ShaftName::load : ShaftName::motor};
  drive.controller.law = PID{.terms = PIDTerms::PD,
                             .proportional = loop.proportional,
                             .derivative = loop.derivative,
                             .derivative_of_speed = true};
  drive.sampling =
      Sampling{.period = loop.period, .delay = loop.delay, .speed_by_differences = false};
  return drive;
}

/// z, s = ż − (c/J) u, and the torques put out and waiting.
using State = Eigen::Vector4d;

/// The largest |θ_L − …| and |a|, of ü = a + g u̇, that |u| ≤ 1 at all times and |u̇| ≤ 1 at the
/// ticks can cause.
struct Norms {
  double load_of_gap = 0.0, load_of_speed = 0.0, pull_of_gap = 0.0, pull_of_speed = 0.0;
};

class Summed {
 public:
  explicit Summed(const Loop& loop) : loop_(loop) {
    const double first = loop.delay > 0.0 ? loop.delay : loop.period;
    add_steps(first);
    if (loop.delay > 0.0) add_steps(loop.period - loop.delay);
  }

  Norms norms() const {
    std::vector<Norms> sums(2 * steps_.size());  // by phases, before and after each step
    // The gap's reading at a tick, and its speed's.
    const double at_gap = -loop_.proportional * loop_.alpha() -
                          loop_.derivative * loop_.of_gap_speed() / loop_.inertia();
    follow(State(0.0, 0.0, 0.0, 0.0), at_gap, 0, sums, &Norms::load_of_gap, &Norms::pull_of_gap);
    follow(State(0.0, 0.0, 0.0, 0.0), -loop_.derivative * loop_.beta(), 0, sums,
           &Norms::load_of_speed, &Norms::pull_of_speed);
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      follow(steps_[i].pushed, 0.0, i + 1, sums, &Norms::load_of_gap, &Norms::pull_of_gap);
    }
    Norms largest;
    for (const Norms& one : sums) {
      for (const auto member : {&Norms::load_of_gap, &Norms::load_of_speed, &Norms::pull_of_gap,
                                &Norms::pull_of_speed}) {
        largest.*member = std::max(largest.*member, one.*member);
      }
    }
    largest.load_of_gap += loop_.share();
    largest.pull_of_gap += std::abs(per_speed() * loop_.of_gap_speed() / loop_.inertia());
    return largest;
  }

  /// ü = τ/J_M + per_speed() ż + g u̇
  double per_speed() const {
    return loop_.load_friction / loop_.load_inertia - loop_.motor_friction / loop_.motor_inertia;
  }

 private:
  struct Step {
    Eigen::Matrix2d flow;    ///< of z and s
    Eigen::Vector2d torque;  ///< of a constant one
    State pushed;            ///< by a gap of 1 during the step
    bool begins_hold = false;
  };

  void add_steps(double time) {
    constexpr int count = 24;
    const double length = time / count;
    // x′ = A x + B τ + b u by its series.
    const double f = loop_.friction() / loop_.inertia();
    const double c = loop_.of_gap_speed() / loop_.inertia();
    const Eigen::Matrix2d a{{0.0, 1.0}, {0.0, -f}};
    const Eigen::Vector2d of_torque(0.0, 1.0 / loop_.inertia());
    const Eigen::Vector2d of_gap(c, -f * c);
    Eigen::Matrix2d flow = Eigen::Matrix2d::Identity();
    Eigen::Matrix2d integral = Eigen::Matrix2d::Identity() * length;
    Eigen::Matrix2d power = Eigen::Matrix2d::Identity();
    for (int k = 1; k <= 30; ++k) {
      power = power * a * (length / k);
      flow += power;
      integral += power * (length / (k + 1));
    }
    const Eigen::Vector2d pushed = integral * of_gap;
    for (int i = 0; i < count; ++i) {
      steps_.push_back({flow, integral * of_torque, {pushed[0], pushed[1], 0.0, 0.0}, i == 0});
    }
  }

  double pull(const State& state) const {
    return state[2] / loop_.motor_inertia + per_speed() * state[1];
  }

  void follow(State state, double read, std::size_t first, std::vector<Norms>& sums,
              double Norms::*load, double Norms::*of_pull) const {
    constexpr int most_ticks = 20'000;
    const auto sum = [&](std::size_t phase) {
      sums[phase].*load += std::abs(state[0]);
      sums[phase].*of_pull += std::abs(pull(state));
    };
    double largest = 0.0;
    for (int tick = 0; tick < most_ticks; ++tick) {
      const double asked = tick == 0 ? (first == 0 ? read : 0.0)
                                     : -loop_.proportional * state[0] - loop_.derivative * state[1];
      state[3] = asked;
      double size = 0.0;
      std::size_t holds = 0;
      for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (steps_[i].begins_hold && ++holds == (loop_.delay > 0.0 ? 2U : 1U)) state[2] = state[3];
        if (tick == 0 && i < first) {
          if (i + 1 == first) sum(2 * i + 1);
          continue;
        }
        sum(2 * i);
        const Eigen::Vector2d next = steps_[i].flow * state.head<2>() + steps_[i].torque * state[2];
        state.head<2>() = next;
        sum(2 * i + 1);
        size = std::max(size, state.cwiseAbs().maxCoeff());
      }
      largest = std::max(largest, size);
      if (size <= 1e-12 * largest) return;
    }
  }

  const Loop& loop_;
  std::vector<Step> steps_;
};

/// The smaller of both bounds of the theorem; infinite if there is none.
double gap_speed(const Loop& loop, const Norms& norms) {
  const double slope = -loop.motor_friction * (1.0 - loop.share()) / loop.motor_inertia -
                       loop.load_friction * loop.share() / loop.load_inertia;
  const double pull = 0.5 * loop.backlash * norms.pull_of_gap;
  const double lost = 1.0 - loop.restitution * loop.restitution;
  const double push = loop.backlash * norms.pull_of_speed;
  const double by_distance =
      (push + std::sqrt(push * push + 2.0 * loop.backlash * lost * pull)) / lost;
  const double braking = -slope - norms.pull_of_speed;
  return braking > 0.0 ? std::min(by_distance, pull / braking) : by_distance;
}

/// What is proved is no less than the formula, and little more.
TEST(OracleCeiling, OfASampledTachometerIsItsFormula) {
  SeededDraws draws(20261128);
  std::vector<double> excesses;
  const int count = test::drive_count(40);
  for (int i = 0; i < count; ++i) {
    const Loop loop = random_loop(draws);
    const Ceiling ceiling = ceiling_of(reduce(drive_of(loop)));
    if (!ceiling.load) continue;
    SCOPED_TRACE("drive " + std::to_string(i));
    const Norms norms = Summed(loop).norms();
    const double speed = gap_speed(loop, norms);
    ASSERT_EQ(ceiling.terms.size(), 2U);
    constexpr double rounding = 1e-9;
    EXPECT_GE(ceiling.terms[0].load, 0.5 * loop.backlash * norms.load_of_gap * (1.0 - rounding));
    EXPECT_GE(ceiling.terms[1].size, speed * (1.0 - rounding));
    EXPECT_GE(
        *ceiling.load,
        (0.5 * loop.backlash * norms.load_of_gap + speed * norms.load_of_speed) * (1.0 - rounding));
    excesses.push_back(ceiling.terms[1].size / speed - 1.0);
  }
  std::sort(excesses.begin(), excesses.end());
  ASSERT_GT(excesses.size(), static_cast<std::size_t>(count / 2));
  const double median = excesses[excesses.size() / 2];
  std::printf(
      "%zu of %d drives have a ceiling, above the formula by %.2g at the median, %.2g most\n",
      excesses.size(), count, median, excesses.back());
  EXPECT_LT(median, 0.01);
  EXPECT_LT(excesses.back(), 0.1);
}

}  // namespace
}  // namespace gearlash::tachometer_formula_test
