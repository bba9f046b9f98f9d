// Integral action against stiction: what is published of it, and a single mass computed by hand.
//
// Armstrong-Hélouvry & Amin, PID control in the presence of static friction, Automatica 32 (1996)
// 679: with static friction above Coulomb friction a PID loop hunts. Ruderman, Stick-slip and
// convergence of feedback-controlled systems with Coulomb friction (arXiv 2006.08977): with static
// friction equal to it there is no cycle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>

#include "base/correct_digits.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"

namespace gearlash::published_friction_test {
namespace {

/// x″ = τ − friction, τ′ = −derivative x″ − proportional x′ − integral x, for a mass of 1.
struct Loop {
  double proportional;
  double integral;
  double derivative;
  double coulomb;
  double breakaway;
};

struct StickSlip {
  double amplitude;
  double period;
};

using State = std::array<double, 3>;  // x, x′, x″

State rate(const Loop& loop, const State& s) {
  return {s[1], s[2], -loop.derivative * s[2] - loop.proportional * s[1] - loop.integral * s[0]};
}

State moved(const State& s, const State& rate, double time) {
  return {s[0] + rate[0] * time, s[1] + rate[1] * time, s[2] + rate[2] * time};
}

State stepped(const Loop& loop, const State& s, double h) {
  const State a = rate(loop, s);
  const State b = rate(loop, moved(s, a, h / 2));
  const State c = rate(loop, moved(s, b, h / 2));
  const State d = rate(loop, moved(s, c, h));
  State sum;
  for (std::size_t i = 0; i < 3; ++i) sum[i] = s[i] + h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  return sum;
}

struct Slip {
  double end;
  double time;
  double torque;  ///< of the controller, as it ends
};

/// From rest at −start, as the torque exceeds the breakaway torque, until the mass stops, or only
/// creeps on.
Slip slip_from(const Loop& loop, double start) {
  const double step = 1e-3 / std::sqrt(loop.proportional);
  State state = {-start, 0.0, loop.breakaway - loop.coulomb};
  double time = 0.0;
  while (true) {
    const State next = stepped(loop, state, step);
    if (next[1] < 0.0) break;
    state = next;
    time += step;
    constexpr double creeping = 1e-12;
    if (std::abs(state[1]) + std::abs(state[2]) < creeping) {
      return {state[0], time, state[2] + loop.coulomb};
    }
  }
  // The last part of a step, by halving.
  double low = 0.0;
  double high = step;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (stepped(loop, state, middle)[1] > 0.0 ? low : high) = middle;
  }
  const State end = stepped(loop, state, low);
  return {end[0], time + low, end[2] + loop.coulomb};
}

/// The cycle that mirrors itself: a slip from −X to X, then a stop until the integral has turned
/// the torque to the other side. A short slip goes too far, a long one not far enough.
std::optional<StickSlip> stick_slip(const Loop& loop) {
  const double excess = loop.breakaway - loop.coulomb;
  if (!(excess > 0.0)) return std::nullopt;  // x″ = 0 as it would break away, and x′ stays 0
  double low = 1e-6 * excess / loop.proportional;
  double high = 1e3 * excess / loop.proportional;
  if (slip_from(loop, low).end < low || slip_from(loop, high).end > high) return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (slip_from(loop, middle).end > middle ? low : high) = middle;
  }
  const Slip slip = slip_from(loop, low);
  const double stop = (slip.torque + loop.breakaway) / (loop.integral * slip.end);
  return StickSlip{slip.end, 2.0 * (slip.time + stop)};
}

/// The loop as a drive: the motor has the mass and the sensor, a millionth of it is the load's.
Drive drive_of(const Loop& loop) {
  std::ostringstream toml;
  toml.precision(17);
  toml << "[motor]\nkind = \"torque-controlled\"\ninertia = \"0.999999 kg m2\"\nfriction = 0\n"
       << "coulomb = \"" << loop.coulomb << " N m\"\nbreakaway = \"" << loop.breakaway << " N m\"\n"
       << "[gearbox]\nratio = 1\nbacklash = \"1e-3 rad\"\n"
       << "[load]\ninertia = \"1e-6 kg m2\"\nfriction = 0\n"
       << "[sensor]\nposition = \"motor\"\n"
       << "[controller]\nkind = \"PID\"\n"
       << "proportional = \"" << loop.proportional << " N m/rad\"\n"
       << "integral = \"" << loop.integral << " N m/(rad s)\"\n"
       << "derivative = \"" << loop.derivative << " N m s/rad\"\n";
  return parse_drive(toml.str());
}

/// Gains with which the loop without friction is stable: integral < proportional · derivative.
Loop random_loop(SeededDraws& draws) {
  Loop loop{};
  loop.proportional = draws.log_uniform(5.0, 50.0);
  loop.derivative = std::sqrt(loop.proportional) * draws.uniform(0.7, 2.0);
  loop.integral = loop.proportional * loop.derivative * draws.uniform(0.05, 0.4);
  loop.coulomb = 1.0;
  loop.breakaway = draws.uniform(1.1, 1.8);
  return loop;
}

TEST(OraclePublishedFriction, StaticAboveCoulombFrictionHunts) {
  constexpr std::uint64_t seed = 1996;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    const Loop loop = random_loop(draws);
    const std::optional<StickSlip> known = stick_slip(loop);
    ASSERT_TRUE(known);
    const Answer answer = analyse(drive_of(loop));
    const Cycle* cycle = answer.largest_stable();
    ASSERT_NE(cycle, nullptr);
    // The load rides along: a millionth of the mass, and it leaves the motor's face in a slip.
    expect_digits("amplitude_" + std::to_string(i), cycle->motor_amplitude, known->amplitude, 4.0);
    expect_digits("period_" + std::to_string(i), cycle->period, known->period, 4.0);
  }
}

TEST(OraclePublishedFriction, StaticEqualToCoulombFrictionHasNoCycle) {
  SeededDraws draws(2020);
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    Loop loop = random_loop(draws);
    loop.breakaway = loop.coulomb;
    EXPECT_FALSE(stick_slip(loop));
    const Answer answer = analyse(drive_of(loop));
    EXPECT_TRUE(answer.cycles.empty());
    EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
  }
}

}  // namespace
}  // namespace gearlash::published_friction_test
