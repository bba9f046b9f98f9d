// The best values for a series: put back into the drive, beside values that are known.
#include "gearlash/tune.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "base/stopping.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/linear_loop.hpp"
#include "question/pd_drive.hpp"
#include "question/series/toleranced_drive.hpp"
#include "question/series/toleranced_samples.hpp"

namespace gearlash::tune_test {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Proportional control of the load, plastic faces: it hunts above a gain that design() proves.
TuneTask servo_task() {
  TuneTask task{.series = {sample_data_sheet(), {}},
                .tuned = {logarithmic("controller.proportional", 1e-3, 1.0, 2)},
                .target = {.no_hunting = true},
                .least_phase_margin = 0.0};
  task.series.nominal.load.friction.viscous = 0.2;
  return task;
}

Drive with_gain(double gain) {
  Drive drive = servo_task().series.nominal;
  set(drive, "controller.proportional", gain);
  return drive;
}

TEST(OracleTune, TheGreatestBandwidthIsAtTheBorderOfHunting) {
  const TuneTask task = servo_task();
  const FeasibleValues exact = values(task.series.nominal, "controller.proportional", task.target);
  ASSERT_EQ(exact.intervals.size(), 1U);
  const double border = exact.intervals[0].high;
  ASSERT_GT(border, 1e-2);
  ASSERT_LT(border, 1.0);
  const TunedDrive tuned = tune(task);
  EXPECT_TRUE(tuned.meets);
  EXPECT_TRUE(tuned.by_derivatives);
  EXPECT_EQ(tuned.units, 1U);
  EXPECT_LE(tuned.values[0], border);
  EXPECT_GE(tuned.values[0], (1.0 - 1e-6) * border);
  const auto loop = drive::loop_figures(reduce(with_gain(tuned.values[0])));
  EXPECT_NEAR(tuned.reached, 2.0 * std::numbers::pi * loop->bandwidth.value(),
              1e-9 * tuned.reached);
  EXPECT_EQ(get(tuned.drive, "controller.proportional"), tuned.values[0]);
}

TEST(OracleTune, TheUnitWithTheLeastFrictionLimitsASeries) {
  TuneTask task = servo_task();
  task.series.varied = {{"load.friction", UniformBetween{0.15, 0.25}}};
  Drive least = task.series.nominal;
  least.load.friction.viscous = 0.15;
  const double border = values(least, "controller.proportional", task.target).intervals[0].high;
  const TunedDrive tuned = tune(task, {.units = 16});
  EXPECT_TRUE(tuned.meets);
  EXPECT_EQ(tuned.met, 16U);
  EXPECT_LE(tuned.values[0], border);
  EXPECT_GE(tuned.values[0], 0.97 * border);
  ASSERT_TRUE(tuned.limiting);
  EXPECT_NEAR(tuned.limiting->values[0], 0.15, 1e-12);
  EXPECT_EQ(tuned.limiting->answer.verdict, Verdict::hunts);
  EXPECT_GT(tuned.rounds, 1U);
}

/// A searched cycle that may swing by so much: at the best gains it does.
TEST(OracleTune, DerivativesOfASearchedCycleLeadToItsLimit) {
  TuneTask task{.series = {pd_drive(), {}},
                .tuned = {logarithmic("controller.proportional", 2.0, 200.0, 2)},
                .least_phase_margin = 0.2};
  constexpr double limit = 2.5e-3;
  task.target.require(Quantity::amplitude, {0.0, limit});
  const TunedDrive tuned = tune(task, {.evaluations = 30});
  EXPECT_TRUE(tuned.meets);
  EXPECT_TRUE(tuned.by_derivatives);
  const double amplitude =
      analyse(tuned.drive, {.proofs = false}).value(Quantity::amplitude).value();
  EXPECT_LE(amplitude, limit);
  EXPECT_GE(amplitude, (1.0 - 1e-6) * limit);
}

TEST(Tune, KeepsThePhaseMarginAskedFor) {
  TuneTask task = servo_task();
  task.least_phase_margin = 1.0;
  const TunedDrive tuned = tune(task);
  const auto loop = drive::loop_figures(reduce(tuned.drive));
  EXPECT_GE(loop->phase_margin.value(), 1.0);
  EXPECT_LE(loop->phase_margin.value(), 1.0 + 1e-6);
}

TEST(Tune, SaysWhatMissesTheTargetWhereNothingMeetsIt) {
  TuneTask task = servo_task();
  task.series.nominal.load.friction.viscous = 0.0;
  task.series.nominal.motor.friction.viscous = 1e-3;
  task.series.nominal.motor.kind = TorqueControl{};
  task.tuned = {logarithmic("controller.proportional", 0.5, 1.0, 2)};
  const TunedDrive tuned = tune(task, {.evaluations = 5});
  EXPECT_FALSE(tuned.meets);
  EXPECT_EQ(tuned.met, 0U);
  ASSERT_TRUE(tuned.limiting);
  EXPECT_EQ(tuned.limiting->answer.verdict, Verdict::hunts);
}

TEST(Tune, KnowsWhenIntegralActionAlwaysHunts) {
  Drive drive = sample_data_sheet();
  drive.controller.law = PID{.terms = PIDTerms::PID, .proportional = 1.0, .integral = 1.0};
  drive.load.friction = {.coulomb = 0.1, .breakaway = 0.2};
  EXPECT_THAT(why_integral_action_hunts(drive).value_or(""), HasSubstr("Armstrong"));
  drive.load.friction.breakaway = 0.1;
  EXPECT_FALSE(why_integral_action_hunts(drive));
  drive.load.friction.breakaway = 0.2;
  drive.sensor.encoder.counts_per_turn = 1000.0;
  EXPECT_FALSE(why_integral_action_hunts(drive));
  drive.sensor.encoder.counts_per_turn.reset();
  std::get<PID>(drive.controller.law).terms = PIDTerms::PD;
  EXPECT_FALSE(why_integral_action_hunts(drive));
}

/// As a cascade has it, of its speed.
TEST(Tune, IntegralActionOfACascadeCanBeGivenUp) {
  TuneTask task{.series = {pd_drive(), {}},
                .tuned = {logarithmic("controller.speed_integral", 1.0, 10.0, 2),
                          logarithmic("controller.speed", 1.0, 10.0, 2)}};
  task.series.nominal.controller.law =
      CascadeController{.position = 2.0, .speed = 3.0, .speed_integral = 4.0};
  const auto without = without_integral_action(task);
  ASSERT_TRUE(without);
  const auto& law = std::get<CascadeController>(without->series.nominal.controller.law);
  EXPECT_EQ(law.speed_integral, 0.0);
  EXPECT_EQ(law.speed, 3.0);
  ASSERT_EQ(without->tuned.size(), 1U);
  EXPECT_EQ(without->tuned[0].path, "controller.speed");
  EXPECT_FALSE(without_integral_action(*without));
}

std::vector<std::string> faults_of(const TuneTask& task, const TuneEffort& effort = {}) {
  std::vector<std::string> lines;
  for (const Fault& fault : faults(task, effort)) lines.push_back(to_string(fault));
  return lines;
}

TEST(Tune, IntegralActionCanBeGivenUp) {
  TuneTask task{.series = {pd_drive(), {}},
                .tuned = {logarithmic("controller.integral", 1.0, 10.0, 2),
                          logarithmic("controller.proportional", 1.0, 10.0, 2)}};
  auto& pid = std::get<PID>(task.series.nominal.controller.law);
  pid.terms = PIDTerms::PID;
  pid.integral = 2.0;
  const auto without = without_integral_action(task);
  ASSERT_TRUE(without);
  EXPECT_EQ(std::get<PID>(without->series.nominal.controller.law).terms, PIDTerms::PD);
  ASSERT_EQ(without->tuned.size(), 1U);
  EXPECT_EQ(without->tuned[0].path, "controller.proportional");
  EXPECT_FALSE(without_integral_action(*without));
  task.tuned.resize(1);
  EXPECT_FALSE(without_integral_action(task));
}

TEST(EdgeTune, EveryFaultIsToldAtOnce) {
  TuneTask task = servo_task();
  EXPECT_TRUE(faults_of(task).empty());
  task.series.varied = {{"controller.proportional", within_share(1.0, 0.1)}};
  task.tuned.push_back({.path = "controller.colour", .values = {1.0, 2.0}});
  task.tuned.push_back({.path = "load.inertia", .values = {1.0}});
  task.share = 0.0;
  task.least_phase_margin = 2.0;
  task.target.require(Quantity::amplitude, {2.0, 1.0});
  const std::vector<std::string> lines = faults_of(task, {.units = 0});
  for (const char* text :
       {"must be exact where it is tuned", "controller.colour", "load.inertia = one value",
        "share = 0", "least_phase_margin = 2", "units = 0", "target"}) {
    EXPECT_THAT(lines, Contains(HasSubstr(text)));
  }
  EXPECT_THROW((void)tune(task), InvalidInput);
  task = servo_task();
  task.tuned.clear();
  EXPECT_THAT(faults_of(task), Contains(HasSubstr("must name a parameter to tune")));
}

TEST(EdgeTune, StopsWithTheBestByThen) {
  test::Stopping stop(4);
  const TunedDrive tuned = tune(servo_task(), {}, stop);
  EXPECT_TRUE(tuned.stopped);
  EXPECT_FALSE(tuned.meets);
  EXPECT_EQ(tuned.values.size(), 1U);
}

}  // namespace
}  // namespace gearlash::tune_test
