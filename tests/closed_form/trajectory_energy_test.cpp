// The books: every entry is computed from its own definition, so their balance is a test of all.
#include <gtest/gtest.h>

#include "base/traced_draws.hpp"
#include "closed_form/trajectory.hpp"
#include "random_starts.hpp"

namespace gearlash::trajectory_energy_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Elastic faces pressed together bounce ever faster under the drag: five hundred events will do.
constexpr std::size_t event_limit = 500;

Trajectory run(const RandomStart& start, double until) {
  return simulate(start.servo, start.initial,
                  {.until = until, .reference = start.reference, .event_limit = event_limit});
}

struct Balance {
  double residual;
  double turnover;  ///< everything that went in or out or is there
};

Balance balance(const Trajectory& motion, double time) {
  const EnergyAccount start = motion.energy_at(0.0);
  const EnergyAccount now = motion.energy_at(time);
  // What was lost in an impact at time 0 is booked before `start` is read.
  const double lost = now.motor_friction + now.load_friction + now.impacts - start.impacts;
  return {std::abs(start.stored() + now.supplied - now.stored() - lost),
          start.stored() + now.stored() + std::abs(now.supplied) + now.motor_friction +
              now.load_friction + now.impacts};
}

/// Sixty-four roundings for each phase, of the turnover: each integral is a sum of ten or so panels
/// of thirty points.
double permitted(const Trajectory& motion, const Balance& books) {
  return 64.0 * epsilon * books.turnover * static_cast<double>(motion.segments().size());
}

void expect_balanced(const RandomStart& start, double until, SeededDraws& draws) {
  SCOPED_TRACE(describe(start));
  const Trajectory motion = run(start, until);
  for (int k = 0; k < 4; ++k) {
    const double end = motion.end_time();
    const double time = k == 0 ? end : draws.uniform(0.0, end);
    const Balance books = balance(motion, time);
    ASSERT_LE(books.residual, permitted(motion, books))
        << books.residual / (epsilon * books.turnover) << " epsilons at " << time << " over "
        << motion.segments().size() << " phases";
  }
}

TEST(PropertyEnergy, BooksBalanceForRandomServos) {
  TracedDraws draws(301);
  for (int i = 0; i < 600 && !testing::Test::HasFailure(); ++i) {
    expect_balanced(random_start(draws), 20.0, draws);
  }
}

TEST(PropertyEnergy, BooksBalanceForMasslessSides) {
  TracedDraws draws(302);
  for (int i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    RandomStart start = random_start(draws);
    start.servo.damping = draws.uniform(0.05, 1.5);
    start.servo.friction_ratio = draws.uniform(0.05, 0.95);
    start.servo.inertia_ratio = draws.one_of({0.0, std::numeric_limits<double>::infinity()});
    // A massless shaft has no kinetic energy to lose when it starts at another speed than its law.
    start.initial.motor_speed = start.initial.load_speed;
    expect_balanced(start, 20.0, draws);
  }
}

TEST(PropertyEnergy, EntriesOfLossNeverFall) {
  SeededDraws draws(304);
  for (int i = 0; i < 100; ++i) {
    const RandomStart start = random_start(draws, {.massless_sides = true});
    const Trajectory motion = run(start, 10.0);
    EnergyAccount before;
    for (int k = 0; k <= 40; ++k) {
      const EnergyAccount now = motion.energy_at(0.25 * k);
      const double noise = 1e3 * epsilon * (now.motor_friction + now.load_friction);
      ASSERT_GE(now.motor_friction, before.motor_friction - noise) << describe(start);
      ASSERT_GE(now.load_friction, before.load_friction - noise) << describe(start);
      ASSERT_GE(now.impacts, before.impacts) << describe(start);
      before = now;
    }
  }
}

TEST(OracleEnergy, EngagedStepResponseLosesWhatItsClosedFormSays) {
  // No gap, ζ = 0.5 from y = −1 at rest: everything stored at the start is lost in friction.
  const NormalizedServo servo{.damping = 0.5, .inertia_ratio = 3.0, .friction_ratio = 0.25};
  const Trajectory motion = simulate(servo, {}, {.until = 100.0, .reference = 1.0});
  const EnergyAccount end = motion.energy_at(100.0);
  EXPECT_NEAR(end.motor_friction, 0.375, 64.0 * epsilon);
  EXPECT_NEAR(end.load_friction, 0.125, 64.0 * epsilon);
  EXPECT_EQ(end.supplied, 0.0);
  EXPECT_EQ(end.impacts, 0.0);
}

TEST(PropertyEnergy, LongRunsDoNotDrift) {
  // Tens of thousands of phases: rounding errors add like a random walk, far below one a phase.
  for (const double restitution : {0.0, 0.6}) {
    const NormalizedServo servo{.damping = 0.19,
                                .inertia_ratio = 2.0,
                                .friction_ratio = 0.1,
                                .backlash = 0.3,
                                .restitution = restitution};
    constexpr double until = 1e5;
    const Trajectory motion =
        simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = until, .reference = 1.0});
    EXPECT_EQ(motion.stop_reason(), StopReason::reached_end);
    EXPECT_GT(motion.events().size(), 30000U);
    const Balance books = balance(motion, until);
    EXPECT_LE(books.residual, permitted(motion, books));
    EXPECT_LE(books.residual, 1e-11 * books.turnover) << restitution;
  }
}

}  // namespace
}  // namespace gearlash::trajectory_energy_test
