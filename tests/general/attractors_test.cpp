// The attractors that a search finds beside the servo's closed form, and what must hold of any.
#include "general/attractors/attractors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/stopping.hpp"
#include "closed_form/limit_cycle.hpp"
#include "controllers.hpp"
#include "drives.hpp"

namespace gearlash::drive::attractors_test {
namespace {

NormalizedServo same_servo(double damping, double inertia_ratio, double friction_ratio,
                           double restitution = 0.0) {
  return {.damping = damping,
          .inertia_ratio = inertia_ratio,
          .friction_ratio = friction_ratio,
          .backlash = 0.3,
          .restitution = restitution};
}

/// By how much the state differs after a period, as a share of it.
double misfit_after_a_period(const hybrid::HybridSystem& system,
                             const hybrid::PeriodicOrbit& orbit) {
  const double from = orbit.start_time;
  const auto motion = simulate(system, orbit.start, {.from = from, .until = from + orbit.period});
  const hybrid::Vector& start = orbit.start.numbers;
  return (motion.end().numbers - start).cwiseAbs().maxCoeff() / start.cwiseAbs().maxCoeff();
}

// ---- the servo ----------------------------------------------------------------------------------

TEST(OracleAttractors, TheThesissServoHuntsFromEverywhere) {
  const AttractorSearch found = find_attractors(servo_drive(0.19, 2.0, 0.1));
  ASSERT_EQ(found.cycles.size(), 1U);
  const FoundCycle& cycle = found.cycles.front();
  EXPECT_NEAR(cycle.amplitude, 0.241611108, 5e-10);
  EXPECT_NEAR(cycle.period(), 6.456205, 5e-7);
  EXPECT_EQ(cycle.stability, Stability::stable);
  EXPECT_TRUE(cycle.is_symmetric);
  EXPECT_EQ(cycle.starts, found.outcomes.size());  // from creeping in the gap too
  EXPECT_FALSE(found.rest);
  EXPECT_TRUE(found.irregular.empty());
}

/// Both are exact: what is left is Newton's residual and rounding, times 1/(1 − multiplier).
TEST(OracleAttractors, PlasticServosAreTheClosedForm) {
  constexpr unsigned seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int hunting = 0;
  for (int i = 0; i < 20; ++i) {
    const double damping = 0.03 * std::pow(30.0, share(random));
    const double inertia_ratio = 0.05 * std::pow(400.0, share(random));
    const double friction_ratio = 0.03 + 0.94 * share(random);
    const auto exact = analyse_limit_cycles(same_servo(damping, inertia_ratio, friction_ratio));
    const auto found = find_attractors(servo_drive(damping, inertia_ratio, friction_ratio));
    SCOPED_TRACE(testing::Message() << damping << " " << inertia_ratio << " " << friction_ratio);
    EXPECT_EQ(found.count(MotionEnd::undecided), 0U);
    ASSERT_EQ(found.cycles.size(), exact.cycles.size());
    if (exact.verdict == Verdict::cannot_hunt) {
      ASSERT_TRUE(found.rest);
      EXPECT_EQ(found.rest->starts, found.outcomes.size());
      continue;
    }
    ++hunting;
    const FoundCycle& cycle = found.cycles.front();
    const LimitCycle& wanted = exact.cycles.front();
    EXPECT_NEAR(cycle.amplitude, wanted.amplitude, 1e-9 * wanted.amplitude);
    EXPECT_NEAR(cycle.motor_amplitude, wanted.motor_amplitude, 1e-9 * wanted.motor_amplitude);
    EXPECT_NEAR(cycle.period(), wanted.period, 1e-9 * wanted.period);
    EXPECT_NEAR(cycle.impact_speed, wanted.impact_speed, 1e-9 * wanted.impact_speed);
    EXPECT_NEAR(cycle.mesh_torque, wanted.mesh_torque, 1e-9 * wanted.mesh_torque);
    EXPECT_NEAR(cycle.multiplier, std::abs(wanted.multiplier), 1e-8);
  }
  EXPECT_GE(hunting, 10);
  EXPECT_LT(hunting, 20);
}

/// Swings that shrink towards rest do so by the growth at rest.
TEST(OracleAttractors, RestIsNearedByTheGrowthAtRest) {
  const auto exact = analyse_limit_cycles(same_servo(0.4284, 3.023, 0.7225));
  ASSERT_EQ(exact.verdict, Verdict::cannot_hunt);
  const auto found = find_attractors(servo_drive(0.4284, 3.023, 0.7225));
  ASSERT_TRUE(found.rest);
  EXPECT_NEAR(found.rest->swing_ratio, exact.growth_at_rest, 1e-4);
}

/// Restitution 0.6: two cycles that mirror each other are stable, the symmetric one between is not.
TEST(OracleAttractors, MirrorImagesCountAsOne) {
  const auto exact = analyse_limit_cycles(same_servo(0.19, 2.0, 0.1, 0.6));
  const auto found = find_attractors(servo_drive(0.19, 2.0, 0.1, 0.6));
  ASSERT_EQ(exact.cycles.size(), 2U);
  ASSERT_EQ(found.cycles.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(found.cycles[i].amplitude, exact.cycles[i].amplitude, 1e-9);
    EXPECT_NEAR(found.cycles[i].period(), exact.cycles[i].period, 1e-9);
    EXPECT_NEAR(found.cycles[i].multiplier, exact.cycles[i].multiplier, 1e-8);
    EXPECT_NEAR(found.cycles[i].mesh_torque, exact.cycles[i].mesh_torque, 1e-9);
  }
  EXPECT_EQ(found.cycles[0].stability, Stability::stable);
  EXPECT_TRUE(found.cycles[0].has_mirror_image);
  EXPECT_NEAR(found.cycles[0].centers.low, -found.cycles[0].centers.high, 1e-9);
  EXPECT_EQ(found.cycles[1].stability, Stability::unstable);
  EXPECT_TRUE(found.cycles[1].is_symmetric);
}

/// Restitution 0.9: the closed form sees bounded motion of amplitude 0.1723 that does not repeat.
TEST(OracleAttractors, ChaosIsMeasured) {
  const auto exact = analyse_limit_cycles(same_servo(0.19, 2.0, 0.1, 0.9));
  const auto found = find_attractors(servo_drive(0.19, 2.0, 0.1, 0.9));
  ASSERT_EQ(found.irregular.size(), 1U);
  const IrregularFound& motion = found.irregular.front();
  EXPECT_EQ(motion.starts, found.outcomes.size());
  EXPECT_NEAR(motion.amplitude, exact.irregular_amplitude, 0.005);
  EXPECT_GT(motion.exponent.value() * motion.period, 0.3);
  EXPECT_GT(motion.mismatch, 0.01);
  EXPECT_GT(motion.period_deviation, 0.01);
  for (const FoundCycle& cycle : found.cycles) {
    EXPECT_EQ(cycle.stability, Stability::unstable);
    const bool is_known =
        std::any_of(exact.cycles.begin(), exact.cycles.end(), [&](const LimitCycle& wanted) {
          return std::abs(cycle.amplitude - wanted.amplitude) < 1e-8 &&
                 std::abs(cycle.multiplier - std::abs(wanted.multiplier)) < 1e-6;
        });
    EXPECT_TRUE(is_known || !cycle.is_symmetric) << cycle.amplitude;
  }
}

// ---- what else there is -------------------------------------------------------------------------

/// Dry friction on the load makes rest stable; between it and the hunting there is an unstable
/// cycle, and a little beside that either is reached.
TEST(OracleAttractors, AnUnstableCycleSeparatesRestAndHunting) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.load.friction.coulomb = 0.01;
  drive.load.friction.breakaway = 0.015;
  const AttractorSearch found = find_attractors(drive);
  ASSERT_EQ(found.cycles.size(), 2U);
  const FoundCycle& hunting = found.cycles[0];
  const FoundCycle& between = found.cycles[1];
  EXPECT_EQ(hunting.stability, Stability::stable);
  EXPECT_EQ(between.stability, Stability::unstable);
  EXPECT_LT(between.amplitude, hunting.amplitude);
  ASSERT_FALSE(found.edges.empty());
  EXPECT_EQ(found.edges.front().cycle, 1U);
  ASSERT_TRUE(found.rest);
  // The load rests where the spring does not overcome its breakaway torque.
  EXPECT_LE(found.rest->load.high, 0.015);
  EXPECT_GE(found.rest->load.low, -0.015);

