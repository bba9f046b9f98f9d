// The verdict is what a long simulation does, and every cycle reported is one.
#include "closed_form/limit_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/described.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/extremes.hpp"

namespace gearlash::limit_cycle_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Half peak-to-peak of the load from `from` on, sampled every 200th of a radian and at the events.
/// The load's position has kinks at impacts only; between them a turning point is at most half a
/// step from a sample, which misses ½ a (step/2)², 3e-6 of an amplitude.
double sampled_amplitude(const Trajectory& motion, double from) {
  double low = infinity;
  double high = -infinity;
  const auto include = [&](double position) {
    low = std::min(low, position);
    high = std::max(high, position);
  };
  for (double time = from; time < motion.end_time(); time += 0.005) {
    include(motion.at(time).load_position);
  }
  for (const Event& event : motion.events()) {
    if (event.time >= from) include(event.before.load_position);
  }
  return 0.5 * (high - low);
}

/// Engaged, displaced by `amplitude` from the reference, at rest.
Trajectory long_run(const NormalizedServo& servo, double amplitude, double until) {
  return simulate(servo, engaged_start(servo, -amplitude, 0.0, 0.0),
                  {.until = until, .reference = 0.0});
}

NormalizedServo random_servo(SeededDraws& draws) {
  return {.damping = draws.uniform(0.02, 0.9),
          .inertia_ratio = draws.log_uniform(0.03, 30.0),
          .friction_ratio = draws.uniform(0.02, 0.98),
          .backlash = 0.3};
}

TEST(PropertyVerdict, PlasticServosDoWhatItSays) {
  TracedDraws draws(701);
  int hunting = 0;
  int resting = 0;
  for (int i = 0; i < 250 && !testing::Test::HasFailure(); ++i) {
    const NormalizedServo servo = random_servo(draws);
    SCOPED_TRACE(described(servo));
    const LimitCycleAnalysis analysis = enclose_limit_cycles(servo, Reading::exact);
    EXPECT_TRUE(analysis.is_proved());
    ASSERT_EQ(analysis.verdict,
              analysis.growth_at_rest > 1.0 ? Verdict::hunts : Verdict::cannot_hunt);
    ASSERT_EQ(analysis.cycles.size(), analysis.growth_at_rest > 1.0 ? 1U : 0U);
    if (std::abs(analysis.growth_at_rest - 1.0) < 0.01) continue;
    // A hundredth of growth a half cycle, of which each takes up to b F_M/|y| of creeping.
    constexpr double until = 3e4;
    for (const double factor : {0.1, 1.0, 30.0}) {
      if (analysis.verdict == Verdict::hunts) {
        const LimitCycle& cycle = analysis.cycles.front();
        if (cycle.multiplier > 0.995) continue;
        ++hunting;
        const Trajectory motion = long_run(servo, factor * cycle.amplitude, until);
        ASSERT_NEAR(sampled_amplitude(motion, until - 1.5 * cycle.period), cycle.amplitude,
                    1e-5 * cycle.amplitude)
            << "from " << factor << " times its amplitude";
      } else {
        ++resting;
        const Trajectory motion = long_run(servo, factor * servo.backlash, until);
        const ServoState end = motion.at(until);
        ASSERT_LT(std::abs(end.load_position), 0.05 * servo.backlash);
        ASSERT_LT(std::abs(end.load_speed), 0.01 * servo.backlash);
      }
    }
  }
  EXPECT_GT(hunting, 100);
  EXPECT_GT(resting, 100);
}

TEST(PropertyVerdict, FrictionOnOneSideOnlyAlwaysHunts) {
  TracedDraws draws(702);
  for (int i = 0; i < 300; ++i) {
    NormalizedServo servo = random_servo(draws);
    servo.damping = draws.uniform(0.001, 3.0);
    servo.friction_ratio = draws.one_of({0.0, 1.0});
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    ASSERT_EQ(analysis.verdict, Verdict::hunts) << described(servo);
    ASSERT_EQ(analysis.growth_at_rest, infinity) << described(servo);
    ASSERT_EQ(analysis.cycles.size(), 1U) << described(servo);
    ASSERT_GT(analysis.cycles.front().amplitude, 0.0) << described(servo);
  }
}

