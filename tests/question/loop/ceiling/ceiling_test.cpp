// The ceiling, beside known values, independent sums of the loop's answers, and motion.
#include "question/loop/ceiling/ceiling.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/drive_count.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/limit_cycle.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/motion.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::ceiling_test {
namespace {

using drive::ReducedDrive;
using testing::HasSubstr;

/// G + J_M/J = (c s − J_M/J)… of the servo: |G(∞)| and the norm of a second order in closed form.
TEST(OracleCeiling, OfALoadThatIsAllTheInertia) {
  // J_M = 0, F_M = F: G = −(F s)/(s² + F s + 1), whose response e^{−ζt}(cos − …) changes its sign.
  const double damping = 0.3;
  const double root = std::sqrt(1.0 - damping * damping);
  const double decay = std::exp(-damping / root * std::acos(damping));
  const double half_swing = std::exp(-damping / root * M_PI);
  // ∫|h′| of h = e^{−ζt} sin(ωt)/ω: twice the sum of its extremes.
  const double norm = 2.0 * damping * 2.0 * decay / (1.0 - half_swing);
  const Ceiling ceiling = ceiling_of(reduce(normal_form(damping, infinity, 0.0)));
  EXPECT_NEAR(*ceiling.load, 0.5 * norm, 1e-4 * norm);
  EXPECT_NEAR(*ceiling.motor, 0.5 * (norm + 1.0), 1e-4 * norm);
}

/// A fast computer does what a continuous controller does.
TEST(OracleCeiling, OfAFastComputerIsThatOfAContinuousController) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = 0.4,
                 .friction = {.viscous = 0.2, .coulomb = 0.03, .breakaway = 0.05}};
  drive.load = {.inertia = 0.6, .friction = {.viscous = 0.3, .coulomb = 0.01}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.sensor.encoder.resolution = 0.001;
  drive.controller.law = PID{.terms = PIDTerms::PID,
                             .proportional = 1.0,
                             .integral = 0.1,
                             .derivative = 0.5,
                             .filter = 0.05};
  const Ceiling continuous = ceiling_of(reduce(drive));
  drive.sampling = Sampling{.period = 1e-4};
  const Ceiling sampled = ceiling_of(reduce(drive));
  ASSERT_EQ(continuous.terms.size(), 4U);
  ASSERT_EQ(sampled.terms.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(sampled.terms[i].source, continuous.terms[i].source);
    EXPECT_NEAR(sampled.terms[i].load, continuous.terms[i].load, 1e-2 * continuous.terms[i].load);
    EXPECT_NEAR(sampled.terms[i].motor, continuous.terms[i].motor,
                1e-2 * continuous.terms[i].motor);
    EXPECT_NEAR(*sampled.terms[i].effort, *continuous.terms[i].effort,
                1e-2 * *continuous.terms[i].effort);
  }
}

// ---- motion -------------------------------------------------------------------------------------

TEST(PropertyCeiling, IsAboveEveryCycleOfTheServo) {
  SeededDraws draws(20261123);
  int hunting = 0;
  for (int i = 0; i < test::drive_count(600); ++i) {
    const NormalizedServo servo{.damping = draws.log_uniform(0.05, 2.0),
                                .inertia_ratio = draws.log_uniform(0.01, 100.0),
                                .friction_ratio = draws.uniform(0.0, 1.0),
                                .backlash = 1.0};
    const Ceiling ceiling =
        ceiling_of(reduce(normal_form(servo.damping, servo.inertia_ratio, servo.friction_ratio)));
    ASSERT_TRUE(ceiling.load);
    for (const LimitCycle& cycle : analyse_limit_cycles(servo).cycles) {
      ++hunting;
      EXPECT_LE(cycle.amplitude, *ceiling.load);
      EXPECT_LE(cycle.motor_amplitude, *ceiling.motor);
    }
  }
  EXPECT_GT(hunting, 200);
}