  // Half the peak-to-peak that a motion from beside the orbit ends with.
  const auto final_amplitude = [&](double factor) {
    hybrid::State beside = between.orbit.start;
    beside.numbers[motor_speed] *= factor;
    beside.numbers[load_speed] *= factor;
    const auto motion = simulate(found.system, beside, {.until = 30.0 * between.period()});
    const auto tail = simulate(found.system, motion.end(), {.until = hunting.period()});
    Extent load;
    load.include(tail.end().numbers[load_position]);
    for (const hybrid::Event& event : tail.events()) load.include(event.before[load_position]);
    return 0.5 * (load.high - load.low);
  };
  const double one = final_amplitude(0.97);
  const double other = final_amplitude(1.03);
  EXPECT_EQ(std::min(one, other), 0.0);
  EXPECT_GT(std::max(one, other), 0.9 * hunting.amplitude);
}

/// The loop is unstable, and a torque limit bounds its motion: however narrow the gap is beside
/// that, the motion does not run away.
TEST(OracleAttractors, ATorqueLimitBoundsMotionWhateverTheGap) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.controller = at_load(PID{PIDTerms::PD, 1.0, 0.0, -0.5});
  drive.torque_limit = 0.3;
  for (const double gap : {1e-9, 1e-11, 1e-13}) {
    drive.backlash = gap;
    const AttractorSearch found = find_attractors(drive);
    EXPECT_EQ(found.count(MotionEnd::cycle), found.outcomes.size()) << gap;
    ASSERT_EQ(found.cycles.size(), 1U) << gap;
    EXPECT_NEAR(found.cycles[0].amplitude, 0.444043, 1e-5) << gap;  // that without a gap
  }
}