TEST(EdgeVerdict, NoDampingGrowsWithoutBound) {
  const LimitCycleAnalysis analysis =
      analyse_limit_cycles({.damping = 0.0, .inertia_ratio = 2.0, .backlash = 0.3});
  EXPECT_EQ(analysis.verdict, Verdict::grows_without_bound);
  EXPECT_TRUE(analysis.cycles.empty());
  const NormalizedServo servo{.damping = 0.0, .inertia_ratio = 2.0, .backlash = 0.3};
  double before = 0.0;
  const Trajectory motion = long_run(servo, 0.3, 2000.0);
  for (const double from : {90.0, 490.0, 1990.0}) {
    const Trajectory part = long_run(servo, 0.3, from + 10.0);
    const double found = sampled_amplitude(part, from);
    EXPECT_GT(found, 1.2 * before);
    before = found;
  }
}

TEST(EdgeVerdict, NoBacklashCannotHunt) {
  const LimitCycleAnalysis damped =
      analyse_limit_cycles({.damping = 0.1, .inertia_ratio = 2.0, .friction_ratio = 0.1});
  EXPECT_EQ(damped.verdict, Verdict::cannot_hunt);
  EXPECT_EQ(damped.certainty, Certainty::theorem);
  EXPECT_TRUE(damped.cycles.empty());
  const LimitCycleAnalysis undamped = analyse_limit_cycles({.damping = 0.0});
  EXPECT_EQ(undamped.verdict, Verdict::undamped);
  EXPECT_TRUE(undamped.cycles.empty());
}

TEST(EdgeVerdict, BadServosAreRefused) {
  EXPECT_THROW(analyse_limit_cycles({.damping = -1.0}), InvalidInput);
  EXPECT_THROW(analyse_limit_cycles({.damping = nan}), InvalidInput);
  EXPECT_THROW(analyse_limit_cycles({.damping = 0.1, .inertia_ratio = 1.0, .restitution = 1.5}),
               InvalidInput);
}

TEST(EdgeVerdict, WordsForEach) {
  EXPECT_STREQ(name_of(Verdict::cannot_hunt), "cannot hunt");
  EXPECT_STREQ(name_of(Verdict::hunts), "hunts");
  EXPECT_STREQ(name_of(Verdict::hunts_if_disturbed), "hunts if disturbed");
  EXPECT_STREQ(name_of(Verdict::hunts_irregularly), "hunts irregularly");
  EXPECT_STREQ(name_of(Verdict::grows_without_bound), "grows without bound");
  EXPECT_STREQ(name_of(Verdict::undamped), "undamped");
  EXPECT_STREQ(name_of(Verdict::undecided), "undecided");
  EXPECT_STREQ(name_of(CycleKind::symmetric), "symmetric");
  EXPECT_STREQ(name_of(CycleKind::asymmetric), "asymmetric");
  EXPECT_STREQ(name_of(CycleKind::subharmonic), "subharmonic");
}

// ---- with restitution ---------------------------------------------------------------------------

NormalizedServo sample(double restitution) {
  return {.damping = 0.19,
          .inertia_ratio = 2.0,
          .friction_ratio = 0.1,
          .backlash = 0.3,
          .restitution = restitution};
}

