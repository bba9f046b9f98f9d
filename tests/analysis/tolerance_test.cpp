// The public face of tolerances: probabilities that are known, and what is said of bad input.
#include "gearlash/tolerance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "analysis/design/toleranced_samples.hpp"
#include "gearlash/analyse.hpp"

namespace gearlash::tolerance_test {
namespace {

using testing::Contains;
using testing::HasSubstr;

Drive sample_servo() { return normal_form(0.19, 2.0, 0.1, 0.3); }

/// Amplitudes are in proportion to backlash.
double amplitude_per_backlash() {
  return analyse(sample_servo()).largest_stable()->amplitude / 0.3;
}

Target amplitude_up_to(double limit) { return Target{}.require(Quantity::amplitude, {0.0, limit}); }

void expect_near(const Estimate& estimate, double exact) {
  EXPECT_NEAR(estimate.value, exact, 6.0 * estimate.standard_error.value() + 1e-4);
}

TEST(Tolerance, AShareOfAUniformBacklashMeetsALimitOfTheAmplitude) {
  const TolerancedDrive drive{sample_servo(), {{"servo.backlash", within_share(0.3, 0.1)}}};
  const StudyQuestions questions{.target = amplitude_up_to(0.315 * amplitude_per_backlash()),
                                 .shares = {0.5}};
  const ToleranceStudy study = study_tolerances(drive, {}, questions);
  EXPECT_EQ(study.hunting.value, 1.0);
  expect_near(study.yield, 0.75);
  expect_near(study.mean_amplitude.value(), 0.3 * amplitude_per_backlash());
  expect_near(study.amplitude[0].value.value(), 0.3 * amplitude_per_backlash());
  EXPECT_EQ(study.undecided + study.unknown_amplitudes + study.refused, 0U);
  EXPECT_FALSE(study.stopped);
}

TEST(Tolerance, AShareOfAUniformDampingHunts) {
  const FeasibleValues quiet =
      feasible_values(sample_servo(), "servo.damping", {.no_hunting = true});
  const double least = quiet.nearest().value();
  const double low = 0.9 * least;
  const double high = 1.3 * least;
  Drive nominal = sample_servo();
  nominal.reference = StepSignal{.after = 1.0};  // on which hunting does not depend
  const TolerancedDrive drive{nominal, {{"servo.damping", UniformBetween{low, high}}}};
  EXPECT_TRUE(faults(drive).empty());
  expect_near(study_tolerances(drive).hunting, 0.25);

  const SensitivityStudy indices = study_sensitivities(drive, sampling_of(10'000));
  ASSERT_EQ(indices.numbers.size(), 1U);
  EXPECT_EQ(indices.numbers[0].path, "servo.damping");
  EXPECT_NEAR(indices.numbers[0].of_hunting.value().total.value, 1.0, 0.02);
  expect_near(indices.hunting_variance, 0.25 * 0.75);
}

TEST(Tolerance, WhatDoesNotVaryHasNoQuantilesAndNoIndices) {
  const TolerancedDrive quiet{normal_form(1.5, 2.0, 0.1, 0.3),
                              {{"servo.backlash", UniformBetween{0.2, 0.4}}}};
  const ToleranceStudy study = study_tolerances(quiet, {.points = 64, .replicates = 2});
  EXPECT_EQ(study.hunting.value, 0.0);
  EXPECT_EQ(study.mean_amplitude.value().value, 0.0);
  EXPECT_FALSE(study.amplitude_of_hunting[0].value);
  EXPECT_FALSE(study.frequency[0].value);
  const SensitivityStudy indices = study_sensitivities(quiet, {.points = 64, .replicates = 2});
  EXPECT_FALSE(indices.numbers[0].of_amplitude);
  EXPECT_FALSE(indices.numbers[0].of_hunting);
}

/// Of a backlash that is uniform from 0 to max, a share limit/(amplitude per backlash)/max is met.
TEST(Tolerance, TheWidestBacklashIsThatOfTheYield) {
  const double limit = 0.1;
  const auto widest = widest_backlash({sample_servo(), {}},
                                      {.target = amplitude_up_to(limit), .yield = 0.8, .min = 0.0});
  ASSERT_TRUE(widest);
  EXPECT_NEAR(widest->max, limit / amplitude_per_backlash() / 0.8, 1e-4);
  EXPECT_TRUE(widest->uncertainty.contains(widest->max));
  expect_near(widest->yield, 0.8);
}

TEST(Tolerance, AStudyThatIsStoppedSaysSo) {
  struct : Progress {
    bool go_on(double, std::size_t) override { return false; }
  } impatient;
  const TolerancedDrive drive{sample_servo(), {{"servo.backlash", within_share(0.3, 0.1)}}};
  EXPECT_TRUE(study_tolerances(drive, {.points = 100'000}, {}, impatient).stopped);
  EXPECT_TRUE(study_sensitivities(drive, {.points = 100'000}, {}, impatient).stopped);
}

std::vector<std::string> faults_of(const TolerancedDrive& drive, const SamplePlan& sampling = {}) {
  std::vector<std::string> lines;
  try {
    (void)study_tolerances(drive, sampling);
  } catch (const InvalidInput& error) {
    for (const Fault& fault : error.faults()) lines.push_back(to_string(fault));
  }
  return lines;
}

// ---- drives that are searched -------------------------------------------------------------------

/// The servo of 1960 with dry friction at the motor; it hunts where the friction is small.
Drive drive_with_dry_friction() {
  Drive drive = sample_data_sheet();
  drive.motor.friction.coulomb = 1e-3;
  return drive;
}

/// A quarter of the drives has little friction, three quarters so much that they come to rest.
TolerancedDrive two_lots() {
  return {drive_with_dry_friction(), {{"motor.coulomb", DiscreteLots{{{1e-3, 1.0}, {3.0, 3.0}}}}}};
}

TEST(Tolerance, OfASearchedDriveAreItsDrivesThoseOfAnalyse) {
  const TolerancedDrive drive = two_lots();
  const Answer hunting = analyse(drive_with_dry_friction());
  ASSERT_EQ(hunting.verdict, Verdict::hunts);
  const double amplitude = hunting.value(Quantity::motor_amplitude).value();
  const SamplePlan sampling{.points = 4, .replicates = 2};  // of four points one has u < 1/4
  const StudyQuestions questions{
      .amplitude = Quantity::motor_amplitude,
      .target = Target{}.require(Quantity::motor_amplitude, {0.0, 0.5 * amplitude}),
      .shares = {0.5}};
  const ToleranceStudy study = study_tolerances(drive, sampling, questions);
  EXPECT_EQ(study.hunting.value, 0.25);
  EXPECT_EQ(study.yield.value, 0.75);
  EXPECT_EQ(study.undecided + study.unknown_amplitudes + study.refused, 0U);
  EXPECT_NEAR(study.amplitude_of_hunting[0].value->value, amplitude, 1e-9 * amplitude);
  const SensitivityStudy indices = study_sensitivities(drive, sampling, questions);
  EXPECT_EQ(indices.left_out, 0U);
  EXPECT_NEAR(indices.hunting_variance.value, 0.25 * 0.75, 1e-12);
  EXPECT_THROW((void)widest_backlash(drive, {.target = questions.target}), InvalidInput);
}

TEST(Tolerance, TakesAsManySamplesAsTheErrorNeeds) {
  const TolerancedDrive drive{sample_servo(), {{"servo.backlash", within_share(0.3, 0.1)}}};
  const StudyQuestions questions{.target = amplitude_up_to(0.315 * amplitude_per_backlash())};
  const SamplePlan few{.points = 2};
  for (const double error : {0.05, 0.002}) {
    const ToleranceStudy study = study_tolerances_to(error, drive, few, questions);
    EXPECT_NEAR(study.yield.value, 0.75, 2.0 * error);
    EXPECT_LE(2.0 * study.yield.standard_error.value(), error);
    // All of them hunt, and nobody knows it of those that were not drawn.
    const auto samples = static_cast<double>(study.sampling.samples());
    EXPECT_GE(samples, 3.0 / error);
    EXPECT_LT(samples, 3000.0 / error);
  }
  EXPECT_THROW((void)study_tolerances_to(0.0, drive), InvalidInput);
}

TEST(EdgeTolerance, BadInputIsAFault) {
  EXPECT_THAT(faults_of({sample_servo(), {{"servo.dumping", within_share(0.2, 0.1)}}}),
              Contains(HasSubstr("servo.dumping")));
  EXPECT_THAT(faults_of({sample_servo(), {{"servo.damping", UniformBetween{-1.0, 1.0}}}}),
              Contains(HasSubstr("must not fall below zero")));
  EXPECT_THAT(faults_of({sample_servo(), {}}, {.replicates = 1}),
              Contains(HasSubstr("sampling.replicates = 1")));
  EXPECT_THAT(faults_of({drive_with_dry_friction(), {{"load.colour", within_share(0.2, 0.1)}}}),
              Contains(HasSubstr("must be a number of this drive")));
  EXPECT_THAT(
      faults_of({drive_with_dry_friction(), {{"motor.coulomb", UniformBetween{-1.0, 1.0}}}}),
      Contains(HasSubstr("the tolerances permit it where motor.coulomb = -0.99")));
}

}  // namespace
}  // namespace gearlash::tolerance_test
