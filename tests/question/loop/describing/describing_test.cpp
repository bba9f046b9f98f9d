// The classical analyses of a drive against closed forms and published numbers.
#include "question/loop/describing/describing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "closed_form/limit_cycle.hpp"
#include "controllers.hpp"
#include "question/loop/describing/servo_estimate.hpp"

namespace gearlash::drive::describing_test {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;
using testing::Contains;
using testing::Not;

/// K/(s(Ts + 1)), the inertia on both sides.
ReducedDrive type_one_servo(double gain, double time_constant) {
  ReducedDrive drive;
  drive.motor = {0.25 * time_constant, {.viscous = 0.75}};
  drive.load = {0.75 * time_constant, {.viscous = 0.25}};
  drive.backlash = 2.0;  // h = 1
  drive.controller = at_load(PID{.proportional = gain});
  return drive;
}

const DescribingAnalysis& find(const std::vector<DescribingAnalysis>& analyses,
                               DescribedPart part) {
  for (const DescribingAnalysis& analysis : analyses) {
    if (analysis.part == part) return analysis;
  }
  throw std::runtime_error("not described");
}

DescribingAnalysis described(const ReducedDrive& drive, DescribedPart part) {
  return find(describing_analyses(drive), part);
}

// ---- the gap ------------------------------------------------------------------------------------

TEST(OracleDescribing, TheServoHasItsOwnEstimate) {
  for (const double damping : {0.05, 0.1, 0.19, 0.27, 0.5}) {
    const NormalizedServo servo{damping, 2.0, 0.1, 0.3};
    ReducedDrive drive;
    drive.motor = {0.25, {.viscous = 1.75 * damping}};
    drive.load = {0.75, {.viscous = 0.25 * damping}};
    drive.backlash = 0.3;
    drive.controller = at_load(PID{.proportional = 1.0});
    const auto analyses = describing_analyses(drive);
    ASSERT_EQ(analyses.size(), 2U);
    std::vector<DescribedMotion> found = analyses[0].cycles;
    found.insert(found.end(), analyses[1].cycles.begin(), analyses[1].cycles.end());
    const auto expected = describing_function_estimate(servo);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].amplitude / expected[i].amplitude, 1.0, 1e-10);
      EXPECT_NEAR(found[i].motor_amplitude / expected[i].motor_amplitude, 1.0, 1e-12);
      EXPECT_NEAR(found[i].balance.period / expected[i].period, 1.0, 1e-12);
      EXPECT_EQ(found[i].balance.stable, expected[i].stable);
    }
  }
}

TEST(Describing, SensorsOnTheMotorLeaveOnlyTheLoadsReaction) {
  ReducedDrive drive = type_one_servo(5.0, 1.0);
  drive.sensing.load_share_of_position = 0.0;
  const auto analysis = described(drive, DescribedPart::gap_load_coasting);
  EXPECT_THAT(analysis.assumptions, Contains(Assumption::load_reacts));
  // D_L/(D_M + K), which the gap closes to the loop without gap: 1 + L = (D + K)/(D_M + K).
  const Complex s{0.0, 1.3};
  const Complex load = 0.75 * s * s + 0.25 * s;
  const Complex motor = 0.25 * s * s + 0.75 * s + 5.0;
  EXPECT_LT(std::abs(frequency_response(analysis.loop, 1.3).value - load / motor), 1e-15);
}

TEST(Describing, SensorsOnBothShaftsShareTheLoop) {
  ReducedDrive drive = type_one_servo(5.0, 1.0);
  drive.sensing.load_share_of_position = 0.25;
  drive.sensing.load_share_of_speed = 0.5;
  drive.controller = at_load(PID{.terms = PIDTerms::PD, .proportional = 8.0, .derivative = 0.2});
  const Complex s{0.0, 1.3};
  const Complex from_load = 2.0 + 0.1 * s;
  const Complex expected = from_load / (s * s + s + 6.0 + 0.1 * s);
  const auto analysis = described(drive, DescribedPart::gap_load_held);
  EXPECT_LT(std::abs(frequency_response(analysis.loop, 1.3).value - expected), 1e-15);
  EXPECT_THAT(analysis.assumptions, Contains(Assumption::motor_carries_all));
}