/// s² + 0.38 s + 1 at s = 0.5i.
TEST(OracleAttractors, WithoutEventsASineIsAnsweredAsTheLinearLoopDoes) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.load = {0.5, {}};
  drive.motor = {0.5, {.viscous = 0.38}};
  drive.sensing.load_share_of_position = 0.0;
  drive.load_torque = 10.0;  // keeps the faces together
  drive.reference = Sine{0.0, 0.5, 0.5, 0.0};
  const AttractorSearch found =
      find_attractors(drive, {.starts = {{10.0, 0.0, 10.15, 0.0}, {9.0, 0.0, 9.15, 0.0}}});
  ASSERT_EQ(found.cycles.size(), 1U);
  const FoundCycle& cycle = found.cycles.front();
  EXPECT_NEAR(cycle.period(), 4.0 * std::acos(-1.0), 1e-9);
  EXPECT_NEAR(cycle.amplitude, 0.5 / std::hypot(1.0 - 0.25, 0.38 * 0.5), 1e-9);
  EXPECT_NEAR(cycle.center, 10.15, 1e-9);
  EXPECT_NEAR(cycle.multiplier, std::exp(-0.19 * cycle.period()), 1e-8);
  EXPECT_EQ(cycle.starts, 2U);
}

/// Sampled hunting that locks to no multiple of the clock is quasi-periodic: no exponent above 0.
TEST(OracleAttractors, AClockThatNothingLocksToIsNoChaos) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.sampling = Sampling{.period = 0.05, .delay = 0.02};
  const AttractorSearch found =
      find_attractors(drive, {.starts = {{0.15, 0.0, 0.3, 0.0}, {0.2, 0.0, 0.27, 0.0}}});
  EXPECT_TRUE(found.cycles.empty());
  ASSERT_EQ(found.irregular.size(), 1U);
  const IrregularFound& motion = found.irregular.front();
  EXPECT_EQ(motion.starts, 2U);
  EXPECT_LT(std::abs(motion.exponent.value()) * motion.period, 0.02);
  EXPECT_LT(motion.period_deviation, 1e-3);
  EXPECT_GT(motion.amplitude, 0.2416);  // the delay of half a period and 0.02 takes damping away
  // The second start joins the first one's motion before it has repeated its statistics.
  EXPECT_LT(found.outcomes[1].watched, 0.5 * found.outcomes[0].watched);
}

