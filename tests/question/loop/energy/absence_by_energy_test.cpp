// Proofs that a drive cannot hunt, and where it then rests, beside the closed form and motion.
#include "question/loop/energy/absence_by_energy.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "base/drive_count.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/energy_balance.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/motion.hpp"
#include "model/reduced_drive.hpp"
#include "numeric/positive_polynomial.hpp"
#include "question/loop/energy/computed_rest.hpp"

namespace gearlash::absence_by_energy_test {
namespace {

TEST(OraclePositivePolynomial, IsDecidedByItsRoots) {
  const auto quadratic = [](double constant, double linear, double square) {
    return is_positive({constant, linear, square});
  };
  EXPECT_TRUE(quadratic(1.0, -1.999, 1.0));
  EXPECT_FALSE(quadratic(1.0, -2.0, 1.0));  // touches 0 at 1
  EXPECT_FALSE(quadratic(1.0, -2.001, 1.0));
  EXPECT_FALSE(quadratic(-1.0, 5.0, 1.0));
  EXPECT_TRUE(quadratic(1e12, -1.9e6, 1.0));
  EXPECT_TRUE(is_positive({0.0, 0.0, 2.0}));  // x²
  EXPECT_FALSE(is_positive({}));
  EXPECT_FALSE(is_positive({Interval(-1e-9, 1.0), 1.0}));
}

/// B ≥ 0 of docs/explanation/absence-by-energy.md, which is_dissipative() decides in rational
/// numbers.
TEST(OracleAbsenceByEnergy, OfTheServoIsItsOwnTheorem) {
  SeededDraws draws(20261123);
  int proved = 0;
  for (int i = 0; i < 3000; ++i) {
    const NormalizedServo servo{.damping = draws.log_uniform(0.1, 20.0),
                                .inertia_ratio = draws.log_uniform(0.02, 50.0),
                                .friction_ratio = draws.uniform(0.01, 0.99),
                                .backlash = 1.0};
    const double f = servo.friction_ratio;
    const double r = servo.inertia_ratio;
    const double margin =
        4.0 * servo.damping * servo.damping * f * (1.0 - f) * (1.0 + r) - f - (1.0 - f) * r;
    if (std::abs(margin) < 1e-9 * (f + r)) continue;  // rounding of the referred numbers decides
    const bool found = is_absent_by_energy(
        reduce(normal_form(servo.damping, servo.inertia_ratio, servo.friction_ratio)));
    EXPECT_EQ(found, is_dissipative(servo)) << "case " << i;
    proved += found ? 1 : 0;
  }
  EXPECT_GT(proved, 500);
}

Drive motor_drive(const PID& pid) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = 0.4,
                 .friction = {.viscous = 0.2, .coulomb = 0.03, .breakaway = 0.05}};
  drive.load = {.inertia = 0.6, .friction = {.viscous = 0.3, .coulomb = 0.01}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.sensor.position = SensorPlace::motor;
  drive.controller.law = pid;
  return drive;
}

TEST(AbsenceByEnergy, IsProvedForAMotorThatHoldsItselfWithAnyFriction) {
  Drive drive = motor_drive({.terms = PIDTerms::PD, .proportional = 1.0, .derivative = 0.3});
  EXPECT_TRUE(is_absent_by_energy(reduce(drive)));
  drive.contact = RigidContact{0.9};
  EXPECT_TRUE(is_absent_by_energy(reduce(drive)));
  drive.contact = CompliantContact{.stiffness = 50.0, .damping = 2.0};
  EXPECT_TRUE(is_absent_by_energy(reduce(drive)));
}

TEST(AbsenceByEnergy, IsNotProvedWhereTheTheoremSaysNothing) {
  const PID proportional{.terms = PIDTerms::PD, .proportional = 1.0, .derivative = 0.3};
  Drive on_load = motor_drive(proportional);
  on_load.sensor.position = SensorPlace::load;
  EXPECT_FALSE(is_absent_by_energy(reduce(on_load)));
  EXPECT_FALSE(is_absent_by_energy(reduce(motor_drive(
      {.terms = PIDTerms::PID, .proportional = 1.0, .integral = 0.1, .derivative = 0.3}))));
  EXPECT_FALSE(is_absent_by_energy(reduce(motor_drive({.proportional = -1.0}))));
  Drive sampled = motor_drive(proportional);
  sampled.sampling = Sampling{.period = 1e-3};
  EXPECT_FALSE(is_absent_by_energy(reduce(sampled)));
  Drive limited = motor_drive(proportional);
  limited.motor.limit = 1.0;
  EXPECT_FALSE(is_absent_by_energy(reduce(limited)));
  Drive coarse = motor_drive(proportional);
  coarse.sensor.encoder.resolution = 0.01;
  EXPECT_FALSE(is_absent_by_energy(reduce(coarse)));
}

/// With D fed back from the motor, the winding's lag T leaves friction wherever
/// F_M + (E + D − K T)/(1 + ω²T²) > 0.
TEST(OracleAbsenceByEnergy, OfALaggingWindingEndsWhereItsFrictionDoes) {
  drive::ReducedDrive reduced =
      reduce(motor_drive({.terms = PIDTerms::PD, .proportional = 1.0, .derivative = 0.3}));
  reduced.motor.friction.viscous = 0.1;
  reduced.winding.back_emf = 0.1;
  const auto is_proved_with = [&](double time_constant) {
    reduced.winding.time_constant = time_constant;
    return is_absent_by_energy(reduced);
  };
  EXPECT_TRUE(is_proved_with(1e-6));
  EXPECT_TRUE(is_proved_with(0.499));
  EXPECT_FALSE(is_proved_with(0.501));
}

/// PD and lead-lag controllers, every sensor, every contact, with dry friction or without.
Drive random_drive(SeededDraws& draws) {
  const double inertia_ratio = draws.log_uniform(0.2, 5.0);
  const double motor_inertia = 1.0 / (1.0 + inertia_ratio);
  const bool is_dry = draws.happens(0.3);
  const auto friction = [&] {
    const double coulomb = is_dry ? draws.log_uniform(1e-3, 3e-2) : 0.0;
    return Friction{.viscous = draws.log_uniform(0.1, 2.0),
                    .coulomb = coulomb,
                    .breakaway = coulomb * draws.one_of({1.0, 1.5})};
  };
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = motor_inertia, .friction = friction()};
  drive.load = {.inertia = 1.0 - motor_inertia, .friction = friction()};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  if (draws.happens(0.4)) {
    drive.contact = CompliantContact{.stiffness = draws.log_uniform(5.0, 100.0),
                                     .damping = draws.log_uniform(0.1, 5.0)};
  } else {
    drive.contact = RigidContact{draws.one_of({0.0, 0.5, 0.9})};
  }
  drive.sensor.position = draws.happens(0.5) ? SensorPlace::load : SensorPlace::motor;
  if (draws.happens(0.5)) {
    drive.controller.law =
        PID{.terms = PIDTerms::PD, .proportional = 1.0, .derivative = draws.log_uniform(0.05, 1.0)};
  } else {
    const double zero = draws.log_uniform(0.3, 3.0);
    drive.controller.law =
        LeadLagController{.gain = 1.0, .zero = zero, .pole = zero * draws.log_uniform(1.0, 30.0)};
  }
  drive.load_torque = draws.happens(0.3) ? draws.uniform(-0.05, 0.05) : 0.0;
  return drive;
}