struct RandomDrive {
  Drive drive;
  double swing = 0.0;  ///< s, a period of the loop, about
};

/// An armature with inductance, undamped springs, a hanging load, a tachometer, PD control without
/// a filter.
void add_rarer_parts(SeededDraws& draws, Drive& drive) {
  const double time_constant = draws.log_uniform(0.01, 0.3);
  if (draws.happens(0.25)) {
    drive.motor.kind = ArmatureControl{.torque_constant = 1.0,
                                       .back_emf_constant = draws.uniform(0.0, 0.2),
                                       .resistance = 1.0,
                                       .inductance = time_constant};
  }
  if (draws.happens(0.2)) drive.contact = CompliantContact{draws.log_uniform(5.0, 100.0), 0.0};
  if (draws.happens(0.15)) {
    drive.reference = 0.0;
    drive.load.gravity = draws.uniform(0.0, 0.3);
    drive.load.gravity_angle = -0.5 * M_PI;  // it hangs: a spring, no torque at rest
  }
  const bool differentiates = draws.happens(0.3);
  if (differentiates) std::get<PID>(drive.controller.law).filter = 0.0;
  if (drive.sampling && draws.happens(0.25)) drive.sampling->speed_by_differences = false;
}

/// PD and PID, continuous or sampled, with dry friction, encoders and restitution.
RandomDrive random_drive(SeededDraws& draws) {
  Drive drive;
  const double inertia_ratio = draws.log_uniform(0.2, 5.0);
  const double motor_inertia = 1.0 / (1.0 + inertia_ratio);
  const auto friction = [&] {
    const double coulomb = draws.happens(0.5) ? draws.log_uniform(1e-4, 3e-2) : 0.0;
    return Friction{.viscous = draws.log_uniform(0.01, 0.5),
                    .coulomb = coulomb,
                    .breakaway = coulomb * draws.one_of({1.0, 1.5})};
  };
  drive.motor = {.kind = TorqueControl{}, .inertia = motor_inertia, .friction = friction()};
  drive.load = {.inertia = 1.0 - motor_inertia, .friction = friction()};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.contact = RigidContact{draws.one_of({0.0, 0.0, 0.4, 0.8})};
  drive.sensor.position = draws.happens(0.5) ? SensorPlace::load : SensorPlace::motor;
  const bool is_sampled = draws.happens(0.5);
  if (draws.happens(0.3)) drive.sensor.encoder.resolution = 0.1 / draws.log_uniform(2.0, 50.0);
  PID pid{.terms = PIDTerms::PD,
          .proportional = 1.0,
          .derivative = draws.log_uniform(0.05, 1.0),
          .filter = draws.log_uniform(0.02, 0.3)};
  if (draws.happens(0.4)) {
    pid.terms = PIDTerms::PID;
    pid.integral = draws.log_uniform(0.01, 0.15);
  }
  drive.controller.law = pid;
  if (is_sampled) {
    drive.sampling = Sampling{.period = draws.log_uniform(0.02, 0.2)};
    drive.sampling->delay = drive.sampling->period * draws.one_of({0.0, 0.5, 1.0});
  } else {
    drive.sensor.encoder.resolution.reset();  // may slide along an edge
  }
  drive.reference = draws.uniform(-0.3, 0.3);
  add_rarer_parts(draws, drive);
  return {drive, 2.0 * M_PI};
}

