// The symmetric cycle of plastic contact: numbers of many digits, its growth function, the
// simulator's books, and its symmetries.
#include "closed_form/plastic_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/described.hpp"
#include "base/references.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/extremes.hpp"
#include "closed_form/growth_at_rest.hpp"

namespace gearlash::plastic_cycle_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

LimitCycle only_cycle(const NormalizedServo& servo) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  EXPECT_EQ(analysis.verdict, Verdict::hunts);
  EXPECT_EQ(analysis.cycles.size(), 1U);
  return analysis.cycles.empty() ? LimitCycle{} : analysis.cycles.front();
}

/// The condition of the root is 1/(1 − R′), R′ the slope of the half map.
TEST(OraclePlasticCycle, KeepsItsDigits) {
  for (const Reference& exact : References("closed_form", "plastic_cycles")) {
    if (exact.kind() != "ordinary" || !(exact["growth"] > 1)) continue;
    const NormalizedServo servo{.damping = exact.input("damping"),
                                .inertia_ratio = exact.input("inertia_ratio"),
                                .friction_ratio = exact.input("friction_ratio"),
                                .backlash = 1.0};
    SCOPED_TRACE(described(servo));
    const LimitCycle cycle = only_cycle(servo);
    const double tolerance = 64.0 / (1.0 - std::sqrt(exact.input("multiplier")));
    EXPECT_LE(epsilons_off(cycle.amplitude, exact["amplitude"]), tolerance);
    EXPECT_LE(epsilons_off(cycle.period, exact["period"]), tolerance);
    EXPECT_LE(epsilons_of(cycle.multiplier, exact["multiplier"], 1.0), tolerance);
    EXPECT_TRUE(cycle.stable);
    EXPECT_TRUE(cycle.settles);
    EXPECT_EQ(cycle.kind, CycleKind::symmetric);
    EXPECT_EQ(cycle.impacts_per_period, 2U);
    EXPECT_LE(cycle.residual, 64.0 * epsilon);
  }
}

// ---- random servos that hunt --------------------------------------------------------------------

NormalizedServo hunting_servo(SeededDraws& draws) {
  while (true) {
    const NormalizedServo servo{.damping = draws.uniform(0.02, 0.9),
                                .inertia_ratio = draws.log_uniform(0.03, 30.0),
                                .friction_ratio = draws.uniform(0.02, 0.98),
                                .backlash = draws.log_uniform(0.01, 1.0)};
    if (growth_at_rest(servo_dynamics(servo)) > 1.03) return servo;
  }
}

TEST(PropertyPlasticCycle, GrowthIncreasesWithTheSlopeItReports) {
  TracedDraws draws(601);
  for (int i = 0; i < 500; ++i) {
    NormalizedServo servo{.damping = draws.uniform(0.0, 2.0),
                          .inertia_ratio = draws.log_uniform(0.03, 30.0),
                          .friction_ratio = draws.uniform(0.0, 1.0),
                          .backlash = 1.0};
    const ServoDynamics dynamics = servo_dynamics(servo);
    double before = -infinity;
    for (double time = 0.05; time < 40.0; time *= 1.2) {
      const UnitHalfCycle half = unit_half_cycle(dynamics, time);
      if (half.log_growth == -infinity) continue;
      const double noise = 1e-12 * (1.0 + std::abs(half.log_growth));
      ASSERT_GE(half.log_growth, before - noise) << described(servo) << " at " << time;
      before = half.log_growth;
      // Small against both the time and the scale on which ln ρ rises from −∞ where it starts.
      const double step = 1e-4 * std::min(time, 1.0 / std::abs(half.log_growth_slope));
      const double above = unit_half_cycle(dynamics, time + step).log_growth;
      const double below = unit_half_cycle(dynamics, time - step).log_growth;
      if (below == -infinity) continue;
      const double slope = (above - below) / (2.0 * step);
      // Central differences: (step/scale)² of the slope's own size, and rounding over the step.
      ASSERT_NEAR(half.log_growth_slope, slope,
                  1e-6 * std::abs(slope) + 1e-13 / step * (1.0 + std::abs(before)))
          << described(servo) << " at " << time;
    }
  }
}

TEST(PropertyPlasticCycle, GrowthTendsToTheGrowthAtRest) {
  TracedDraws draws(602);
  for (int i = 0; i < 300; ++i) {
    const NormalizedServo servo = hunting_servo(draws);
    const ServoDynamics dynamics = servo_dynamics(servo);
    const double slowest = std::min(dynamics.motor_rate, dynamics.load_rate);
    const UnitHalfCycle half = unit_half_cycle(dynamics, 60.0 / slowest);
    // e^{−60} is left; the sum of a creep of sixty time constants carries its epsilons.
    ASSERT_NEAR(half.log_growth, std::log(growth_at_rest(dynamics)), 1e-11) << described(servo);
  }
}

