// Impacts, the question whether faces stay together, and the limit of accumulating bounces.
#include "closed_form/contact_law.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/references.hpp"
#include "base/special_numbers.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/engaged_flow.hpp"

namespace gearlash::contact_law_test {
namespace {

ServoDynamics dynamics_of(double damping, double inertia_ratio, double friction_ratio,
                          double restitution) {
  return servo_dynamics({.damping = damping,
                         .inertia_ratio = inertia_ratio,
                         .friction_ratio = friction_ratio,
                         .backlash = 0.3,
                         .restitution = restitution});
}

struct Momentum {
  double momentum;
  double energy;
  double scale;  ///< the sum of the momenta's moduli
};

Momentum momentum_of(const ServoDynamics& dynamics, double load_speed, double gap_speed) {
  const double motor_speed = load_speed + gap_speed;
  const double motor = dynamics.motor_inertia * motor_speed;
  const double load = dynamics.load_inertia * load_speed;
  return {motor + load, 0.5 * (motor * motor_speed + load * load_speed),
          std::abs(motor) + std::abs(load) + dynamics.motor_inertia * std::abs(gap_speed)};
}

TEST(PropertyImpact, MomentumIsKeptAndEnergyNeverGrows) {
  TracedDraws draws(99);
  for (int i = 0; i < 50000; ++i) {
    const double restitution =
        draws.happens(0.3) ? draws.one_of({0.0, 1.0}) : draws.uniform(0.0, 1.0);
    const ServoDynamics dynamics = dynamics_of(0.3, draws.log_uniform(1e-9, 1e9), 0.5, restitution);
    const double load_speed = draws.uniform(-1.0, 1.0);
    const double gap_speed = draws.either_sign(1e-9, 1.0);
    const ImpactOutcome outcome = impact(dynamics, load_speed, gap_speed);
    const Momentum before = momentum_of(dynamics, load_speed, gap_speed);
    const Momentum after = momentum_of(dynamics, outcome.load_speed, outcome.gap_speed);
    // J_M + J_L = 1 only to rounding, and each sum of two momenta rounds: a handful of epsilons.
    ASSERT_NEAR(after.momentum, before.momentum, 8.0 * epsilon * (before.scale + after.scale));
    ASSERT_EQ(outcome.gap_speed, restitution == 0.0 ? 0.0 : -restitution * gap_speed);
    ASSERT_FALSE(restitution == 0.0 && std::signbit(outcome.gap_speed));
    ASSERT_GE(outcome.energy_lost, 0.0);
    ASSERT_TRUE(restitution < 1.0 || outcome.energy_lost == 0.0);
    const double turnover = before.energy + after.energy + gap_speed * gap_speed;
    ASSERT_NEAR(before.energy - after.energy, outcome.energy_lost, 8.0 * epsilon * turnover);
  }
}

TEST(EdgeImpact, MasslessSidesEngageAtOnceWithoutLoss) {
  const ServoDynamics no_load = dynamics_of(0.3, 0.0, 0.5, 0.8);
  const ImpactOutcome load = impact(no_load, 1.0, -2.0);
  EXPECT_EQ(load.gap_speed, 0.0);
  EXPECT_EQ(load.load_speed, -1.0);  // the motor's speed
  EXPECT_EQ(load.energy_lost, 0.0);
  const ServoDynamics no_motor = dynamics_of(0.3, infinity, 0.5, 0.8);
  const ImpactOutcome motor = impact(no_motor, 1.0, -2.0);
  EXPECT_EQ(motor.gap_speed, 0.0);
  EXPECT_EQ(motor.load_speed, 1.0);
  EXPECT_EQ(motor.energy_lost, 0.0);
}

TEST(EdgeImpact, NoSpeedNoImpact) {
  const ImpactOutcome outcome = impact(dynamics_of(0.3, 2.0, 0.5, 0.5), 0.7, 0.0);
  EXPECT_EQ(outcome.load_speed, 0.7);
  EXPECT_EQ(outcome.gap_speed, 0.0);
  EXPECT_EQ(outcome.energy_lost, 0.0);
}

TEST(EdgeStaysEngaged, ByTheSignOfTheTorqueThenOfItsRate) {
  // ζ = 0: N = −J_L y, Ṅ = −J_L v.
  const ServoDynamics free = dynamics_of(0.0, 1.0, 0.0, 0.0);
  EXPECT_TRUE(stays_engaged(free, 1.0, -0.1, 5.0));
  EXPECT_FALSE(stays_engaged(free, 1.0, 0.1, -5.0));
  EXPECT_TRUE(stays_engaged(free, -1.0, 0.1, 0.0));
  EXPECT_FALSE(stays_engaged(free, -1.0, -0.1, 0.0));
  EXPECT_TRUE(stays_engaged(free, 1.0, 0.0, -1.0));  // about to push
  EXPECT_FALSE(stays_engaged(free, 1.0, 0.0, 1.0));  // about to pull
  EXPECT_TRUE(stays_engaged(free, -1.0, 0.0, 1.0));
  EXPECT_TRUE(stays_engaged(free, 1.0, 0.0, 0.0));  // vanishes for good
  EXPECT_TRUE(stays_engaged(free, -1.0, 0.0, 0.0));
}

TEST(PropertyStaysEngaged, AgreesWithTheRawEquations) {
  // The mesh torque is J_L ÿ + F_L ẏ with ÿ = −2ζẏ − y.
  SeededDraws draws(101);
  for (int i = 0; i < 20000; ++i) {
    const ServoDynamics dynamics = servo_dynamics({.damping = draws.uniform(0.0, 2.0),
                                                   .inertia_ratio = draws.log_uniform(1e-3, 1e3),
                                                   .friction_ratio = draws.uniform(0.0, 1.0),
                                                   .backlash = 0.3});
    const double y = draws.uniform(-1.0, 1.0);
    const double v = draws.uniform(-1.0, 1.0);
    const double face = draws.sign();
    const Wide torque = Wide(dynamics.load_inertia) *
                            (-(Wide(dynamics.motor_friction) + dynamics.load_friction) * v - y) +
                        Wide(dynamics.load_friction) * v;
    const double noise = 8.0 * epsilon * (dynamics.load_inertia * (std::abs(y) + 4.0) + 4.0);
    if (std::abs(torque) < noise) continue;
    ASSERT_EQ(stays_engaged(dynamics, face, y, v), face * torque > 0);
  }
}

// ---- the Zeno limit -----------------------------------------------------------------------------

/// State in the frame of the flight: y, v, u − u_face, u̇.
struct WideBounce {
  Wide y, v, u, w;
};

WideBounce moved(const ServoDynamics& dynamics, const WideBounce& start, const Wide& t) {
  // ẏ = v, v̇ = −D v, u̇ = w, ẇ = −c (v + w) − y/J_M + D v; short times: the series converges fast.
  WideBounce term = start;
  WideBounce sum = start;
  const Wide c = dynamics.motor_rate;
  const Wide d = dynamics.load_rate;
  const Wide stiffness = 1 / Wide(dynamics.motor_inertia);
  for (int k = 1; k < 20; ++k) {
    const WideBounce rate{term.v, -d * term.v, term.w,
                          -c * (term.v + term.w) - stiffness * term.y + d * term.v};
    const Wide share = t / k;
    term = {rate.y * share, rate.v * share, rate.u * share, rate.w * share};
    sum = {sum.y + term.y, sum.v + term.v, sum.u + term.u, sum.w + term.w};
  }
  return sum;
}

struct BouncesFollowed {
  double duration;
  double energy_lost;
  WideBounce end;
};

/// Every bounce, until the speed is 1e-25 of what it was.
BouncesFollowed follow(const ServoDynamics& dynamics, const GapState& start) {
  WideBounce state{start.load_position, start.load_speed, 0, start.gap_speed};
  const Wide last = std::abs(state.w) * 1e-25L;
  const Wide e = dynamics.restitution;
  const Wide reduced = Wide(dynamics.motor_inertia) * dynamics.load_inertia;
  Wide total = 0;
  Wide energy = 0;
  while (std::abs(state.w) > last) {
    const Wide acceleration = -Wide(dynamics.motor_rate) * (state.v + state.w) -
                              state.y / dynamics.motor_inertia + dynamics.load_rate * state.v;
    Wide t = -2 * state.w / acceleration;
    for (int k = 0; k < 6; ++k) {
      const WideBounce at = moved(dynamics, state, t);
      t -= at.u / at.w;
    }
    const WideBounce before = moved(dynamics, state, t);
    total += t;
    energy += reduced * (1 - e * e) * before.w * before.w / 2;
    state = {before.y, before.v + dynamics.motor_inertia * (1 + e) * before.w, 0, -e * before.w};
  }
  return {static_cast<double>(total), static_cast<double>(energy), state};
}

struct BounceStart {
  ServoDynamics dynamics;
  double face;
  GapState state;
};

/// A start pressed together on a face, of which the bounces to come take about `first_order`.
BounceStart bounce_start(SeededDraws& draws, double first_order) {
  BounceStart start;
  start.dynamics = servo_dynamics({.damping = draws.uniform(0.0, 1.0),
                                   .inertia_ratio = draws.log_uniform(0.1, 10.0),
                                   .friction_ratio = draws.uniform(0.0, 1.0),
                                   .backlash = 0.3,
                                   .restitution = draws.uniform(0.1, 0.9)});
  start.face = draws.sign();
  const double v = 0.1 * draws.uniform(-1.0, 1.0);
  const double y = -start.face * draws.uniform(0.5, 1.0);
  const double pressing = start.face * mesh_torque(start.dynamics, y, v) /
                          (start.dynamics.motor_inertia * start.dynamics.load_inertia);
  const double gap_speed =
      -start.face * 0.5 * first_order * pressing * (1.0 - start.dynamics.restitution);
  start.state = {y, v - start.dynamics.motor_inertia * gap_speed, 0.15 * start.face, gap_speed};
  return start;
}

TEST(OracleSettlingBounces, DurationIsRightToThirdOrder) {
  constexpr std::uint64_t seed = 103;
  SCOPED_TRACE(seed);
  SeededDraws seeds(seed);
  for (int i = 0; i < 12; ++i) {
    const auto start_seed = static_cast<std::uint64_t>(seeds.uniform(0.0, 1e9));
    double third_before = 0.0;   // error/T₀³, which tends to a number of the rates squared
    double energy_before = 0.0;  // the energy's relative error/T₀, likewise
    for (const double first_order : {2e-3, 1e-3, 5e-4}) {
      SeededDraws draws(start_seed);
      const BounceStart start = bounce_start(draws, first_order);
      const SettlingBounces closed =
          settling_bounces(start.dynamics, start.face, start.state.load_position,
                           start.state.load_speed, start.state.gap_speed);
      const BouncesFollowed followed = follow(start.dynamics, start.state);
      const double third = (closed.duration - followed.duration) / std::pow(first_order, 3);
      const double energy = (closed.energy_lost / followed.energy_lost - 1.0) / first_order;
      EXPECT_FALSE(closed.imminent);
      EXPECT_LE(std::abs(third), 100.0) << start_seed;
      EXPECT_LE(std::abs(energy), 20.0) << start_seed;
      if (first_order < 2e-3) {
        // They settle as T₀ shrinks: the next order has the rates to one power more.
        EXPECT_NEAR(third, third_before, 1000.0 * first_order) << start_seed;
        EXPECT_NEAR(energy, energy_before, 200.0 * first_order) << start_seed;
      }
      third_before = third;
      energy_before = energy;
    }
  }
}

TEST(OracleSettlingBounces, WhenImminentItIsRightToRounding) {
  TracedDraws draws(104);
  for (int i = 0; i < 20; ++i) {
    const double first_order = draws.log_uniform(1e-9, 8e-6);
    const BounceStart start = bounce_start(draws, first_order);
    const SettlingBounces closed =
        settling_bounces(start.dynamics, start.face, start.state.load_position,
                         start.state.load_speed, start.state.gap_speed);
    if (!closed.imminent) continue;  // rates above 1 shorten the threshold
    const BouncesFollowed followed = follow(start.dynamics, start.state);
    // 1e-15 of a unit of time left out, as the header says, and the closed form's own rounding.
    EXPECT_NEAR(closed.duration, followed.duration, 1e-15 + 8.0 * epsilon * first_order);
    // What is booked as lost differs by first order in T₀ of an energy itself of order T₀².
    EXPECT_NEAR(closed.energy_lost, followed.energy_lost,
                20.0 * first_order * followed.energy_lost);
    // Engaged in the state that the common motion reaches over T.
    const EngagedFlow common{
        start.dynamics.damping, start.state.load_position,
        start.state.load_speed + start.dynamics.motor_inertia * start.state.gap_speed};
    const EngagedFlow::State end = common.at(closed.duration);
    EXPECT_NEAR(end.position, static_cast<double>(followed.end.y), 4e-15);
    EXPECT_NEAR(end.speed, static_cast<double>(followed.end.v), 4e-15);
  }
}

TEST(EdgeSettlingBounces, NotWhilePulledApart) {
  const ServoDynamics dynamics = dynamics_of(0.2, 2.0, 0.3, 0.5);
  // y > 0 on the forward face: the torque would have to pull.
  EXPECT_FALSE(settling_bounces(dynamics, 1.0, 0.5, 0.0, -1e-12).imminent);
  EXPECT_TRUE(settling_bounces(dynamics, 1.0, -0.5, 0.0, -1e-12).imminent);
  EXPECT_TRUE(settling_bounces(dynamics, -1.0, 0.5, 0.0, 1e-12).imminent);
  EXPECT_FALSE(settling_bounces(dynamics, -1.0, 0.5, 0.0, 0.5).imminent);
}

}  // namespace
}  // namespace gearlash::contact_law_test
