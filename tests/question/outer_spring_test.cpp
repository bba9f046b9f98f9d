// Gravity and joined shafts in ceilings, proofs by energy and answers.
#include <gmock/gmock.h>

#include <cmath>
#include <complex>

#include "base/seeded_draws.hpp"
#include "controllers.hpp"
#include "gearlash/analyse.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "numeric/linear_algebra.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "question/loop/energy/absence_by_energy.hpp"

namespace gearlash::outer_spring_test {
namespace {

using drive::ReducedDrive;

ReducedDrive weighed_servo(double friction, double weight) {
  ReducedDrive drive;
  drive.motor = {0.3, {.viscous = 0.4 * friction}};
  drive.load = {0.7, {.viscous = 0.6 * friction, .coulomb = 0.2, .breakaway = 0.2}};
  drive.backlash = 0.01;
  drive.controller = at_load(PID{.proportional = 9.0});
  drive.gravity = {.stiffness = weight};
  return drive;
}

double term(const Ceiling& ceiling, const std::string& source) {
  for (const CeilingTerm& one : ceiling.terms) {
    if (one.source == source) return one.load;
  }
  return 0.0;
}

TEST(OracleCeilingWithGravity, HasTheStiffnessesOfLoopAndGravity) {
  for (const double weight : {5.0, -5.0}) {
    const Ceiling ceiling = ceiling_of(weighed_servo(10.0, weight));
    ASSERT_TRUE(ceiling.load) << ceiling.reason;
    // Overdamped: the response to a torque is of one sign, and its integral is the static one.
    // Proved bounds exceed it a little.
    EXPECT_GE(term(ceiling, "load friction"), 0.2 / (9.0 + weight));
    EXPECT_LE(term(ceiling, "load friction"), 0.2 / (9.0 + weight) * (1.0 + 1e-5));
  }
  EXPECT_FALSE(ceiling_of(weighed_servo(1.0, -9.5)).load);  // it tips over
}

TEST(CeilingWithGravity, CountsTheWeightAgainstTheTorqueLimit) {
  ReducedDrive limited = weighed_servo(10.0, 5.0);
  limited.load_torque = -3.0;
  limited.torque_limit = 1e6;
  EXPECT_TRUE(ceiling_of(limited).meets_limit.value());
  // At rest the motor carries 9/14 of the torque: the rest is the spring of gravity.
  const double effort = *ceiling_of(limited).effort;
  limited.torque_limit = (effort + 3.0 * 9.0 / 14.0) * (1.0 + 1e-5);
  EXPECT_TRUE(ceiling_of(limited).meets_limit.value());
  limited.torque_limit = (effort + 3.0 * 9.0 / 14.0) * (1.0 - 1e-5);
  EXPECT_FALSE(ceiling_of(limited).meets_limit.value());
}

/// Shafts joined by a spring and a damper: a linear loop, whose static response bounds from below.
TEST(OracleCeilingOfJoinedShafts, DampedSpringsHaveOne) {
  ReducedDrive drive = weighed_servo(10.0, 5.0);
  drive.contact = drive::CompliantContact{.stiffness = 3e3, .damping = 40.0};
  EXPECT_FALSE(ceiling_of(drive).load);
  drive.backlash = 0.0;
  const Ceiling ceiling = ceiling_of(drive);
  ASSERT_TRUE(ceiling.load) << ceiling.reason;
  EXPECT_EQ(term(ceiling, "gap"), 0.0);
  EXPECT_GE(term(ceiling, "load friction"), 0.2 / 14.0 * (1.0 - 1e-9));
  EXPECT_LE(term(ceiling, "load friction"), 0.2 / 14.0 * 1.001);  // stiff, and overdamped
}

/// The real part of the mesh torque over the speed of the gap, at many frequencies.
TEST(OracleAbsenceByEnergyWithGravity, IsTheSignOfTheRealPart) {
  SeededDraws draws(20261124);
  int proved = 0;
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    ReducedDrive drive = weighed_servo(draws.log_uniform(0.1, 20.0), draws.uniform(-4.0, 8.0));
    drive.load.friction.coulomb = drive.load.friction.breakaway = 0.0;
    const double weight = drive.gravity.stiffness;
    double least = 1.0;
    for (double power = -4.0; power < 4.0; power += 0.002) {
      const std::complex<double> s(0.0, std::pow(10.0, power));
      const std::complex<double> motor = 0.3 * s * s + drive.motor.friction.viscous * s;
      const std::complex<double> load = 0.7 * s * s + drive.load.friction.viscous * s + weight;
      const std::complex<double> ratio = load * motor / (s * (motor + load + 9.0));
      least = std::min(least, ratio.real() / std::abs(ratio));
    }
    if (std::abs(least) < 1e-6) continue;
    EXPECT_EQ(is_absent_by_energy(drive), least > 0.0) << "case " << i;
    ++(least > 0.0 ? proved : refused);
  }
  EXPECT_GT(proved, 20);
  EXPECT_GT(refused, 20);
}

/// Between two springs of which one would tip over, the gap takes no energy at one frequency; yet
/// the rest of the drive is not passive.
TEST(AbsenceByEnergyWithGravity, IsNotProvedWhereALoadWouldTipOverAlone) {
  ReducedDrive drive = weighed_servo(10.0, 2.0);
  drive.sensing = {.load_share_of_position = 0.0};
  EXPECT_TRUE(is_absent_by_energy(drive));  // with dry friction
  drive.load.friction.coulomb = drive.load.friction.breakaway = 0.0;
  EXPECT_TRUE(is_absent_by_energy(drive));
  drive.gravity.stiffness = -2.0;
  EXPECT_FALSE(is_absent_by_energy(drive));
  drive.load.friction.coulomb = drive.load.friction.breakaway = 0.2;
  EXPECT_FALSE(is_absent_by_energy(drive));
}

Drive arm() {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 2e-4, .friction = {.viscous = 1e-3}};
  drive.gearbox = {.ratio = 50.0, .backlash = 0.0035};
  drive.load = {.inertia = 0.2, .friction = {.viscous = 0.5}};
  drive.controller = {.law = PID{.proportional = 100.0}, .shaft = GainShaft::load};
  return drive;
}