TEST(OracleDescribing, AnElasticGapMeetsTheEquationsOfBothShafts) {
  ReducedDrive drive = type_one_servo(40.0, 0.5);
  drive.backlash = 0.02;
  drive.contact = CompliantContact{.stiffness = 3000.0, .damping = 1.5};
  drive.sensing = {.load_share_of_position = 0.75, .load_share_of_speed = 0.0};
  drive.controller = at_load(PID{.terms = PIDTerms::PD, .proportional = 40.0, .derivative = 0.1});
  const auto analysis = described(drive, DescribedPart::elastic_gap);
  ASSERT_FALSE(analysis.cycles.empty());
  for (const DescribedMotion& cycle : analysis.cycles) {
    const double gain = cycle.balance.gain.real();
    EXPECT_GT(gain, 0.0);
    EXPECT_LT(gain, 3000.0);
    const Complex s{0.0, cycle.balance.frequency};
    const Complex mesh = gain * (1.0 + 1.5 / 3000.0 * s);
    // (D_M + c + m) θ_M + (a − m) θ_L = 0,  −m θ_M + (D_L + m) θ_L = 0.
    const Complex motor = 0.125 * s * s + 0.75 * s + 10.0 + 0.1 * s;
    const Complex load = 0.375 * s * s + 0.25 * s;
    const Complex determinant = (motor + mesh) * (load + mesh) + mesh * (30.0 - mesh);
    EXPECT_LT(std::abs(determinant), 1e-9 * std::norm(mesh + motor));
    EXPECT_NEAR(cycle.amplitude / cycle.motor_amplitude, std::abs(mesh / (load + mesh)), 1e-9);
    EXPECT_NEAR(cycle.balance.amplitude / cycle.motor_amplitude,
                std::abs(1.0 - mesh / (load + mesh)), 1e-9);
  }
}

// ---- torque limit -------------------------------------------------------------------------------

/// 9 g/(s + 9) before 1/(s² + s), the torque limited to 1.
ReducedDrive limited_drive(double gain) {
  ReducedDrive drive;
  drive.motor = {0.5, {.viscous = 0.5}};
  drive.load = {0.5, {.viscous = 0.5}};
  drive.backlash = 1e-3;
  drive.controller = at_load(TransferFunctionController{1.0, {9.0 * gain}, {1.0, 9.0}});
  drive.torque_limit = 1.0;
  return drive;
}

TEST(OracleDescribing, AHighGainWithinLimitsIsARelay) {
  constexpr double gain = 1e5;
  const auto cycles = described(limited_drive(gain), DescribedPart::torque_limit).cycles;
  ASSERT_EQ(cycles.size(), 1U);
  const PredictedCycle& balance = cycles[0].balance;
  EXPECT_NEAR(balance.frequency, 3.0, 1e-12);
  // 9/(s(s + 1)(s + 9)) with a unit relay; the saturation differs by (limit/A)² /24 or so.
  EXPECT_NEAR(balance.amplitude / gain, 2.0 / (5.0 * pi), 1e-9);
  EXPECT_TRUE(balance.stable);
  // The shafts see a torque of amplitude 4/π: |1/(s² + s)| at 3j.
  EXPECT_NEAR(cycles[0].amplitude, 4.0 / pi / std::abs(Complex{-9.0, 3.0}), 1e-9);
}

TEST(OracleDescribing, ATorqueLimitPassesTheShareThatBalances) {
  // |L(3j)| = 2, so that N = 1/2: 2ψ + sin 2ψ = π/2, sin ψ = limit/A.
  const auto cycles = described(limited_drive(20.0), DescribedPart::torque_limit).cycles;
  ASSERT_EQ(cycles.size(), 1U);
  const double angle = std::asin(1.0 / cycles[0].balance.amplitude);
  EXPECT_NEAR(2.0 * angle + std::sin(2.0 * angle), 0.5 * pi, 1e-13);
  EXPECT_TRUE(describing_analyses(limited_drive(9.99))[2].cycles.empty());  // 10 is the margin
}