TEST(PropertyCeiling, IsNotExceededByMotionThatIsFollowedForLong) {
  SeededDraws draws(7);
  int bounded = 0;
  double largest_share = 0.0;
  for (int i = 0; i < test::drive_count(120); ++i) {
    const RandomDrive random = random_drive(draws);
    const Ceiling ceiling = ceiling_of(reduce(random.drive));
    if (!ceiling.load) continue;
    ++bounded;
    const double until = 60.0 * random.swing;
    const Motion motion =
        simulate(random.drive, {.until = until, .start = Start{.load_position = 1.0}});
    if (motion.stop() != MotionStop::reached_end) continue;
    const double reference = std::get<double>(*random.drive.reference);
    const double load = *ceiling.load;
    // What is left of the start dies out at the slowest rate of the loop: the last fifth of it.
    double least = infinity;
    double most = -infinity;
    for (int k = 0; k <= 2000; ++k) {
      const MotionSample sample = motion.at(until * (0.8 + 1e-4 * k));
      least = std::min(least, sample.shafts.load_position);
      most = std::max(most, sample.shafts.load_position);
    }
    SCOPED_TRACE("drive " + std::to_string(i));
    EXPECT_LE(0.5 * (most - least), load * (1.0 + 1e-6));
    EXPECT_LE(std::max(most - reference, reference - least), load * 1.05 + 1e-3);
    largest_share = std::max(largest_share, 0.5 * (most - least) / load);
  }
  std::printf("%d drives with a ceiling; the nearest came to %.3f of it\n", bounded, largest_share);
  EXPECT_GT(bounded, 80);
  EXPECT_GT(largest_share, 0.5);  // some come near it
}

// ---- where there is none ------------------------------------------------------------------------

TEST(EdgeCeiling, HasAReasonWhereThereIsNone) {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3);
  drive.contact = CompliantContact{.stiffness = 100.0, .damping = 1.0};
  EXPECT_THAT(ceiling_of(reduce(drive)).reason, HasSubstr("damping"));
  EXPECT_FALSE(ceiling_of(reduce(drive)).load);
  drive.contact = CompliantContact{.stiffness = 100.0};
  EXPECT_TRUE(ceiling_of(reduce(drive)).load);

  Drive unstable = drive;
  unstable.contact = RigidContact{};
  unstable.servo->damping = 0.0;
  EXPECT_THAT(ceiling_of(reduce(unstable)).reason, HasSubstr("stable"));
}

TEST(Ceiling, IsPartOfTheAnswerOnRequest) {
  const Drive drive = normal_form(0.19, 2.0, 0.1);
  EXPECT_FALSE(analyse(drive).ceiling);
  const Answer answer = analyse(drive, {.ceiling = true});
  ASSERT_TRUE(answer.ceiling);
  EXPECT_EQ(answer.value(Quantity::ceiling), answer.ceiling->load);
  EXPECT_EQ(answer.value(Quantity::motor_ceiling), answer.ceiling->motor);
  EXPECT_EQ(answer.value(Quantity::effort_ceiling), answer.ceiling->effort);
  EXPECT_GT(*answer.ceiling->load, answer.cycles.front().amplitude);
}

TEST(Ceiling, IsProportionalToTheBacklashWhereNothingElseDisturbs) {
  const double one = *ceiling_of(reduce(normal_form(0.19, 2.0, 0.1, 1.0))).load;
  EXPECT_NEAR(*ceiling_of(reduce(normal_form(0.19, 2.0, 0.1, 0.25))).load, 0.25 * one, 1e-12);
}

TEST(Ceiling, GivesTheWidestBacklashThatMeetsAnAmplitude) {
  Drive drive;
  drive.motor = {
      .kind = TorqueControl{}, .inertia = 1.0, .friction = {.viscous = 0.9, .coulomb = 0.01}};
  drive.load = {.inertia = 2.0, .friction = {.viscous = 0.1}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.3};
  drive.controller.law = PID{.proportional = 3.0};
  const Ceiling ceiling = ceiling_of(reduce(drive));
  const auto widest = ceiling.widest_backlash(0.1, 0.3);
  ASSERT_TRUE(widest);
  drive.gearbox.backlash = *widest;
  EXPECT_NEAR(*ceiling_of(reduce(drive)).load, 0.1, 1e-9);
  EXPECT_FALSE(ceiling.widest_backlash(1e-4, 0.3));  // friction alone causes more
}

}  // namespace
}  // namespace gearlash::ceiling_test