TEST(AnswersWithGravity, AreNeverTheClosedForm) {
  EXPECT_TRUE(proportional_servo(arm()));
  for (const double angle : {0.0, 1.5707963267948966, -0.5}) {
    Drive drive = arm();
    drive.load.gravity = 3.0;
    drive.load.gravity_angle = angle;
    EXPECT_FALSE(proportional_servo(drive));
  }
  // Level where the reference is 0, and held by a constant torque there: still not the servo.
  Drive held = arm();
  held.load.gravity = 3.0;
  held.load_torque = 3.0;
  held.reference = 0.5;
  held.motor.friction.viscous = 2e-2;  // so much friction that the search is short
  held.load.friction.viscous = 50.0;
  const Answer answer = analyse(held);
  EXPECT_EQ(answer.engine, Engine::general);
  ASSERT_FALSE(answer.notes.empty());
  EXPECT_EQ(answer.notes[0].code, "gravity");
  EXPECT_THAT(answer.notes[0].text,
              ::testing::HasSubstr("28.65° above the horizontal, where the reference ends: torque "
                                   "-2.633 N m, stiffness -1.438 N m/rad"));
}

TEST(AnswersOfJoinedShafts, NeedNoBacklash) {
  Drive drive = arm();
  drive.gearbox.backlash = 0.0;
  drive.contact = CompliantContact{.stiffness = 2e4, .damping = 20.0};
  drive.motor.friction = {.viscous = 2e-2, .coulomb = 1e-3};
  const Answer answer = analyse(drive);
  EXPECT_EQ(answer.verdict, Verdict::comes_to_rest);
}

}  // namespace
}  // namespace gearlash::outer_spring_test