TEST(OracleDescribing, AntiWindupIsWithinTheLoopOfTheTorqueLimit) {
  ReducedDrive drive = limited_drive(1.0);
  drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                 .proportional = 3.0,
                                 .integral = 4.0,
                                 .derivative = 0.5,
                                 .tracking_time = 0.25});
  const auto analysis = described(drive, DescribedPart::torque_limit);
  // z′ = 4 e + (τ − τ_asked)/T, τ_asked = z + 3 e − 0.5 v.
  const double frequency = 1.7;
  const Complex s{0.0, frequency};
  const double rate = 4.0;
  const Complex plant = s * s + s;
  const Complex asked_by_position =
      (-4.0 * 1.0 + rate * (3.0 + 0.5 * s)) / (s + rate) - 3.0 - 0.5 * s;
  const Complex expected = -asked_by_position / plant - rate / (s + rate);
  EXPECT_LT(std::abs(frequency_response(analysis.loop, frequency).value - expected), 1e-14);
}

// ---- Coulomb friction ---------------------------------------------------------------------------

ReducedDrive pid_with_friction(double integral) {
  ReducedDrive drive;
  drive.motor = {1.5, {.viscous = 0.3, .coulomb = 0.4, .breakaway = 0.6}};
  drive.load = {0.5, {.viscous = 0.2, .coulomb = 0.1, .breakaway = 0.1}};
  drive.backlash = 1e-3;
  drive.controller = at_load(
      PID{.terms = PIDTerms::PID, .proportional = 8.0, .integral = integral, .derivative = 1.5});
  return drive;
}

/// J s³ + (F + d) s² + p s + i: undamped at ω² = p/J where i = (F + d) p/J; beyond, friction holds
/// small motion, up to an unstable cycle.
TEST(OracleDescribing, CoulombFrictionHoldsAnUnstableLoopUpToACycle) {
  const auto analysis = described(pid_with_friction(12.0), DescribedPart::coulomb_friction);
  EXPECT_THAT(analysis.assumptions, Contains(Assumption::breakaway_left_out));
  ASSERT_EQ(analysis.cycles.size(), 1U);
  const DescribedMotion& cycle = analysis.cycles[0];
  EXPECT_NEAR(cycle.balance.frequency, 2.0, 1e-12);
  const double speed = 4.0 * 0.5 / pi * 4.0 / (12.0 - 2.0 * 4.0);
  EXPECT_NEAR(cycle.balance.amplitude, speed, 1e-11);
  EXPECT_NEAR(cycle.amplitude, speed / 2.0, 1e-11);
  EXPECT_FALSE(cycle.balance.stable);
}

TEST(OracleDescribing, OfStictionInAStableLoopTheMethodSaysNothing) {
  EXPECT_TRUE(described(pid_with_friction(7.9), DescribedPart::coulomb_friction).cycles.empty());
}

// ---- the error ----------------------------------------------------------------------------------

/// M/(s (J s + F)) with a relay of hysteresis h: ω J/F = tan(90° − ψ) and 4 M/(πA) = ω √(J²ω² + F²)
/// with sin ψ = h/A.
TEST(OracleDescribing, ARelayWithHysteresisSwingsWhereItsLagFits) {
  ReducedDrive drive = type_one_servo(3.0, 2.0);  // J = 2, F = 1
  drive.error_shape = {.begins = 0.1,
                       .ends = -0.1,
                       .inner_gain = 0.0,
                       .outer_gain = 0.0,
                       .offset = 1.0,
                       .jumps = true};
  const auto analyses = describing_analyses(drive);
  ASSERT_EQ(analyses.size(), 1U);
  EXPECT_EQ(analyses[0].part, DescribedPart::relay);
  ASSERT_EQ(analyses[0].cycles.size(), 1U);
  const DescribedMotion& cycle = analyses[0].cycles[0];
  const double w = cycle.balance.frequency;
  EXPECT_NEAR(std::asin(0.1 / cycle.amplitude), 0.5 * pi - std::atan(2.0 * w), 1e-9);
  EXPECT_NEAR(12.0 / (pi * cycle.amplitude), w * std::hypot(2.0 * w, 1.0), 1e-9);
  EXPECT_TRUE(cycle.balance.stable);
}