/// The largest J_L v̇ + F_L v of the load while the faces are together, by differences of its speed;
/// at the impact, by those that follow.
double sampled_mesh_torque(const NormalizedServo& servo, const Trajectory& motion) {
  const ServoDynamics dynamics = servo_dynamics(servo);
  constexpr int samples = 2000;
  double largest = 0.0;
  for (const Segment& segment : motion.segments()) {
    constexpr double of_rounding = 1e-9;  // as the cycle starts, where its faces part
    const bool is_short = segment.end - segment.start < of_rounding;
    if (segment.phase.mode == Mode::separated || is_short) continue;
    const double step = (segment.end - segment.start) / samples;
    const auto torque_at = [&](int place) {
      const double time = segment.start + step * place;
      const double acceleration =
          (motion.at(time + step).load_speed - motion.at(time - step).load_speed) / (2.0 * step);
      return dynamics.load_inertia * acceleration +
             dynamics.load_friction * motion.at(time).load_speed;
    };
    largest = std::max(largest, std::abs(3.0 * (torque_at(2) - torque_at(4)) + torque_at(6)));
    for (int i = 2; i + 1 < samples; ++i) largest = std::max(largest, std::abs(torque_at(i)));
  }
  return largest;
}

TEST(PropertyPlasticCycle, EverythingAgreesWithASimulatedPeriod) {
  TracedDraws draws(604);
  for (int i = 0; i < 400 && !testing::Test::HasFailure(); ++i) {
    const NormalizedServo servo = hunting_servo(draws);
    SCOPED_TRACE(described(servo));
    const LimitCycle cycle = only_cycle(servo);
    // From just after the parting to just before the next but one: half a quarter of flight each
    // way keeps every event clear of the ends.
    const double offset = 0.125 * cycle.separated_time;
    const Trajectory motion =
        simulate(servo, cycle.start, {.until = cycle.period + offset, .reference = 0.0});
    const double scale = std::max(cycle.amplitude, cycle.motor_amplitude);
    const double tolerance = 1e-10 * scale;
    const ServoState first = motion.at(offset);
    const ServoState again = motion.at(offset + cycle.period);
    ASSERT_NEAR(first.load_position, again.load_position, tolerance);
    ASSERT_NEAR(first.motor_position, again.motor_position, tolerance);
    ASSERT_NEAR(first.load_speed, again.load_speed, tolerance);
    ASSERT_NEAR(first.motor_speed, again.motor_speed, tolerance);

    const Extremes turns = extremes(motion, offset, offset + cycle.period);
    ASSERT_NEAR(turns.load_amplitude(), cycle.amplitude, 1e-12 * scale);
    ASSERT_NEAR(turns.motor_amplitude(), cycle.motor_amplitude, 1e-12 * scale);

    double hardest = 0.0;
    for (const Event& event : motion.events()) {
      if (event.kind != EventKind::impact) continue;
      hardest = std::max(hardest, std::abs(event.before.motor_speed - event.before.load_speed));
    }
    ASSERT_NEAR(cycle.impact_speed, hardest, 1e-10 * (scale + hardest));
    ASSERT_NEAR(cycle.engaged_time + cycle.separated_time, cycle.period, 4.0 * epsilon * 10.0);

    double engaged = 0.0;
    for (const Segment& segment : motion.segments()) {
      if (segment.phase.mode == Mode::separated) continue;
      engaged += std::max(0.0, std::min(segment.end, cycle.period) - segment.start);
    }
    ASSERT_NEAR(engaged, cycle.engaged_time, 1e-9);
    ASSERT_NEAR(cycle.mesh_torque, sampled_mesh_torque(servo, motion),
                1e-6 * (cycle.mesh_torque + scale));

    const EnergyAccount start = motion.energy_at(offset);
    const EnergyAccount end = motion.energy_at(offset + cycle.period);
    const double energy = 1e-9 * cycle.energy.total();
    ASSERT_NEAR(cycle.energy.motor_friction, end.motor_friction - start.motor_friction, energy);
    ASSERT_NEAR(cycle.energy.load_friction, end.load_friction - start.load_friction, energy);
    ASSERT_NEAR(cycle.energy.impacts, end.impacts - start.impacts, energy);
    ASSERT_NEAR(cycle.energy.total(), end.supplied - start.supplied, energy);
  }
}