/// What a reference adds is nothing but place: fixed, or moving with a ramp (then friction counts).
TEST(PropertyAttractors, CyclesMoveWithTheReference) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  const auto starts = [](double place, double speed) {
    return AttractorOptions{.starts = {{place + 0.45, speed, place + 0.3, speed}}};
  };
  const AttractorSearch at_0 = find_attractors(drive, starts(0.0, 0.0));
  drive.reference = Ramp{1000.0, 0.0, 0.0};
  const AttractorSearch far = find_attractors(drive, starts(1000.0, 0.0));
  drive.reference = Ramp{5.0, 0.01, 0.0};
  drive.load_torque = 0.01 * 0.38;  // what friction takes at that speed
  const AttractorSearch moving = find_attractors(drive, starts(5.0, 0.01));
  ASSERT_EQ(at_0.cycles.size(), 1U);
  ASSERT_EQ(far.cycles.size(), 1U);
  ASSERT_EQ(moving.cycles.size(), 1U);
  EXPECT_EQ(far.coordinates, Coordinates::fixed);
  EXPECT_EQ(moving.coordinates, Coordinates::co_moving);
  EXPECT_NEAR(far.cycles[0].amplitude, at_0.cycles[0].amplitude, 1e-12);
  EXPECT_NEAR(far.cycles[0].center, 0.0, 1e-12);
  EXPECT_LT(misfit_after_a_period(moving.system, moving.cycles[0].orbit), 1e-11);
}

/// Encoders in a sampled drive stay where they are while the reference moves.
TEST(EdgeAttractors, WhatCannotBeCarriedAlongIsMeasuredInPlace) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.sampling = Sampling{.period = 0.05};
  drive.sensing.resolution = 0.01;
  drive.reference = Ramp{0.0, 0.3, 0.0};
  const AttractorSearch found =
      find_attractors(drive, {.starts = {{0.45, 0.3, 0.3, 0.3}}, .swing_times = 60.0});
  EXPECT_EQ(found.coordinates, Coordinates::in_place);
  ASSERT_EQ(found.irregular.size(), 1U);
  EXPECT_NEAR(found.irregular[0].amplitude, 0.27, 0.02);
}

/// Otherwise a fast computer's drive would be watched for a few swings only.
TEST(EdgeAttractors, TicksAreNotCountedAsEvents) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.sampling = Sampling{.period = 0.02};
  const AttractorSearch found = find_attractors(
      drive, {.starts = {{0.45, 0.0, 0.3, 0.0}}, .most_events = 1'000, .most_edges = 0});
  ASSERT_EQ(found.irregular.size(), 1U);
  EXPECT_GT(found.outcomes.front().watched, 200.0);
  EXPECT_NEAR(found.irregular.front().amplitude, 0.2416, 0.01);
}

/// The load creeps to rest while the motor sticks: the ticks then repeat what stands still.
TEST(EdgeAttractors, WhatStandsStillFromTickToTickIsAtRest) {
  ReducedDrive drive = servo_drive(0.02, 1.0, 0.15);
  drive.motor.friction.coulomb = 0.26;
  drive.motor.friction.breakaway = 0.43;
  drive.sampling = Sampling{.period = 0.015};
  const AttractorSearch found = find_attractors(drive);
  EXPECT_TRUE(found.cycles.empty());
  ASSERT_TRUE(found.rest);
  EXPECT_EQ(found.rest->starts, found.outcomes.size());
}

TEST(EdgeAttractors, ASearchStopsWhenItIsTold) {
  class TwoStarts : public Progress {
   public:
    bool go_on(double share, std::size_t /*bytes*/) override {
      if (shares.empty() || share != shares.back()) shares.push_back(share);
      return shares.size() < 3;
    }
    std::vector<double> shares;
  };
  TwoStarts progress;
  const AttractorSearch found = find_attractors(servo_drive(0.19, 2.0, 0.1), {}, progress);
  EXPECT_FALSE(found.is_complete);
  EXPECT_EQ(found.outcomes.size(), 2U);
  EXPECT_TRUE(std::is_sorted(progress.shares.begin(), progress.shares.end()));
}

TEST(EdgeAttractors, ALoadTorqueThatGrowsForEverIsRefused) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.load_torque = Ramp{0.0, 1.0, 0.0};
  EXPECT_THROW(find_attractors(drive), InvalidInput);
}

// ---- any drive ----------------------------------------------------------------------------------