/// T J s³ + (J + T F) s² + F s + N K: undamped at ω² = F/(T J), where N K = (J + T F) ω². Larger
/// motion grows.
TEST(OracleDescribing, ADeadBandHoldsAnUnstableLoopUpToACycle) {
  ReducedDrive drive = type_one_servo(1.0, 2.0);  // J = 2, F = 1
  drive.controller = at_load(TransferFunctionController{1.0, {4.0}, {0.5, 1.0}});
  drive.error_shape = {.begins = 0.2, .ends = 0.2, .inner_gain = 0.0, .offset = -0.2};
  const auto analysis = described(drive, DescribedPart::dead_band);
  ASSERT_EQ(analysis.cycles.size(), 1U);
  const DescribedMotion& cycle = analysis.cycles[0];
  EXPECT_NEAR(cycle.balance.frequency, 1.0, 1e-12);
  const double angle = std::acos(0.2 / cycle.amplitude);
  EXPECT_NEAR((2.0 * angle - std::sin(2.0 * angle)) / pi, 2.5 / 4.0, 1e-12);
  EXPECT_FALSE(cycle.balance.stable);
  EXPECT_THAT(described(drive, DescribedPart::gap_load_held).assumptions,
              Contains(Assumption::error_shape_left_out));
}

// ---- sampling -----------------------------------------------------------------------------------

TEST(OracleDescribing, SamplingIsADelayByHalfAPeriodMore) {
  ReducedDrive drive = type_one_servo(5.0, 1.0);
  drive.sampling = Sampling{.period = 0.04, .delay = 0.01};
  const auto analysis = described(drive, DescribedPart::gap_load_held);
  EXPECT_EQ(analysis.loop, (TransferFunction{{5.0}, {1.0, 1.0, 0.0}, 0.03}));
  EXPECT_THAT(analysis.assumptions, Contains(Assumption::sampling_as_delay));
  EXPECT_THAT(analysis.assumptions, Not(Contains(Assumption::delay_as_rational)));
}

TEST(OracleDescribing, TustinLeadsBackToTheControllerThatWasSampled) {
  ReducedDrive drive = type_one_servo(5.0, 1.0);
  drive.controller = at_load(PID{PIDTerms::PID, 3.0, 2.0, 0.7, 0.05, 0.0});
  const auto continuous = described(drive, DescribedPart::gap_load_held).loop;
  drive.sampling = Sampling{.period = 0.01, .delay = 0.0};
  const auto sampled = described(drive, DescribedPart::gap_load_held).loop;
  for (const double frequency : {0.1, 3.0, 50.0}) {
    const Complex delayed =
        frequency_response(continuous, frequency).value * std::polar(1.0, -0.005 * frequency);
    EXPECT_LT(std::abs(frequency_response(sampled, frequency).value - delayed),
              1e-10 * std::abs(delayed));
  }
}

TEST(OracleDescribing, ADelayInsideTheLoopIsNearlyOne) {
  ReducedDrive drive = type_one_servo(5.0, 1.0);
  drive.motor.friction.coulomb = drive.motor.friction.breakaway = 0.1;
  drive.sampling = Sampling{.period = 0.04, .delay = 0.01};
  const auto analysis = described(drive, DescribedPart::coulomb_friction);
  EXPECT_THAT(analysis.assumptions, Contains(Assumption::delay_as_rational));
  for (const double frequency : {1.0, 5.0, 30.0}) {
    const Complex s{0.0, frequency};
    const Complex expected = s / (s * s + s + 5.0 * std::exp(-0.03 * s));
    EXPECT_LT(std::abs(frequency_response(analysis.loop, frequency).value - expected),
              1e-7 * std::abs(expected));
  }
}

TEST(OracleDescribing, SpeedByDifferencesIsLateByHalfAPeriod) {
  ReducedDrive drive = type_one_servo(5.0, 1.0);
  drive.sensing.load_share_of_speed = 1.0;
  drive.controller = at_load(PID{.terms = PIDTerms::PD, .proportional = 5.0, .derivative = 2.0});
  drive.sampling = Sampling{.period = 0.04, .speed_by_differences = true};
  const auto loop = described(drive, DescribedPart::gap_load_held).loop;
  const double frequency = 2.0;
  const Complex s{0.0, frequency};
  const Complex expected = (5.0 + 2.0 * s / (1.0 + 0.02 * s)) / (s * s + s) * std::exp(-0.02 * s);
  EXPECT_LT(std::abs(frequency_response(loop, frequency).value - expected), 1e-13);
}

// ---- beside the exact cycle ---------------------------------------------------------------------