TEST(OracleRestitution, SizesOfSettledRuns) {
  const LimitCycleAnalysis slight = analyse_limit_cycles(sample(0.3));
  EXPECT_EQ(slight.verdict, Verdict::hunts);
  ASSERT_FALSE(slight.cycles.empty());
  EXPECT_NEAR(slight.cycles.front().amplitude, 0.2401, 0.5e-4);
  EXPECT_TRUE(slight.cycles.front().settles);
  // At e = 0.6 the motion takes hundreds of periods to its cycle, which is asymmetric: the design's
  // 0.2172 was read before the end, and is 0.3 % too large.
  const LimitCycleAnalysis middle = analyse_limit_cycles(sample(0.6));
  EXPECT_EQ(middle.verdict, Verdict::hunts);
  const double late = sampled_amplitude(long_run(sample(0.6), 1.0, 2e4), 2e4 - 20.0);
  EXPECT_NEAR(late, 0.216536, 2e-6);
  EXPECT_NEAR(late, 0.2172, 1e-3);
  const bool seen =
      std::any_of(middle.cycles.begin(), middle.cycles.end(), [&](const LimitCycle& cycle) {
        return cycle.stable && std::abs(cycle.amplitude - late) < 2e-5 * late;
      });
  EXPECT_TRUE(seen) << "a long run ends at " << late;
  // At 0.9 the motion does not repeat, and the last bit of a root decides where it is after 2000 s;
  // 0.1709 is one of the amplitudes it passes through, and its extent over 150 swings is not
  // chance.
  const LimitCycleAnalysis lively = analyse_limit_cycles(sample(0.9));
  const double range = sampled_amplitude(long_run(sample(0.9), 0.2, 2000.0), 1000.0);
  EXPECT_NEAR(range, 0.1725, 2e-3);
  if (lively.verdict == Verdict::hunts_irregularly) {
    EXPECT_NEAR(lively.irregular_amplitude, range, 5e-3);
  }
}

TEST(PropertyRestitution, EveryReportedCycleReturnsToItself) {
  TracedDraws draws(704);
  int cycles = 0;
  for (int i = 0; i < 25 && !testing::Test::HasFailure(); ++i) {
    NormalizedServo servo = random_servo(draws);
    servo.restitution = draws.uniform(0.05, 0.8);
    SCOPED_TRACE(described(servo));
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    double amplitude_before = infinity;
    for (const LimitCycle& cycle : analysis.cycles) {
      ++cycles;
      ASSERT_LE(cycle.amplitude, amplitude_before);
      amplitude_before = cycle.amplitude;
      ASSERT_LE(cycle.residual, 1e-10);
      ASSERT_EQ(cycle.stable, std::abs(cycle.multiplier) < 1.0);
      ASSERT_GE(cycle.impacts_per_period, 2U);
      // A tenth of the first flight later, and a period after that, clear of the events.
      const double offset =
          0.01 * cycle.separated_time / static_cast<double>(cycle.impacts_per_period);
      const Trajectory motion =
          simulate(servo, cycle.start, {.until = cycle.period + offset, .reference = 0.0});
      const ServoState first = motion.at(offset);
      const ServoState again = motion.at(offset + cycle.period);
      // The residual allowed, multiplied along one period.
      const double scale = std::max(cycle.amplitude, cycle.motor_amplitude);
      const double tolerance = 1e-8 * scale * std::max(1.0, std::abs(cycle.multiplier));
      ASSERT_NEAR(first.load_position, again.load_position, tolerance);
      ASSERT_NEAR(first.motor_position, again.motor_position, tolerance);
      ASSERT_NEAR(first.load_speed, again.load_speed, tolerance);
      ASSERT_NEAR(first.motor_speed, again.motor_speed, tolerance);
      ASSERT_NEAR(sampled_amplitude(motion, 0.0), cycle.amplitude, 1e-4 * cycle.amplitude);
      ASSERT_NEAR(cycle.engaged_time + cycle.separated_time, cycle.period, 1e-9);
      const EnergyAccount books = motion.energy_at(offset + cycle.period);
      const EnergyAccount start = motion.energy_at(offset);
      ASSERT_NEAR(books.supplied - start.supplied, cycle.energy.total(),
                  1e-7 * cycle.energy.total());
      ASSERT_NEAR(books.impacts - start.impacts, cycle.energy.impacts, 1e-7 * cycle.energy.total());
    }
  }
  EXPECT_GT(cycles, 8);
}