ReducedDrive random_drive(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, share(random));
  };
  ReducedDrive drive = servo_drive(between(0.05, 0.5), between(0.1, 10.0),
                                   0.05 + 0.9 * share(random), 0.7 * share(random));
  const auto one_in = [&](int n) { return share(random) * n < 1.0; };
  if (one_in(2)) {
    drive.contact = CompliantContact{between(1e2, 1e3), between(1.0, 10.0),
                                     one_in(2) ? ContactDamping::limited : ContactDamping::full};
  }
  for (ShaftFriction* friction : {&drive.motor.friction, &drive.load.friction}) {
    if (!one_in(3)) continue;
    friction->coulomb = between(1e-3, 0.05);
    friction->breakaway = friction->coulomb * (1.0 + share(random));
  }
  if (one_in(3)) {
    drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                   .proportional = 1.0,
                                   .integral = between(0.01, 0.1),
                                   .derivative = between(0.1, 1.0),
                                   .filter = 0.05});
  }
  if (one_in(3)) drive.torque_limit = between(0.05, 1.0);
  if (one_in(4)) drive.sensing.load_share_of_position = share(random);
  if (one_in(5)) drive.load_torque = 0.02 * share(random);
  if (one_in(5)) drive.reference = Sine{0.0, between(0.1, 1.0), between(0.1, 1.0), 0.0};
  return drive;
}

/// What a period's motion does to a mismatch is bounded by the multiplier, about; an unstable cycle
/// cannot be followed better.
TEST(PropertyAttractors, EveryCycleClosesAndRepeats) {
  constexpr unsigned seed = 2026;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::size_t cycles = 0;
  for (int i = 0; i < 16; ++i) {
    SCOPED_TRACE(i);
    const ReducedDrive drive = random_drive(random);
    const AttractorSearch found = find_attractors(
        drive, {.starts = {{0.15, 0.0, 0.01, 0.0}, {0.45, 0.0, 0.3, 0.0}, {3.0, 0.0, 3.0, 0.0}},
                .swing_times = 60.0,
                .most_events = 5'000,
                .most_edges = 1});
    std::size_t led = found.rest ? found.rest->starts : 0;
    for (const FoundCycle& cycle : found.cycles) {
      ++cycles;
      led += cycle.starts;
      EXPECT_LT(cycle.orbit.residual, 1e-9);
      EXPECT_LT(misfit_after_a_period(found.system, cycle.orbit), 1e-10 * (1.0 + cycle.multiplier));
      EXPECT_GT(cycle.amplitude, 0.0);
      EXPECT_TRUE(cycle.starts == 0 || cycle.stability != Stability::unstable);
    }
    for (const IrregularFound& motion : found.irregular) led += motion.starts;
    EXPECT_EQ(led + found.count(MotionEnd::diverges) + found.count(MotionEnd::undecided),
              found.outcomes.size());
  }
  EXPECT_GE(cycles, 8U);
}

/// A stiff mesh at its critical damping has nearly parallel eigenvectors, and multiplies whatever
/// is off its rest by 1e5. The value is that of steps that leave no decay out.
TEST(Attractors, OfAStiffMeshAreKnownToRounding) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.contact = CompliantContact{1e5, 2.0 * std::sqrt(1e5 * 2.0 / 9.0), ContactDamping::full};
  const AttractorSearch found =
      find_attractors(drive, {.starts = {{.motor_position = 0.45, .load_position = 0.3}}});
  ASSERT_EQ(found.cycles.size(), 1U);
  EXPECT_NEAR(found.cycles[0].amplitude, 0.24126970446464, 5e-12);
}

/// A robot's joint with a gear that twists. Steps that are too small for its friction move nothing.
ReducedDrive twisting_joint(double proportional, bool derivative_of_speed) {
  ReducedDrive drive;
  drive.motor = {1.213, {.viscous = 3.0, .coulomb = 4.0, .breakaway = 4.0}};
  drive.load = {1.0, {.viscous = 1.0}};
  drive.contact = CompliantContact{31e3, 5.0};
  drive.sensing.load_share_of_speed = 1.0;
  drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                 .proportional = proportional,
                                 .derivative = 150.0,
                                 .filter = 1e-3,
                                 .derivative_of_speed = derivative_of_speed});
  drive.torque_limit = 140.0;
  return drive;
}

void expect_same_cycles(const AttractorSearch& one, const AttractorSearch& other) {
  ASSERT_EQ(one.cycles.size(), other.cycles.size());
  for (std::size_t i = 0; i < one.cycles.size(); ++i) {
    EXPECT_EQ(one.cycles[i].is_symmetric, other.cycles[i].is_symmetric) << i;
    EXPECT_NEAR(one.cycles[i].amplitude / other.cycles[i].amplitude, 1.0, 1e-9) << i;
    EXPECT_NEAR(one.cycles[i].period() / other.cycles[i].period(), 1.0, 1e-9) << i;
    EXPECT_NEAR(one.cycles[i].multiplier, other.cycles[i].multiplier, 1e-7) << i;
  }
}

