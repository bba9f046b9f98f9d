// The public face of tolerances: searched drives, the error asked for, and bad input.
#include "gearlash/tolerance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gearlash/analyse.hpp"
#include "question/faults_of.hpp"
#include "question/series/toleranced_samples.hpp"

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

/// The servo of 1960 with dry friction at the motor; it hunts where the friction is small.
Drive drive_with_dry_friction() {
  Drive drive = sample_data_sheet();
  drive.motor.friction.coulomb = 1e-3;
  return drive;
}

/// A quarter of the drives has little friction, three quarters so much that they come to rest.
TEST(Tolerance, OfASearchedDriveAreItsDrivesThoseOfAnalyse) {
  const TolerancedDrive drive{drive_with_dry_friction(),
                              {{"motor.coulomb", DiscreteLots{{{1e-3, 1.0}, {3.0, 3.0}}}}}};
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
  TolerancedDrive drive{sample_servo(), {{"servo.backlash", within_share(0.3, 0.1)}}};
  drive.nominal.reference = StepSignal{.after = 1.0};  // on which hunting does not depend
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
  const auto faults_with = [](const char* path, const Distribution& distribution) {
    return test::faults_of([&] {
      (void)study_tolerances({drive_with_dry_friction(), {{path, distribution}}});
    });
  };
  EXPECT_THAT(faults_with("load.colour", within_share(0.2, 0.1)),
              Contains(HasSubstr("must be a number of this drive")));
  EXPECT_THAT(faults_with("motor.coulomb", UniformBetween{-1.0, 1.0}),
              Contains("motor.coulomb = uniform from -1 to 1: must not fall below zero"));
}

}  // namespace
}  // namespace gearlash::tolerance_test
