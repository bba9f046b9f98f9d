// The public face of design: what a program asks, and what it is answered.
#include "gearlash/design.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/stopping.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "question/faults_of.hpp"

namespace gearlash::design_test {
namespace {

Target amplitude_within(const Bounds& limits) {
  return Target{}.require(Quantity::amplitude, limits);
}

using testing::ElementsAre;
using testing::HasSubstr;

Drive sample_servo() { return normal_form(0.19, 2.0, 0.1, 0.3); }

Drive with(Drive drive, std::string_view path, double value) {
  set(drive, path, value);
  return drive;
}

TEST(Design, DampingWithoutHuntingBeginsWhereGrowthAtRestIsOne) {
  const FeasibleValues damping = values(sample_servo(), "servo.damping", {.no_hunting = true});
  EXPECT_EQ(damping.kind, SearchKind::certified);
  ASSERT_EQ(damping.intervals.size(), 1U);
  const double least = damping.intervals[0].low;
  EXPECT_EQ(damping.nearest(), least);
  EXPECT_TRUE(damping.contains(least));
  EXPECT_FALSE(damping.contains(damping.present));
  const Answer there = analyse(with(sample_servo(), "servo.damping", least), {.proofs = false});
  EXPECT_NEAR(there.growth_at_rest.value(), 1.0, 1e-13);
  EXPECT_EQ(there.verdict, Verdict::cannot_hunt);
  EXPECT_EQ(analyse(with(sample_servo(), "servo.damping", least * (1.0 - 1e-12))).verdict,
            Verdict::hunts);
}

TEST(Design, ASignalThatEndsIsLeftOut) {
  Drive drive = sample_servo();
  drive.reference = StepSignal{.after = 1.0};
  const Target target{.no_hunting = true};
  EXPECT_EQ(values(drive, "servo.damping", target).intervals,
            values(sample_servo(), "servo.damping", target).intervals);
}

/// The sample servo with J_M + J_L = 1 kg m² and ω_n = 1 rad/s, and its numbers changed.
Drive changed(const LogChange& change) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = std::exp(change.motor_inertia) / 3.0,
                 .friction = {.viscous = std::exp(change.motor_friction) * 0.342}};
  drive.load = {.inertia = std::exp(change.load_inertia) * 2.0 / 3.0,
                .friction = {.viscous = std::exp(change.load_friction) * 0.038}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.3};
  drive.controller.law = PID{.proportional = std::exp(change.stiffness)};
  return drive;
}

TEST(Design, TheLeastChangeEndsWhereGrowthAtRestIsOne) {
  const Drive drive = changed({});
  const HuntingMargin margin = margins(drive);
  EXPECT_NEAR(margin.growth_at_rest.value(), analyse(sample_servo()).growth_at_rest.value(), 1e-13);
  EXPECT_EQ(margin.overall->outcome, MarginOutcome::found);
  EXPECT_TRUE(margin.overall->hunts);
  ASSERT_TRUE(margin.overall->change);
  EXPECT_NEAR(analyse(changed(*margin.overall->change)).growth_at_rest.value(), 1.0, 1e-10);
  EXPECT_FALSE(margin.stopped);

  for (const ParameterMargin& one : margin.parameters) {
    SCOPED_TRACE(one.parameter);
    if (one.parameter == "tachometer") {
      EXPECT_TRUE(one.above && !one.per_cent_above());
      continue;
    }
    for (const std::optional<double>& end : {one.below, one.above}) {
      if (!end) continue;
      EXPECT_NEAR(analyse(with(drive, one.parameter, *end)).growth_at_rest.value(), 1.0, 1e-12);
    }
  }
  const ParameterMargin& gain = margin.parameters[2];
  EXPECT_EQ(gain.parameter, "controller.proportional");
  EXPECT_FALSE(gain.above);
  EXPECT_EQ(gain.per_cent_below(), 100.0 * (gain.below.value() - 1.0));
}

TEST(Design, AMarginThatIsStoppedSaysSo) {
  test::Stopping impatient;
  const HuntingMargin margin = margins(sample_servo(), {}, impatient);
  EXPECT_TRUE(margin.stopped);
  EXPECT_EQ(margin.parameters.size(), 1U);
  EXPECT_TRUE(margin.overall->change);
}

using test::faults_of;

TEST(EdgeDesign, BadInputIsAFault) {
  const auto asked = [](const Drive& drive, std::string_view path, const Target& target) {
    return faults_of([&] { (void)values(drive, path, target); });
  };
  const Target quiet{.no_hunting = true};
  EXPECT_THAT(asked(sample_servo(), "servo.dumping", quiet),
              ElementsAre(HasSubstr("parameter = servo.dumping: must be a number or a choice")));
  EXPECT_THAT(asked(sample_servo(), "servo.damping", amplitude_within({0.2, 0.1})),
              ElementsAre("target = amplitude >= 0.2 and amplitude <= 0.1: must not contradict "
                          "itself"));
  EXPECT_THAT(asked(with(sample_servo(), "servo.damping", -1.0), "servo.damping", quiet),
              ElementsAre(HasSubstr("servo.damping = -1")));
  EXPECT_THAT(faults_of([&] { (void)margins(with(sample_servo(), "servo.damping", -1.0)); }),
              ElementsAre(HasSubstr("servo.damping = -1")));
}

}  // namespace
}  // namespace gearlash::design_test