/// Where the reference stands, s/(T s + 1) of the error and 1/(T s + 1) of −v are one controller.
TEST(OracleAttractors, AFilteredSpeedIsTheFilteredDerivativeOfThePosition) {
  const AttractorSearch of_position = find_attractors(twisting_joint(5e3, false));
  ASSERT_EQ(of_position.cycles.size(), 2U);
  EXPECT_TRUE(of_position.cycles[0].is_symmetric);
  expect_same_cycles(find_attractors(twisting_joint(5e3, true)), of_position);
}

// ---- the mesh torque ----------------------------------------------------------------------------

/// The largest torque of a cycle by a rule for it, at 20,000 places of a period and where it is
/// defined.
template <class Torque>
double sampled_torque(const AttractorSearch& found, const FoundCycle& cycle, const Torque& torque) {
  constexpr int places = 20000;
  const double from = cycle.orbit.start_time;
  const double step = cycle.period() / places;
  const auto motion =
      simulate(found.system, cycle.orbit.start, {.from = from, .until = from + cycle.period()});
  double largest = 0.0;
  for (int i = 1; i < places; ++i) {
    largest = std::max(largest, std::abs(torque(motion, from + step * i, 0.5 * step)));
  }
  return largest;
}

TEST(MeshTorque, OfATwistingMeshIsThatOfItsSpringAndDamping) {
  const AttractorSearch found = find_attractors(twisting_joint(5e3, false));
  ASSERT_EQ(found.cycles.size(), 2U);
  for (const FoundCycle& cycle : found.cycles) {
    const double sampled =
        sampled_torque(found, cycle, [](const auto& motion, double time, double) {
          const ShaftStates at = shafts_of(motion.at(time));
          return 31e3 * (at.motor_position - at.load_position) +
                 5.0 * (at.motor_speed - at.load_speed);
        });
    EXPECT_NEAR(cycle.mesh_torque, sampled, 1e-6 * sampled);
    EXPECT_GE(cycle.mesh_torque, sampled * (1.0 - 1e-12));
  }
}

/// Rigid faces, dry friction, a load torque and a reference beside 0: what accelerates the load.
TEST(MeshTorque, OfRigidFacesIsWhatTheLoadNeeds) {
  ReducedDrive drive = servo_drive(0.1, 2.0, 0.3);
  drive.load.friction.coulomb = drive.load.friction.breakaway = 0.003;
  drive.load_torque = 0.01;
  drive.reference = 0.2;
  const DriveSystem built = drive_system(drive);
  const AttractorSearch found = find_attractors(drive);
  ASSERT_FALSE(found.cycles.empty());
  for (const FoundCycle& cycle : found.cycles) {
    const double sampled =
        sampled_torque(found, cycle, [&](const auto& motion, double time, double step) {
          const auto state = motion.at(time);
          const auto is_together = [&](double there) {
            const auto at = motion.at(there);
            return at.mode == state.mode &&
                   built.modes.mode(at.mode).contact != ContactState::apart;
          };
          if (!is_together(time - step) || !is_together(time + step)) return 0.0;
          const double before = shafts_of(motion.at(time - step)).load_speed;
          const double after = shafts_of(motion.at(time + step)).load_speed;
          const double speed = shafts_of(state).load_speed;
          if (speed == 0.0) return 0.0;
          return drive.load.inertia * (after - before) / (2.0 * step) +
                 drive.load.friction.viscous * speed + std::copysign(0.003, speed) - 0.01;
        });
    EXPECT_NEAR(cycle.mesh_torque, sampled, 1e-3 * sampled);
    EXPECT_GE(cycle.mesh_torque, sampled * (1.0 - 1e-7));
  }
}

// ---- from one drive to its neighbour ------------------------------------------------------------

TEST(FollowAttractors, FindsWhatASearchFinds) {
  const AttractorSearch known = find_attractors(servo_drive(0.19, 2.0, 0.1));
  const ReducedDrive near = servo_drive(0.191, 2.0, 0.1);
  const auto followed = follow_attractors(near, known);
  ASSERT_TRUE(followed);
  const AttractorSearch searched = find_attractors(near);
  ASSERT_EQ(followed->cycles.size(), 1U);
  EXPECT_NEAR(followed->cycles[0].amplitude, searched.cycles[0].amplitude, 1e-11);
  EXPECT_NEAR(followed->cycles[0].period(), searched.cycles[0].period(), 1e-10);
  EXPECT_NE(followed->cycles[0].amplitude, known.cycles[0].amplitude);
  EXPECT_LT(followed->outcomes.size(), searched.outcomes.size());
}