std::string kind_of(const Drive& drive) {
  const bool is_rigid = std::holds_alternative<RigidContact>(drive.contact);
  const bool is_lead_lag = std::holds_alternative<LeadLagController>(drive.controller.law);
  return std::string(is_rigid ? "rigid" : "compliant") + (is_lead_lag ? ", lead-lag" : ", PD") +
         (drive.sensor.position == SensorPlace::motor ? " of the motor" : " of the load") +
         (drive.motor.friction.coulomb > 0.0 ? ", dry friction" : ", viscous friction");
}

/// The load's extremes in the last tenth of the motion; empty if it was not followed to its end.
std::optional<Bounds> extremes_of(const Drive& drive, double until) {
  const Motion motion = simulate(drive, {.until = until, .start = Start{.load_position = 0.7}});
  if (motion.stop() != MotionStop::reached_end) return std::nullopt;
  Bounds extremes{infinity, -infinity};
  for (int k = 0; k <= 400; ++k) {
    const double load = motion.at(until * (0.9 + 0.1 * k / 400.0)).shafts.load_position;
    extremes = {std::min(extremes.low, load), std::max(extremes.high, load)};
  }
  return extremes;
}

struct Count {
  int all = 0;
  int resting = 0;
  int proved = 0;
};

/// No drive of the region keeps swinging, and all end where rest is computed to be. Prints which
/// share of the drives that rest is proved.
TEST(PropertyAbsenceByEnergy, DrivesOfTheRegionComeToTheComputedRest) {
  const int wanted = test::drive_count(200);
  SeededDraws draws(1960);
  std::map<std::string, Count> counts;
  int proved = 0;
  int dry = 0;
  for (int i = 0; proved < wanted; ++i) {
    const Drive drive = random_drive(draws);
    const drive::ReducedDrive reduced = reduce(drive);
    const bool is_proved = is_absent_by_energy(reduced);
    constexpr double until = 400.0;
    std::optional<Bounds> end = extremes_of(drive, until);
    Count& count = counts[kind_of(drive)];
    ++count.all;
    if (!end) continue;
    constexpr double still = 2e-2 * 0.1;  // small against the gap, and still falling
    count.resting += end->high - end->low <= still ? 1 : 0;
    if (!is_proved) continue;
    ++proved;
    ++count.proved;
    dry += drive.motor.friction.coulomb > 0.0 ? 1 : 0;
    SCOPED_TRACE("drive " + std::to_string(i));
    const std::vector<RestPiece> rest = computed_rest(reduced);
    ASSERT_FALSE(rest.empty());
    const auto has_arrived = [&] {
      return end->high - end->low <= still && end->low >= rest.front().load.low - still &&
             end->high <= rest.front().load.high + still;
    };
    // A load that hardly overcomes its friction creeps through the gap for long.
    for (double longer = 4.0 * until; !has_arrived() && longer <= 64.0 * until; longer *= 4.0) {
      end = extremes_of(drive, longer);
      ASSERT_TRUE(end);
    }
    EXPECT_TRUE(has_arrived()) << end->low << " … " << end->high;
  }
  for (const auto& [kind, count] : counts) {
    std::printf("%-46s %4d drives, %4d rest, %4d proved\n", kind.c_str(), count.all, count.resting,
                count.proved);
  }
  EXPECT_GT(dry, wanted / 20);
}

TEST(AbsenceByEnergy, IsTheVerdictWithoutASearch) {
  const Answer answer =
      analyse(motor_drive({.terms = PIDTerms::PD, .proportional = 1.0, .derivative = 0.3}));
  EXPECT_EQ(answer.verdict, Verdict::cannot_hunt);
  EXPECT_EQ(answer.certainty, Certainty::enclosed);
  EXPECT_TRUE(answer.is_dissipative);
  EXPECT_FALSE(answer.search);
  ASSERT_TRUE(answer.rest);
  // The motor rests within 0.05 + 0.01 N m over 1 N m/rad, the load within half the gap of it.
  EXPECT_NEAR(answer.rest->motor.high, 0.06, 1e-12);
  EXPECT_NEAR(answer.rest->load.high, 0.06 + 0.05, 1e-12);
  EXPECT_EQ(answer.value(Quantity::amplitude), 0.0);
}

}  // namespace
}  // namespace gearlash::absence_by_energy_test
