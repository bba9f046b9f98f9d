// Current loops, two rates, limits of speed and feed-forward, as answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include "base/lists.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/analyse.hpp"
#include "general/assemble/time_scale.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "question/loop/energy/computed_rest.hpp"
#include "question/loop/linear_loop.hpp"

namespace gearlash::industrial_drive_test {
namespace {

constexpr double inertia = 3.0;  // both, at the load's shaft
constexpr double friction = 0.4;

Drive cascade_drive(const CascadeController& law = {
                        .position = 2.0, .speed = 8.0, .speed_integral = 6.0}) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 1.0, .friction = {.viscous = friction}};
  drive.gearbox.backlash = 0.01;
  drive.load.inertia = inertia - 1.0;
  drive.sensor.position = SensorPlace::motor;
  drive.controller.law = law;
  return drive;
}

CascadeController& law_of(Drive& drive) {
  return std::get<CascadeController>(drive.controller.law);
}

std::string faults_text(const Drive& drive) {
  std::string text;
  for (const Fault& fault : faults(drive)) text += to_string(fault) + "\n";
  return text;
}

/// L = (K + I/s)(position + s)/((s/ω + 1)(J s² + F s)).
TEST(OracleCurrentBandwidth, LagsInTheLoop) {
  Drive drive = cascade_drive();
  const CascadeController law = law_of(drive);
  for (const double bandwidth : {6.0, 40.0, 4000.0}) {
    drive.motor.kind = TorqueControl{.current_bandwidth = bandwidth};
    const auto loop = drive::loop_figures(reduce(drive));
    ASSERT_TRUE(loop && loop->crossover && loop->phase_margin) << bandwidth;
    const std::complex<double> s{0.0, 2.0 * std::numbers::pi * *loop->crossover};
    const auto open = (law.speed + law.speed_integral / s) * (law.position + s) /
                      ((s / bandwidth + 1.0) * (inertia * s * s + friction * s));
    EXPECT_NEAR(std::abs(open), 1.0, 1e-9) << bandwidth;
    EXPECT_NEAR(std::abs(std::arg(-open)), *loop->phase_margin, 1e-9) << bandwidth;
    EXPECT_TRUE(ceiling_of(drive).load) << bandwidth;
  }
}

/// By how much the loop with the gap closed grows over some hundred rounds, from tick to tick: the
/// largest of a hundred rounds, which are some swings, over that of a hundred before.
double growth_by_hand(const CascadeController& law, double period, int ticks) {
  const double decay = std::exp(-friction / inertia * period);
  const double reach = inertia / friction * (1.0 - decay);  // of a speed within a period
  double position = 1.0, speed = 0.0, last = 1.0, state = 0.0, asked = 0.0, before = 0.0,
         largest = 0.0;
  constexpr int rounds = 300;
  for (int round = 0; round < 2 * rounds; ++round) {
    if (round == rounds) before = largest;
    if (round % 100 == 0) largest = 0.0;
    for (int tick = 0; tick < ticks; ++tick) {
      if (tick == 0) asked = -law.position * position;
      const double error = asked - (position - last) / period;
      const double step = period * law.speed_integral * error;
      const double end = (law.speed * error + state + 0.5 * step) / friction;  // of the speed
      state += step;
      last = position;
      position += end * period + (speed - end) * reach;
      speed = end + (speed - end) * decay;
      largest = std::max({largest, std::abs(position), std::abs(speed)});
    }
    if (largest > 1e100) return std::numeric_limits<double>::infinity();
  }
  return std::log(largest / before);
}

TEST(OracleTwoRates, AreStableWhereARecursionDecays) {
  constexpr int drives = 100;
  int stable = 0;
  int unstable = 0;
  int proved = 0;
  for (int seed = 0; seed < drives; ++seed) {
    SeededDraws draws(static_cast<std::uint64_t>(seed));
    const double period = draws.log_uniform(0.005, 0.1);
    const auto ticks = static_cast<int>(draws.uniform(2.0, 12.0));
    CascadeController law{.speed = inertia / period * draws.log_uniform(0.05, 0.9)};
    law.speed_integral = law.speed / period * draws.log_uniform(0.003, 0.1);
    law.position = draws.log_uniform(0.3, 6.0) / (ticks * period);
    const double growth = growth_by_hand(law, period, ticks);
    if (std::abs(growth) < 0.01) continue;
    Drive drive = cascade_drive(law);
    drive.sampling = Sampling{.period = period, .position_period = ticks * period};
    const auto loop = drive::loop_figures(reduce(drive));
    ASSERT_TRUE(loop) << "seed " << seed;
    double fastest = -1e300;  // growth, 1/s
    for (const auto& value : drive::loop_eigenvalues(reduce(drive))) {
      fastest = std::max(fastest, value.real());
    }
    EXPECT_EQ(fastest < 0.0, growth < 0.0) << "seed " << seed << ", growth " << growth;
    EXPECT_TRUE(growth < 0.0 || !loop->is_stable) << "seed " << seed;
    proved += loop->is_stable ? 1 : 0;
    EXPECT_FALSE(loop->bandwidth || loop->phase_margin) << "seed " << seed;
    ++(growth < 0.0 ? stable : unstable);
  }
  EXPECT_GE(stable, 20);
  EXPECT_GE(unstable, 20);
  EXPECT_GE(proved, stable - 2);  // a loop that hardly decays may be left open
}