TEST(FollowAttractors, GivesUpWhereTheDriveEndsInSomethingElse) {
  const AttractorSearch hunting = find_attractors(servo_drive(0.19, 2.0, 0.1));
  EXPECT_FALSE(follow_attractors(servo_drive(0.9, 2.0, 0.1), hunting));
  const AttractorSearch resting = find_attractors(servo_drive(0.9, 2.0, 0.1));
  EXPECT_FALSE(follow_attractors(servo_drive(0.19, 2.0, 0.1), resting));
  EXPECT_TRUE(follow_attractors(servo_drive(0.91, 2.0, 0.1), resting));
  ReducedDrive unstable = servo_drive(0.9, 2.0, 0.1);
  unstable.controller = at_load(PID{.terms = PIDTerms::PID, .proportional = 1.0, .integral = 10.0});
  const AttractorSearch running_away = find_attractors(unstable);
  EXPECT_EQ(running_away.count(MotionEnd::diverges), running_away.outcomes.size());
  EXPECT_FALSE(follow_attractors(servo_drive(0.9, 2.0, 0.1), running_away));
}

/// A PD with friction, which hunts if disturbed: the cycle between rest and hunting multiplies a
/// disturbance by 24.
ReducedDrive pd_drive(double gain, double filter = 1e-3) {
  ReducedDrive drive;
  drive.motor = {8e-3, {.viscous = 4e-3, .coulomb = 2e-2, .breakaway = 2e-2}};
  drive.load = {5e-3, {.viscous = 1e-3, .coulomb = 5e-3, .breakaway = 5e-3}};
  drive.backlash = 2e-3;
  drive.contact = RigidContact{};
  drive.controller = at_load(PID{
      .terms = PIDTerms::PID, .proportional = 20.0 * gain, .derivative = 0.4, .filter = filter});
  return drive;
}

TEST(FollowAttractors, FollowsUnstableCyclesToo) {
  const AttractorSearch known = find_attractors(pd_drive(4.0));
  ASSERT_EQ(known.cycles.size(), 2U);
  ASSERT_EQ(known.cycles[1].stability, Stability::unstable);
  EXPECT_GT(known.cycles[1].multiplier, 20.0);
  const ReducedDrive near = pd_drive(4.07);
  const auto followed = follow_attractors(near, known);
  ASSERT_TRUE(followed);
  const AttractorSearch searched = find_attractors(near);
  ASSERT_EQ(searched.cycles.size(), 2U);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_NEAR(followed->cycles[i].amplitude, searched.cycles[i].amplitude, 1e-11);
  }
}

/// Though from most starts nothing moves.
TEST(FollowCycles, FindsWhatASearchFinds) {
  const AttractorSearch known = find_attractors(twisting_joint(5e3, true));
  const ReducedDrive near = twisting_joint(5.1e3, true);
  expect_same_cycles(follow_cycles(near, known), find_attractors(near));
}

TEST(FollowAttractors, GivesUpWhereTheStateHasOtherNumbers) {
  EXPECT_FALSE(follow_attractors(pd_drive(4.0, 0.0), find_attractors(pd_drive(4.0))));
}

/// Starts in the gap are then moved to its faces.
TEST(FollowAttractors, StartsInANarrowerGapToo) {
  const AttractorSearch known = find_attractors(servo_drive(0.19, 2.0, 0.1));
  ReducedDrive narrower = servo_drive(0.19, 2.0, 0.1);
  narrower.backlash = 0.2;
  const auto followed = follow_attractors(narrower, known);
  ASSERT_TRUE(followed);
  EXPECT_NEAR(followed->cycles[0].amplitude, known.cycles[0].amplitude / 1.5, 1e-9);
}

TEST(FollowAttractors, GivesUpWhereASearchWasStopped) {
  test::Stopping stop;
  const ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  EXPECT_FALSE(follow_attractors(drive, find_attractors(drive, {}, stop)));
}

}  // namespace
}  // namespace gearlash::drive::attractors_test