/// Size at the start of crossing number n, run by the simulator from a cycle's start disturbed by a
/// common factor; the largest multiplier is the rate at which the disturbance grows.
TEST(PropertyRestitution, MultiplierIsTheRateAtWhichADisturbanceOfASettledCycleGrows) {
  TracedDraws draws(705);
  int compared = 0;
  for (int i = 0; i < 40 && compared < 8 && !testing::Test::HasFailure(); ++i) {
    NormalizedServo servo = random_servo(draws);
    servo.restitution = draws.uniform(0.05, 0.4);
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    for (const LimitCycle& cycle : analysis.cycles) {
      if (!cycle.settles || cycle.kind != CycleKind::symmetric) continue;
      SCOPED_TRACE(described(servo));
      ++compared;
      // Settled bounces leave one number at each parting: its distance from the cycle's own.
      const auto partings = [&](double factor) {
        ServoState start = cycle.start;
        start.load_speed *= factor;
        start.motor_speed *= factor;
        const Trajectory motion =
            simulate(servo, start, {.until = 3.2 * cycle.period, .reference = 0.0});
        std::vector<double> positions;
        for (const Event& event : motion.events()) {
          if (event.kind == EventKind::separation) {
            positions.push_back(std::abs(event.after.load_speed) +
                                std::abs(event.after.load_position));
          }
        }
        return positions;
      };
      const std::vector<double> up = partings(1.0 + 1e-5);
      const std::vector<double> down = partings(1.0 - 1e-5);
      ASSERT_EQ(up.size(), down.size());
      ASSERT_GE(up.size(), 3U);
      // Two half cycles between the first and the third parting: a whole period.
      const double rate = (up[2] - down[2]) / (up[0] - down[0]);
      ASSERT_NEAR(rate, cycle.multiplier, 1e-4 * std::max(1.0, std::abs(cycle.multiplier)));
    }
  }
  EXPECT_GE(compared, 4);
}

TEST(PropertyRestitution, VerdictIsWhatALongSimulationDoes) {
  TracedDraws draws(706);
  int hunting = 0;
  int resting = 0;
  for (int i = 0; i < 40 && !testing::Test::HasFailure(); ++i) {
    NormalizedServo servo = random_servo(draws);
    servo.restitution = draws.uniform(0.05, 0.5);
    SCOPED_TRACE(described(servo));
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    if (std::abs(analysis.growth_at_rest - 1.0) < 0.01) continue;
    constexpr double until = 2e4;
    for (const double amplitude : {0.1 * servo.backlash, 10.0 * servo.backlash}) {
      const Trajectory motion = long_run(servo, amplitude, until);
      const double found = sampled_amplitude(motion, until - 50.0);
      if (analysis.verdict == Verdict::cannot_hunt) {
        ++resting;
        ASSERT_LT(found, 0.05 * servo.backlash) << "from " << amplitude;
      } else if (analysis.verdict == Verdict::hunts) {
        ++hunting;
        const bool known = std::any_of(
            analysis.cycles.begin(), analysis.cycles.end(), [&](const LimitCycle& cycle) {
              return cycle.stable && std::abs(cycle.amplitude - found) < 1e-4 * found;
            });
        ASSERT_TRUE(known) << "a run from " << amplitude << " ends at " << found;
      }
    }
  }
  EXPECT_GT(hunting, 10);
  EXPECT_GT(resting, 10);
}