TEST(PropertyTwoRates, OfOnePeriodAreAnsweredAsOneRate) {
  Drive drive = cascade_drive();
  drive.sensor.encoder.counts_per_turn = 4000.0;
  drive.motor.friction.coulomb = 0.02;
  drive.sampling = Sampling{.period = 0.01, .delay = 0.005};
  const Wanted all{.ceiling = true, .loop = true};
  const Answer one = analyse(drive, all);
  drive.sampling->position_period = 0.01;
  const Answer same = analyse(drive, all);
  EXPECT_EQ(same.cycles.size(), one.cycles.size());
  EXPECT_EQ(same.verdict, one.verdict);
  EXPECT_EQ(same.ceiling->load, one.ceiling->load);
  EXPECT_EQ(same.loop->phase_margin, one.loop->phase_margin);
  ASSERT_EQ(same.search->starts.size(), one.search->starts.size());
  for (std::size_t i = 0; i < one.search->starts.size(); ++i) {
    EXPECT_EQ(same.search->starts[i].end, one.search->starts[i].end) << i;
  }
}

TEST(TwoRates, HaveNoCeilingAndSayWhy) {
  Drive drive = cascade_drive();
  drive.sampling = Sampling{.period = 0.01, .position_period = 0.03};
  const Ceiling ceiling = ceiling_of(drive);
  EXPECT_FALSE(ceiling.load);
  EXPECT_NE(ceiling.reason.find("position controller"), std::string::npos) << ceiling.reason;
}

TEST(TwoRates, RefuseWhatIsNoMultiple) {
  Drive drive = cascade_drive();
  drive.sampling = Sampling{.period = 1e-3, .position_period = 2.5e-3};
  EXPECT_EQ(faults_text(drive),
            "sampling.position_period = 0.0025 s: must be sampling.period, 0.001 s, times a whole "
            "number from 1 to 1000, such as 0.003 s\n");
  for (const double ticks : {1.0, 3.0, 1000.0}) {
    drive.sampling->position_period = ticks * 1e-3;
    EXPECT_EQ(faults_text(drive), "") << ticks;
  }
  for (const double ticks : {0.4, 1001.0}) {
    drive.sampling->position_period = ticks * 1e-3;
    EXPECT_NE(faults_text(drive), "") << ticks;
  }
  drive.sampling->position_period = 2e-3;
  drive.controller.law = PID{.proportional = 1.0};
  EXPECT_NE(faults_text(drive).find("must be left out: of the controllers a cascade alone"),
            std::string::npos)
      << faults_text(drive);
}

/// It bounds what stays off the limit, and no more.
TEST(PropertySpeedLimit, LeavesLoopAndCeilingAsTheyAre) {
  Drive drive = cascade_drive();
  const Ceiling without = ceiling_of(drive);
  const auto loop_without = drive::loop_figures(reduce(drive));
  law_of(drive).speed_limit = 0.5;
  const Ceiling with = ceiling_of(drive);
  EXPECT_EQ(with.load, without.load);
  EXPECT_FALSE(without.is_below_limit);
  EXPECT_TRUE(with.is_below_limit);
  EXPECT_FALSE(with.safe_starts);
  const auto loop_with = drive::loop_figures(reduce(drive));
  ASSERT_TRUE(loop_with && loop_without);
  EXPECT_EQ(loop_with->phase_margin, loop_without->phase_margin);
  EXPECT_EQ(loop_with->bandwidth, loop_without->bandwidth);
}

/// A torque limit that holds the arm far below its reference, where the integral winds up: by the
/// linearised weight m g l (cos φ − sin φ (θ − r)) = limit.
TEST(OracleSpeedLimit, RestsWhereTheTorqueLimitDoes) {
  constexpr double limit = 2.0;
  constexpr double weight = 4.0;
  constexpr double angle = -0.3;
  Drive drive = cascade_drive();
  drive.load.gravity = weight;
  drive.load.gravity_angle = angle;
  drive.motor.limit = limit;
  const double place = (weight * std::cos(angle) - limit) / (weight * std::sin(angle));
  for (const double speed : {0.0, 0.05}) {
    if (speed > 0.0) law_of(drive).speed_limit = speed;  // at an error of 0.025 rad
    const auto pieces = computed_rest(reduce(drive));
    const auto holds = [&](const RestPiece& piece) {
      return piece.kind == RestKind::torque_limit && piece.side > 0.0 &&
             std::abs(piece.load.low - place) < 1e-9 && std::abs(piece.load.high - place) < 1e-9;
    };
    EXPECT_TRUE(any_of(pieces, holds)) << speed;
  }
}

TEST(SpeedLimit, RefusesWhatElseChangesTheError) {
  Drive drive = cascade_drive();
  law_of(drive).speed_limit = 1.0;
  drive.controller.dead_band.width = 0.01;
  EXPECT_EQ(
      faults_text(drive),
      "controller.speed_limit = 1 rad/s: must be left out, or controller.dead_band be 0: both "
      "change the error; motor.torque_limit bounds a motion too\n");
}

TEST(Feedforward, IsNotedWhereTheReferenceStands) {
  const auto is_noted = [](const Drive& drive) {
    return any_of(analyse(drive).notes, [](const Note& note) {
      return note.code == "feedforward" &&
             note.text.find("changes nothing here") != std::string::npos;
    });
  };
  Drive drive = cascade_drive();
  EXPECT_FALSE(is_noted(drive));
  law_of(drive).speed_feedforward = 1.0;
  EXPECT_TRUE(is_noted(drive));
  drive.reference = RampSignal{.rate = 0.1};
  EXPECT_FALSE(is_noted(drive));
  law_of(drive).position = 0.0;
  EXPECT_NE(faults_text(drive).find("speed_feedforward = 1: must be 0 beside"), std::string::npos);
}

}  // namespace
}  // namespace gearlash::industrial_drive_test
