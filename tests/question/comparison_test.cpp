// Drives side by side: the answers of analyse(), the linear loop, and what moving a sensor changes.
#include "gearlash/comparison.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/stopping.hpp"
#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"
#include "question/step_response.hpp"

namespace gearlash::comparison_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double turn = 2.0 * std::numbers::pi;

Drive servo(double damping) { return normal_form(damping, 2.0, 0.1, 0.3); }

/// A joint of eight motor turns, with ODrive's registers as of its tuning guide.
Drive joint(SensorPlace place) {
  Drive drive;
  drive.motor = {.inertia = 1e-4, .friction = {.viscous = 1e-4, .coulomb = 0.03}};
  drive.gearbox = {.ratio = 8.0, .backlash = 0.05};
  drive.load = {.inertia = 0.2, .friction = {.viscous = 0.02}};
  drive.sensor.position = place;
  drive.sampling = Sampling{.period = 1e-3};
  drive.controller.firmware = ODrive{.pos_gain = 20.0, .vel_gain = 0.16};
  return drive;
}

TEST(OracleComparison, HasTheAnswersOfAnalyseInTheOrderOfTheDrives) {
  const std::vector<NamedDrive> drives = {
      {"hunts", servo(0.19)}, {"rests", servo(0.9)}, {"joint", joint(SensorPlace::motor)}};
  const std::vector<ComparedDrive> compared = compare(drives);
  ASSERT_EQ(compared.size(), drives.size());
  for (std::size_t i = 0; i < drives.size(); ++i) {
    EXPECT_EQ(compared[i].name, drives[i].name);
    EXPECT_EQ(compared[i].drive, drives[i].drive);
    const Answer alone = analyse(drives[i].drive, {.ceiling = true, .causes = true});
    EXPECT_EQ(compared[i].answer->verdict, alone.verdict);
    EXPECT_EQ(compared[i].answer->certainty, alone.certainty);
    EXPECT_EQ(compared[i].answer->ceiling->load, alone.ceiling->load);
    for (const Quantity quantity :
         {Quantity::amplitude, Quantity::period, Quantity::static_error}) {
      EXPECT_EQ(compared[i].answer->value(quantity), alone.value(quantity)) << i;
    }
    EXPECT_TRUE(compared[i].answer->loop->is_stable);
  }
  EXPECT_EQ(compared[0].answer->certainty, Certainty::enclosed);
}

/// That of the first, 1 rad of a normal form; K = 1 N m/rad in every normal form.
TEST(OracleComparison, AllMakeTheStepOfTheFirst) {
  const auto compared = compare({{"first", servo(0.9)}, {"second", normal_form(0.9, 2, 0.1, 0.7)}});
  for (const ComparedDrive& one : compared) {
    EXPECT_DOUBLE_EQ(one.answer->step->step, 1.0) << one.name;
    EXPECT_DOUBLE_EQ(*one.stiffness, 1.0) << one.name;
  }
  const auto asked = compare({{"first", servo(0.9)}}, {.step = -2.0, .until = 7.0});
  EXPECT_EQ(asked[0].answer->step->step, -2.0);
  EXPECT_EQ(asked[0].answer->step->until, 7.0);
}

/// vel_gain in N m/(turn/s) and pos_gain in 1/s, of the shaft that is sensed: at the load n² times
/// their product with the sensor on the motor, n times with it on the load.
TEST(OracleComparison, ASensorThatMovesRescalesRegisters) {
  const auto compared = compare(
      {{"motor", joint(SensorPlace::motor)}, {"load", joint(SensorPlace::load)}}, {.until = 0.1});
  const double stiffness = 20.0 * 0.16 / turn;
  EXPECT_NEAR(*compared[0].stiffness, 64.0 * stiffness, 1e-12 * 64.0);
  EXPECT_NEAR(*compared[1].stiffness, 8.0 * stiffness, 1e-12 * 8.0);
}

TEST(PropertyComparison, OnlyAStableLoopHasAStepResponse) {
  Drive unstable = servo(0.9);
  unstable.servo.reset();
  unstable.motor = {.inertia = 1.0};
  unstable.gearbox.backlash = 0.3;
  unstable.load.inertia = 1.0;
  unstable.controller.law = PID{.terms = PIDTerms::PI, .proportional = 1.0, .integral = 1.0};
  const auto compared = compare({{"stable", servo(0.9)}, {"unstable", unstable}});
  EXPECT_TRUE(compared[0].answer->step.has_value());
  EXPECT_FALSE(compared[1].answer->loop->is_stable);
  EXPECT_FALSE(compared[1].answer->step.has_value());
  EXPECT_FALSE(compared[1].answer->value(Quantity::overshoot).has_value());
}

/// Twenty swings of the loop end long before a weak motor has turned its load.
TEST(EdgeComparison, AStepIsFollowedUntilTheLoadHasRisen) {
  Drive slow = joint(SensorPlace::motor);
  slow.motor.limit = 0.05;
  slow.motor.friction = {};
  const drive::ReducedDrive reduced = reduce(slow);
  const double usual = drive::usual_step_time(reduced);
  const double step = 1000.0;
  ASSERT_FALSE(drive::step_response(reduced, step, 0.05 * step, usual).rise_time);
  const auto compared = compare({{"slow", slow}}, {.step = step});
  EXPECT_TRUE(compared[0].answer->step->rise_time);
  EXPECT_GT(compared[0].answer->step->until, usual);
  const auto cut = compare({{"slow", slow}}, {.step = step, .until = usual});
  EXPECT_FALSE(cut[0].answer->step->rise_time);
}

TEST(EdgeComparison, AllFaultsOfAllDrivesAreLocatedAtTheirNames) {
  Drive faulty = servo(0.9);
  set(faulty, "servo.damping", -1.0);
  set(faulty, "servo.friction_ratio", 2.0);
  try {
    static_cast<void>(compare({{"one", faulty}, {"two", servo(0.9)}, {"three", faulty}},
                              {.step = 0.0, .until = -1.0}));
    FAIL();
  } catch (const InvalidInput& error) {
    std::vector<std::string> places;
    for (const Fault& fault : error.faults()) places.push_back(fault.where + ":" + fault.path);
    EXPECT_THAT(places, ElementsAre(":step", ":until", HasSubstr("one:"), HasSubstr("one:"),
                                    HasSubstr("three:"), HasSubstr("three:")));
  }
  EXPECT_THROW(static_cast<void>(compare({})), InvalidInput);
  EXPECT_THROW(static_cast<void>(compare(std::vector<NamedDrive>(101, {"", servo(0.9)}))),
               InvalidInput);
}

TEST(EdgeComparison, DrivesThatAreNotReachedHaveNoAnswer) {
  test::Stopping stopped(0);
  const std::vector<NamedDrive> many(100, {"joint", joint(SensorPlace::motor)});
  const auto compared = compare(many, {}, stopped);
  ASSERT_EQ(compared.size(), many.size());
  EXPECT_TRUE(std::any_of(compared.begin(), compared.end(),
                          [](const ComparedDrive& one) { return !one.answer; }));
  for (const ComparedDrive& one : compared) EXPECT_EQ(one.name, "joint");
}

}  // namespace
}  // namespace gearlash::comparison_test