TEST(PropertyRestitution, NearlyElasticTendsToTheElasticCycle) {
  // A light motor with friction: its bounces fade away as 1/n, not geometrically.
  NormalizedServo servo{.damping = 0.19,
                        .inertia_ratio = 100.0,
                        .friction_ratio = 0.1,
                        .backlash = 0.3,
                        .restitution = 1.0};
  const LimitCycleAnalysis elastic = analyse_limit_cycles(servo);
  EXPECT_EQ(elastic.verdict, Verdict::hunts);
  ASSERT_EQ(elastic.cycles.size(), 1U);
  EXPECT_TRUE(elastic.cycles[0].stable);
  for (const double small : {1e-5, 1e-7, 1e-9}) {
    servo.restitution = 1.0 - small;
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    ASSERT_EQ(analysis.cycles.size(), 1U) << small;
    EXPECT_NEAR(analysis.growth_at_rest, elastic.growth_at_rest, 10.0 * small + 1e-6) << small;
    EXPECT_NEAR(analysis.cycles[0].amplitude, elastic.cycles[0].amplitude, small + 1e-8) << small;
    EXPECT_NEAR(analysis.cycles[0].period, elastic.cycles[0].period, 10.0 * small + 1e-7) << small;
  }
}

TEST(EdgeRestitution, ElasticOverdampedServosAreDecided) {
  // Pressed together while the motion decays, elastic faces bounce without end.
  for (const double damping : {1.0, 1.2}) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles({.damping = damping,
                                                              .inertia_ratio = 1.0,
                                                              .friction_ratio = 0.1,
                                                              .backlash = 0.3,
                                                              .restitution = 1.0});
    EXPECT_EQ(analysis.verdict, Verdict::cannot_hunt) << damping;
  }
}

// ---- servos that rest while their faces stay together -------------------------------------------

/// Faces parting forward at an amplitude.
ServoState parted(const NormalizedServo& servo, double amplitude) {
  const TorqueFreeLine line = servo_dynamics(servo).torque_free_line;
  const double position = amplitude * line.position;
  const double speed = amplitude * line.speed;
  return {position + 0.5 * servo.backlash, speed, position, speed};
}

NormalizedServo overdamped_servo(SeededDraws& draws) {
  const double share = draws.log_uniform(1e-5, 1.0);
  return {.damping = draws.happens(0.05) ? 1.0 : draws.log_uniform(1.0, 10.0),
          .inertia_ratio = draws.log_uniform(0.03, 30.0),
          .friction_ratio = draws.happens(0.5) ? share : 1.0 - share,
          .backlash = 0.3};
}

/// Whether the motion ends engaged, and the load where it was told to be.
bool rests_engaged(const NormalizedServo& servo, const ServoState& start) {
  const double slow_rate =
      1.0 / (servo.damping + std::sqrt((servo.damping - 1.0) * (servo.damping + 1.0)));
  const double size = std::abs(start.load_position) + std::abs(start.load_speed);
  const double until = 60.0 / slow_rate + 1e3;
  const Trajectory motion = simulate(servo, start, {.until = until, .reference = 0.0});
  const bool is_engaged =
      !motion.events().empty() && motion.events().back().mode_after != Mode::separated;
  return is_engaged && std::abs(motion.at(until).load_position) < 1e-6 * size;
}

TEST(PropertyVerdict, OverdampedServosRestAfterLargeMotionsAndHuntAfterSmallOnes) {
  TracedDraws draws(641);
  int hunting = 0;
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    const NormalizedServo servo = overdamped_servo(draws);
    SCOPED_TRACE(described(servo));
    const LimitCycleAnalysis analysis = enclose_limit_cycles(servo, Reading::exact);
    ASSERT_TRUE(analysis.is_proved());
    ASSERT_TRUE(analysis.rests_engaged);
    // A flight across the gap is then short beside all else: the faces stay together.
    const ServoState large = parted(servo, 1e6 * servo.backlash);
    EXPECT_TRUE(analysis.growth_at_rest == 0.0 || rests_engaged(servo, large));
    const ServoState mirrored{-large.motor_position, -large.motor_speed, -large.load_position,
                              -large.load_speed};
    EXPECT_TRUE(analysis.growth_at_rest == 0.0 || rests_engaged(servo, mirrored));
    if (analysis.verdict == Verdict::hunts) {
      const LimitCycle& cycle = analysis.cycles.front();
      const ServoState& start = cycle.start;
      const double amplitude = std::hypot(start.load_position, start.load_speed);
      // Disturbances shrink by the multiplier; where that is near 1, or creeping takes long, a
      // simulation says nothing.
      if (cycle.multiplier > 0.5) continue;
      ++hunting;
      const double until = 60.0 * cycle.period;
      const Trajectory motion =
          simulate(servo, parted(servo, 0.5 * amplitude), {.until = until, .reference = 0.0});
      EXPECT_NEAR(extremes(motion, until - 1.5 * cycle.period, until).load_amplitude(),
                  cycle.amplitude, 1e-6 * cycle.amplitude);
    } else {
      ASSERT_EQ(analysis.verdict, Verdict::cannot_hunt);
      const Trajectory motion = simulate(servo, engaged_start(servo, -servo.backlash, 0.0, 0.0),
                                         {.until = 3e4, .reference = 0.0});
      EXPECT_LT(std::abs(motion.at(3e4).load_position), 0.05 * servo.backlash);
    }
  }
  EXPECT_GT(hunting, 300);
}