TEST(PropertyPlasticCycle, SizeIsExactlyProportionalToBacklash) {
  TracedDraws draws(605);
  for (int i = 0; i < 500; ++i) {
    const NormalizedServo servo = hunting_servo(draws);
    const LimitCycle one = only_cycle(servo);
    for (const double factor : {4.0, draws.log_uniform(1e-3, 1e3)}) {
      NormalizedServo wider = servo;
      wider.backlash *= factor;
      const LimitCycle other = only_cycle(wider);
      // The backlash enters by one product; each number after it by two or three roundings.
      const double bits = factor == 4.0 ? 0.0 : 8.0 * epsilon;
      ASSERT_EQ(one.period, other.period);
      ASSERT_EQ(one.multiplier, other.multiplier);
      ASSERT_NEAR(other.amplitude, factor * one.amplitude, bits * other.amplitude);
      ASSERT_NEAR(other.motor_amplitude, factor * one.motor_amplitude,
                  bits * other.motor_amplitude);
      ASSERT_NEAR(other.impact_speed, factor * one.impact_speed, bits * other.impact_speed);
      ASSERT_NEAR(other.energy.total(), factor * factor * one.energy.total(),
                  8.0 * bits * other.energy.total());
    }
  }
}

TEST(PropertyPlasticCycle, ExchangingMotorAndLoadKeepsItsTimes) {
  TracedDraws draws(606);
  for (int i = 0; i < 500; ++i) {
    const NormalizedServo servo = hunting_servo(draws);
    NormalizedServo exchanged = servo;
    exchanged.friction_ratio = 1.0 - servo.friction_ratio;
    exchanged.inertia_ratio = 1.0 / servo.inertia_ratio;
    const LimitCycle one = only_cycle(servo);
    const LimitCycle other = only_cycle(exchanged);
    // 1 − f and 1/r are rounded; the cycle's condition is 1/(1 − R′), R′ the half map's slope.
    const double condition = 1.0 / (1.0 - std::sqrt(one.multiplier)) /
                             std::min(servo.friction_ratio, 1.0 - servo.friction_ratio);
    const double bits = 256.0 * epsilon * condition;
    ASSERT_NEAR(one.period, other.period, bits * one.period) << described(servo);
    ASSERT_NEAR(one.engaged_time, other.engaged_time, bits * one.period) << described(servo);
    ASSERT_NEAR(one.separated_time, other.separated_time, bits * one.period) << described(servo);
    ASSERT_NEAR(one.multiplier, other.multiplier, bits) << described(servo);
    ASSERT_NEAR(one.impact_speed, other.impact_speed, bits * one.impact_speed) << described(servo);
    ASSERT_NEAR(one.energy.impacts, other.energy.impacts, bits * one.energy.impacts)
        << described(servo);
  }
}

TEST(EdgePlasticCycle, ExtremesOfTheRangesThatHunt) {
  for (const double damping : {1e-9, 1e-3, 0.2}) {
    for (const double ratio : {0.0, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, infinity}) {
      for (const double share : {0.0, 1e-12, 1e-3, 0.1, 1.0 - 1e-3, 1.0}) {
        const NormalizedServo servo{
            .damping = damping, .inertia_ratio = ratio, .friction_ratio = share, .backlash = 0.3};
        if (!faults(servo).empty()) continue;
        const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
        SCOPED_TRACE(described(servo));
        ASSERT_EQ(analysis.verdict == Verdict::hunts, analysis.growth_at_rest > 1.0);
        if (analysis.verdict != Verdict::hunts) continue;
        const LimitCycle& cycle = analysis.cycles.at(0);
        EXPECT_TRUE(std::isfinite(cycle.amplitude) && cycle.amplitude > 0.0);
        EXPECT_GE(cycle.motor_amplitude, 0.0);
        EXPECT_TRUE(cycle.stable);
        EXPECT_GE(cycle.multiplier, 0.0);
        EXPECT_LE(cycle.residual, 1e-12);
        EXPECT_GE(cycle.energy.motor_friction, 0.0);
        EXPECT_GE(cycle.energy.load_friction, 0.0);
        EXPECT_GE(cycle.energy.impacts, 0.0);
      }
    }
  }
}

TEST(EdgePlasticCycle, MasslessSidesAreTheLimitsOfLightOnes) {
  for (const double share : {0.1, 0.4}) {
    NormalizedServo servo{
        .damping = 0.2, .inertia_ratio = 0.0, .friction_ratio = share, .backlash = 0.3};
    for (const auto& [massless, light] : {std::pair{0.0, 1e-8}, std::pair{infinity, 1e8}}) {
      servo.inertia_ratio = massless;
      const LimitCycleAnalysis limit = analyse_limit_cycles(servo);
      servo.inertia_ratio = light;
      const LimitCycleAnalysis near = analyse_limit_cycles(servo);
      ASSERT_EQ(limit.verdict, near.verdict) << massless;
      if (limit.cycles.empty()) continue;
      EXPECT_NEAR(limit.cycles[0].amplitude, near.cycles[0].amplitude, 1e-6)
          << massless << " " << share;
      EXPECT_NEAR(limit.cycles[0].motor_amplitude, near.cycles[0].motor_amplitude, 1e-6);
      EXPECT_NEAR(limit.cycles[0].period, near.cycles[0].period, 1e-5);
    }
  }
}

}  // namespace
}  // namespace gearlash::plastic_cycle_test