DescribedMotion predicted_cycle(double amplitude, double motor_amplitude, double period) {
  DescribedMotion predicted{.amplitude = amplitude, .motor_amplitude = motor_amplitude};
  predicted.balance.period = period;
  predicted.balance.stable = true;
  return predicted;
}

TEST(Describing, ErrorsAreAgainstTheExactCycleOfTheSameStability) {
  const DescribedMotion predicted = predicted_cycle(2.0, 3.0, 5.0);
  const std::vector<ExactMotion> exact = {
      {2.0, 3.0, 5.0, false}, {40.0, 1.0, 5.0}, {1.6, 4.0, 4.0}};
  const auto error = prediction_error(DescribedPart::gap_load_held, predicted, exact);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->exact, 2U);
  EXPECT_NEAR(error->amplitude, 0.25, 1e-15);
  EXPECT_NEAR(error->motor_amplitude, -0.25, 1e-15);
  EXPECT_NEAR(error->period, 0.25, 1e-15);
  EXPECT_NEAR(error->frequency, -0.2, 1e-15);
  EXPECT_FALSE(prediction_error(DescribedPart::gap_load_held, predicted, {exact[0]}));
}

/// Irregular motion follows the cycles, by the amplitude of its reports; forced motion is none.
TEST(Describing, ExactMotionsAreThoseOfTheAnswer) {
  Answer answer;
  answer.verdict = Verdict::hunts;
  answer.cycles = {
      {.stability = Stability::unstable, .amplitude = 2.0, .motor_amplitude = 3.0, .period = 5.0}};
  answer.irregular = {{.amplitude = 1.2,
                       .motor_amplitude = 1.5,
                       .mean_amplitude = 1.0,
                       .mean_period = 4.0,
                       .mismatch = 1e-6},
                      {.amplitude = 7.0}};
  const std::vector<ExactMotion> motions = exact_motions(answer);
  ASSERT_EQ(motions.size(), 3U);
  EXPECT_FALSE(motions[0].is_stable);
  EXPECT_EQ(motions[0].period, 5.0);
  EXPECT_EQ(motions[1].amplitude, 1.2);
  EXPECT_EQ(motions[1].motor_amplitude, 1.5);
  EXPECT_EQ(motions[1].period, 4.0);
  const auto error =
      prediction_error(DescribedPart::gap_load_held, predicted_cycle(2.0, 3.0, 5.0), motions);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->exact, 1U);  // of the third no period is known
  answer.verdict = Verdict::forced;
  EXPECT_TRUE(exact_motions(answer).empty());
}

TEST(Describing, AnotherMotionIsNotTakenForThatOfTheTorqueLimit) {
  const DescribedMotion predicted = predicted_cycle(50.0, 50.0, 0.5);
  const std::vector<ExactMotion> exact = {{0.2, 0.3, 0.16}};
  EXPECT_FALSE(prediction_error(DescribedPart::torque_limit, predicted, exact));
  EXPECT_FALSE(prediction_error(DescribedPart::coulomb_friction, predicted, exact));
  EXPECT_TRUE(prediction_error(DescribedPart::gap_load_coasting, predicted, exact));
  const std::vector<ExactMotion> near = {{30.0, 30.0, 0.4}};
  EXPECT_TRUE(prediction_error(DescribedPart::torque_limit, predicted, near));
}

TEST(Describing, TheInputOfTheExactCycleIsOfThePart) {
  const ExactMotion exact{1.0, 0.5, pi};
  const auto friction = described(pid_with_friction(12.0), DescribedPart::coulomb_friction);
  EXPECT_NEAR(input_amplitude(friction, exact), 1.0, 1e-14);  // a speed
  const auto gap = described(pid_with_friction(12.0), DescribedPart::gap_load_held);
  EXPECT_EQ(input_amplitude(gap, exact), 0.5);
}

TEST(EdgeDescribing, WithoutFeedbackNothingIsInALoop) {
  ReducedDrive drive = type_one_servo(0.0, 1.0);
  for (const DescribingAnalysis& analysis : describing_analyses(drive)) {
    EXPECT_FALSE(is_in_loop(analysis));
    EXPECT_TRUE(analysis.cycles.empty());
  }
  drive.backlash = -1.0;
  EXPECT_THROW(describing_analyses(drive), InvalidInput);
}

}  // namespace
}  // namespace gearlash::drive::describing_test