TEST(EdgeRestitution, LightlyDampedCyclesAreFoundFarOutsideTheScan) {
  // The largest is 8e4 rad, which a motion from rest reaches in some 1e8 crossings of the gap.
  for (NormalizedServo servo :
       {NormalizedServo{1e-8, 1.0, 0.3, 0.3, 1e-12}, NormalizedServo{1e-5, 1e6, 0.3, 0.3, 1e-12},
        NormalizedServo{1e-6, 30.0, 0.6, 0.3, 1e-9}}) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    EXPECT_EQ(analysis.verdict, Verdict::hunts);
    ASSERT_EQ(analysis.cycles.size(), 1U);
    servo.restitution = 0.0;
    const double plastic = analyse_limit_cycles(servo).cycles.at(0).amplitude;
    EXPECT_NEAR(analysis.cycles[0].amplitude, plastic, 1e-6 * plastic);
  }
}

TEST(EdgeRestitution, CyclesThatCannotBeToldFromTheirNeighboursAreNotListed) {
  // Equal rates of decay and elastic faces: a continuum of swings. And damping below rounding.
  for (const NormalizedServo& servo :
       {NormalizedServo{0.5, 1.0, 0.5, 0.3, 1.0}, NormalizedServo{1e-12, 1e9, 0.0, 0.3, 1e-12}}) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    EXPECT_EQ(analysis.verdict, Verdict::undecided);
    EXPECT_TRUE(analysis.neutral_swings);
    EXPECT_TRUE(analysis.cycles.empty());
  }
}

TEST(EdgeRestitution, IrregularMotionBesideAStableCycleIsTold) {
  const NormalizedServo servo{0.1, 2.0, 0.1, 0.3, 0.95};
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  EXPECT_EQ(analysis.verdict, Verdict::hunts);
  // Unstable cycles beside it, which the irregular motion passes by, may be larger.
  const LimitCycle* const stable = largest_stable(analysis);
  ASSERT_NE(stable, nullptr);
  // What two step responses end in.
  const auto final_amplitude = [&](double step) {
    const Trajectory motion =
        simulate(servo, engaged_start(servo, 0.0, 0.0, step), {.until = 3000.0, .reference = step});
    return extremes(motion, 2500.0, 3000.0).load_amplitude();
  };
  EXPECT_NEAR(final_amplitude(0.2), stable->amplitude, 1e-9);
  EXPECT_NEAR(final_amplitude(0.02), analysis.irregular_amplitude, 2e-3);
}

TEST(EdgeRestitution, MotionThatDiesAwaySlowlyIsNoHunting) {
  // Equal rates of decay on both sides: growth at rest is e itself.
  for (const double restitution : {0.9, 0.99, 0.999}) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles({0.5, 1.0, 0.5, 0.3, restitution});
    EXPECT_EQ(analysis.verdict, Verdict::cannot_hunt);
    EXPECT_NEAR(analysis.growth_at_rest, restitution, 1e-9);
  }
}

}  // namespace
}  // namespace gearlash::limit_cycle_test
