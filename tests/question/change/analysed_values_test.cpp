// The values of any parameter of any drive that meet a target, put back into the drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/stopping.hpp"
#include "base/traced_draws.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/design.hpp"
#include "gearlash/parameter.hpp"
#include "question/analyse.hpp"
#include "question/change/target.hpp"
#include "question/faults_of.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::analysed_values_test {
namespace {

using test::faults_of;
using testing::ElementsAre;
using testing::HasSubstr;

Drive with(Drive drive, std::string_view path, double value) {
  set(drive, path, value);
  return drive;
}

/// Every end meets the target, and just beyond it is missed.
void expect_ends_are_ends(const Drive& drive, const FeasibleValues& found, const Target& target) {
  const auto meets = [&](double value) {
    return is_met(target, analyse(with(drive, found.parameter, value), {.ceiling = true}));
  };
  const double beyond = 3.0 * found.located;
  for (const Bounds& interval : found.intervals) {
    EXPECT_TRUE(meets(interval.low)) << interval.low;
    EXPECT_TRUE(meets(interval.high)) << interval.high;
    EXPECT_TRUE(meets(0.5 * (interval.low + interval.high)));
    if (interval.low > found.searched.low) {
      EXPECT_FALSE(meets(interval.low * (1.0 - beyond)));
    }
    if (interval.high < found.searched.high) {
      EXPECT_FALSE(meets(interval.high * (1.0 + beyond)));
    }
  }
}

TEST(FeasibleValues, OfAnAxisInClosedFormAreThoseOfItsRange) {
  const Drive servo = normal_form(0.19, 2.0, 0.1, 0.3);
  const FeasibleValues whole = values(servo, "servo.damping", always_at_rest());
  const FeasibleValues part =
      values(servo, logarithmic("servo.damping", 0.05, 5.0, 11), always_at_rest());
  EXPECT_EQ(part.kind, SearchKind::certified);
  ASSERT_EQ(part.intervals.size(), 1U);
  ASSERT_EQ(whole.intervals.size(), 1U);
  EXPECT_NEAR(part.intervals[0].low, whole.intervals[0].low, 4e-15);
  EXPECT_EQ(part.intervals[0].high, 5.0);
}

TEST(SearchedValues, OfAGainEndWhereTheDriveBeginsToHunt) {
  const Drive drive = pd_drive();
  const FeasibleValues found =
      values(drive, logarithmic("controller.proportional", 0.5, 50.0, 9), always_at_rest());
  ASSERT_FALSE(found.intervals.empty());
  EXPECT_TRUE(found.undecided.empty());
  expect_ends_are_ends(drive, found, always_at_rest());
}

/// A ceiling is in proportion to the gap where the gap is its only source.
TEST(SearchedValues, OfABacklashThatKeepsACeiling) {
  Drive drive = pd_drive();
  drive.motor.friction.coulomb = 0.0;
  drive.load.friction.coulomb = 0.0;
  const double ceiling = analyse(drive, {.ceiling = true}).value(Quantity::ceiling).value();
  const Target target = Target{}.require(Quantity::ceiling, {0.0, 3.0 * ceiling});
  const FeasibleValues found = values(drive, linear("gearbox.backlash", 1e-3, 1e-2, 4), target);
  ASSERT_EQ(found.intervals.size(), 1U);
  EXPECT_EQ(found.intervals[0].low, 1e-3);
  EXPECT_NEAR(found.intervals[0].high, 6e-3, 1e-9 * 6e-3 + 1e-4 * 1e-3 * 9e-3);
}

/// Of a loop K/(J s² + F s + K) while its shafts turn as one.
Drive second_order() {
  Drive drive = pd_drive();
  drive.motor = {.kind = TorqueControl{}, .inertia = 0.01, .friction = {.viscous = 0.02}};
  drive.load = {.inertia = 0.02, .friction = {.viscous = 0.03}};
  drive.gearbox.ratio = 1.0;
  drive.controller.law = PID{.proportional = 2.0};
  return drive;
}

/// Its gain falls by 3 dB at ω for K = √(2J²ω⁴ + F²ω²) − Jω².
TEST(OracleSearchedValues, OfAGainThatReachesABandwidth) {
  const Drive drive = second_order();
  const double frequency = 1.5;
  const double w = 2.0 * std::numbers::pi * frequency;
  const double gain =
      std::sqrt(2.0 * std::pow(0.03 * w * w, 2) + std::pow(0.05 * w, 2)) - 0.03 * w * w;
  const Target target = Target{}.require(Quantity::bandwidth, {frequency, Target::infinity});
  const Axis axis = logarithmic("controller.proportional", 0.5, 20.0, 9);
  const FeasibleValues found = values(drive, axis, target);
  ASSERT_EQ(found.intervals.size(), 1U);
  EXPECT_NEAR(found.intervals[0].low, gain, 1e-8 * gain);
  EXPECT_GE(analyse(with(drive, axis.path, found.intervals[0].low), {.loop = true})
                .value(Quantity::bandwidth),
            frequency);
  EXPECT_EQ(found.intervals[0].high, 20.0);
  EXPECT_FALSE(analyse(drive).value(Quantity::bandwidth));  // was not wanted
  const Table table = evaluate({.drive = drive, .axes = {linear(axis.path, gain, 2.0 * gain, 2)}},
                               std::array{Quantity::bandwidth, Quantity::phase_margin});
  EXPECT_NEAR(table[Quantity::bandwidth][0], frequency, 1e-9);
  EXPECT_GT(table[Quantity::phase_margin][0], table[Quantity::phase_margin][1]);
}

/// Its step exceeds the reference by e^(−πζ/√(1 − ζ²)) of it, for the damping ζ = F/(2√(JK)).
TEST(OracleSearchedValues, OfAGainWithoutMuchOvershoot) {
  Drive drive = second_order();
  drive.gearbox.backlash = 0.0;
  drive.contact = CompliantContact{.stiffness = 1e6, .damping = 10.0};
  const double ratio = std::log(0.1) / std::numbers::pi;
  const double damping = std::sqrt(ratio * ratio / (1.0 + ratio * ratio));
  const double gain = std::pow(0.05 / (2.0 * damping), 2) / 0.03;
  const Target target = Target{}.require(Quantity::overshoot, {-Target::infinity, 0.1});
  const Axis axis = logarithmic("controller.proportional", 0.01, 1.0, 5);
  const FeasibleValues found = values(drive, axis, target);
  ASSERT_EQ(found.intervals.size(), 1U);
  EXPECT_EQ(found.intervals[0].low, 0.01);
  constexpr double of_stiffness = 1e-6;
  EXPECT_NEAR(found.intervals[0].high, gain, of_stiffness * gain);
  const Grid grid{.drive = drive, .axes = {linear(axis.path, gain, 2.0 * gain, 2)}};
  const Table table = evaluate(grid, std::array{Quantity::overshoot, Quantity::settling_time});
  EXPECT_NEAR(table[Quantity::overshoot][0], 0.1, of_stiffness);
  const Answer answer = analyse(with(drive, axis.path, 2.0 * gain), {.step = true});
  EXPECT_NEAR(answer.value(Quantity::overshoot).value(), table[Quantity::overshoot][1], 1e-9);
  EXPECT_NEAR(answer.value(Quantity::settling_time).value(), table[Quantity::settling_time][1],
              1e-9);
}

/// The closed form answers without a gap. Its loop has a bandwidth, and no step can be followed.
TEST(EdgeSearchedValues, OfADriveWithoutAGapAreThoseOfItsLoopAndOfNoStep) {
  Drive drive = second_order();
  drive.motor.kind = TorqueControl{};
  drive.gearbox.backlash = 0.1;
  drive.specification.step = 1.0;
  const Axis axis = linear("gearbox.backlash", 0.0, 0.2, 3);
  const FeasibleValues loop =
      values(drive, axis, Target{}.require(Quantity::bandwidth, {0.1, 100.0}));
  EXPECT_EQ(loop.intervals, (std::vector<Bounds>{{0.0, 0.2}}));
  const FeasibleValues step =
      values(drive, axis, Target{}.require(Quantity::overshoot, {0.0, 10.0}));
  ASSERT_EQ(step.intervals.size(), 1U);
  EXPECT_GT(step.intervals[0].low, 0.0);
  EXPECT_EQ(step.intervals[0].high, 0.2);
  EXPECT_EQ(step.undecided, (std::vector<Bounds>{{0.0, step.intervals[0].low}}));
  EXPECT_TRUE(step.borders.empty());
}

TEST(SearchedValues, OfAChoiceAreWords) {
  const Drive drive = pd_drive();
  const FeasibleValues found =
      values(drive, usual_axis(drive, "sensor.position"), always_at_rest());
  EXPECT_EQ(found.grid.size(), 3U);
  for (const double place : found.grid) {
    Drive changed = drive;
    changed.sensor.position = static_cast<SensorPlace>(static_cast<int>(place));
    EXPECT_EQ(found.contains(place), is_met(always_at_rest(), analyse(changed))) << place;
  }
}

TEST(SearchedValues, OfAnUnsoundDriveDoNotMeetATarget) {
  Drive drive = pd_drive();
  drive.load.friction.breakaway = 6e-3;
  const FeasibleValues found =
      values(drive, linear("load.coulomb", 1e-3, 1e-2, 4), Target{.no_runaway = true});
  ASSERT_EQ(found.intervals.size(), 1U);
  EXPECT_LE(found.intervals[0].high, 6e-3);  // above it, breakaway is below Coulomb friction
  EXPECT_NEAR(found.intervals[0].high, 6e-3, 1e-6);
}

TEST(SearchedValues, CanBeStopped) {
  test::Stopping stop(3);
  const Drive drive = pd_drive();
  const FeasibleValues found =
      values(drive, logarithmic("controller.proportional", 0.5, 50.0, 9), always_at_rest(), stop);
  EXPECT_TRUE(found.stopped);
  EXPECT_FALSE(found.undecided.empty());
}

TEST(SearchedValues, AreSoughtByDefaultAboutThePresentValue) {
  const Drive drive = pd_drive();
  const Axis gain = usual_axis(drive, "controller.proportional");
  EXPECT_EQ(gain.values.size(), 26U);
  EXPECT_EQ(gain.values[0], 0.0);
  EXPECT_DOUBLE_EQ(gain.values[1], 0.2);
  EXPECT_DOUBLE_EQ(gain.values.back(), 20.0);
  const Axis ratio = usual_axis(drive, "gearbox.ratio");
  EXPECT_EQ(ratio.values.size(), 25U);  // 0 is not permitted
  EXPECT_DOUBLE_EQ(ratio.values[0], 2.0);
  EXPECT_THAT(usual_axis(drive, "contact.restitution").values.back(), 1.0);
  // Ten times the present value is more than a normal form may have.
  const Drive form = normal_form(200.0, 2.0, 0.15, 0.3);
  EXPECT_THAT(usual_axis(form, "servo.friction_ratio").values.back(), 1.0);
  EXPECT_LE(usual_axis(form, "servo.damping").values.back(), 1000.0);
}

// ---- random tasks -------------------------------------------------------------------------------

struct Task {
  Drive drive;
  Axis axis;
  Target target;
  std::string text;
};

Drive random_drive(SeededDraws& draws) {
  Drive drive = pd_drive();
  const auto vary = [&](double& number, double factor) {
    number *= draws.log_uniform(1.0 / factor, factor);
  };
  vary(drive.motor.inertia, 5.0);
  vary(drive.load.inertia, 5.0);
  vary(drive.motor.friction.viscous, 10.0);
  vary(drive.load.friction.viscous, 10.0);
  vary(drive.motor.friction.coulomb, 10.0);
  vary(drive.load.friction.coulomb, 10.0);
  vary(drive.gearbox.backlash, 10.0);
  auto& law = std::get<PID>(drive.controller.law);
  vary(law.proportional, 5.0);
  vary(law.derivative, 5.0);
  const double kind = draws.uniform(0.0, 3.0);
  if (kind < 1.0) drive.contact = CompliantContact{.stiffness = draws.log_uniform(20.0, 2000.0)};
  if (kind > 2.0) drive.contact = RigidContact{draws.uniform(0.1, 0.9)};
  if (draws.uniform(0.0, 1.0) < 0.5) drive.sensor.position = SensorPlace::motor;
  return drive;
}

Task random_task(SeededDraws& draws) {
  constexpr const char* paths[] = {
      "controller.proportional", "controller.derivative", "gearbox.backlash",
      "gearbox.ratio",           "load.inertia",          "load.coulomb",
      "motor.friction"};
  Task task{.drive = random_drive(draws), .axis = {}, .target = {}, .text = {}};
  task.text = paths[static_cast<std::size_t>(draws.uniform(0.0, std::size(paths)))];
  const double present = get(task.drive, task.text);
  task.axis = logarithmic(task.text, 0.1 * present, 10.0 * present, 13);
  const double backlash = task.drive.gearbox.backlash;
  switch (static_cast<int>(draws.uniform(0.0, 5.0))) {
    case 0:
      task.target.no_hunting = true;
      break;
    case 1:
      task.target = always_at_rest();
      break;
    case 2:
      task.target.require(Quantity::amplitude, {0.0, backlash * draws.log_uniform(0.1, 3.0)});
      break;
    case 3:
      task.target.require(Quantity::ceiling, {0.0, backlash * draws.log_uniform(1.0, 100.0)});
      break;
    default:
      task.target = always_at_rest();
      task.target.require(Quantity::static_error, {0.0, backlash * draws.log_uniform(0.5, 20.0)});
  }
  return task;
}

/// GEARLASH_TASKS=300 asks for more (docs/explanation/verification.md).
int task_count(int usual) {
  const char* asked = std::getenv("GEARLASH_TASKS");
  return asked == nullptr ? usual : std::atoi(asked);
}

TEST(PropertySearchedValues, MeetTheirTargetAndMissNothingWiderThanTheGrid) {
  const int tasks = task_count(10);
  TracedDraws draws(2026);
  int answered = 0;
  for (int i = 0; i < tasks; ++i) {
    const Task task = random_task(draws);
    SCOPED_TRACE(std::to_string(i) + " " + task.text);
    const FeasibleValues found = values(task.drive, task.axis, task.target);
    const auto meets = [&](double value) {
      return is_met(task.target, analyse(with(task.drive, task.text, value), {.ceiling = true}));
    };
    if (!found.intervals.empty()) ++answered;
    for (const Bounds& interval : found.intervals) {
      EXPECT_TRUE(meets(interval.low)) << interval.low;
      EXPECT_TRUE(meets(interval.high)) << interval.high;
    }
    // A run of values, denser than the grid, that meet the target.
    const Axis dense =
        logarithmic(task.text, task.axis.values.front(), task.axis.values.back(), 61);
    std::size_t in_a_row = 0;
    for (const double value : dense.values) {
      const bool is_listed = found.contains(value) ||
                             std::any_of(found.undecided.begin(), found.undecided.end(),
                                         [&](const Bounds& part) { return part.contains(value); });
      in_a_row = meets(value) && !is_listed ? in_a_row + 1 : 0;
      EXPECT_LT(in_a_row, 6U) << value;  // five of them are as wide as the distance on the grid
    }
  }
  EXPECT_GT(answered, tasks / 3);
}

constexpr std::size_t kinds_of_conditions = 5;

Target condition_of(std::size_t kind) {
  constexpr double infinity = Target::infinity;
  switch (kind % kinds_of_conditions) {
    case 0:
      return Target{}.require(Quantity::bandwidth, {0.0, infinity});
    case 1:
      return Target{}.require(Quantity::phase_margin, {-infinity, infinity});
    case 2:
      return Target{}.require(Quantity::overshoot, {-infinity, 1e6});
    case 3:
      return Target{}.require(Quantity::ceiling, {0.0, 1e6});
    default:
      return {.no_runaway = true};
  }
}

Target with_condition(Target target, const Target& condition) {
  target.no_runaway = target.no_runaway || condition.no_runaway;
  for (const QuantityLimit& limit : condition.limits) {
    target.require(limit.quantity, limit.permitted);
  }
  return target;
}

bool is_kept(const Target& condition, const Task& task, double value) {
  const Drive drive = with(task.drive, task.text, value);
  const Wanted wanted = wanted_for(condition);
  if (condition.no_runaway) return is_met(condition, analyse(drive, wanted));
  Answer figures;
  add_figures(drive, wanted, figures, no_progress());
  return is_met(condition, figures);
}

/// At many values of each interval, its ends among them.
bool is_kept(const Target& condition, const Task& task, const std::vector<Bounds>& intervals) {
  constexpr int parts = 16;
  for (const Bounds& interval : intervals) {
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const double value = interval.low * std::pow(interval.high / interval.low, share);
      if (!is_kept(condition, task, std::clamp(value, interval.low, interval.high))) return false;
    }
  }
  return true;
}

/// The target with a condition that all answers keep: of the kinds in turn the first that is one.
std::optional<Target> with_kept_condition(const Task& task, const std::vector<Bounds>& intervals,
                                          std::size_t first_kind) {
  for (std::size_t kind = first_kind; kind < first_kind + kinds_of_conditions; ++kind) {
    const Target condition = condition_of(kind);
    const Target more = with_condition(task.target, condition);
    if (more != task.target && is_kept(condition, task, intervals)) return more;
  }
  return std::nullopt;
}

bool is_of_figures_alone(const Target& target) {
  return target == Target{.limits = target.limits} &&
         std::all_of(target.limits.begin(), target.limits.end(),
                     [](const QuantityLimit& limit) { return is_figure(limit.quantity); });
}

void expect_the_same(const FeasibleValues& both, const FeasibleValues& alone, const Task& task,
                     const Target& more) {
  // What is searched beside figures says so; they are scanned as before.
  EXPECT_EQ(both.kind, more.no_runaway ? SearchKind::searched : alone.kind);
  EXPECT_EQ(both.searched, alone.searched);
  EXPECT_EQ(both.intervals, alone.intervals);
  EXPECT_EQ(both.undecided, alone.undecided);
  if (!is_of_figures_alone(task.target)) {
    EXPECT_EQ(both.grid, alone.grid);
    EXPECT_EQ(both.located, alone.located);
  }
  if (alone.proofs.empty()) return;
  ASSERT_EQ(both.proofs.size(), alone.proofs.size());
  for (std::size_t i = 0; i < alone.proofs.size(); ++i) {
    EXPECT_EQ(both.proofs[i].parts, alone.proofs[i].parts);
  }
}

/// A condition that the answers keep loses no interval, no certainty and no proof. Of a few drives
/// that run away, or whose loop is unstable, no condition is one: the next is drawn.
TEST(PropertySearchedValues, AConditionMoreLosesNothing) {
  const auto tasks = static_cast<std::size_t>(task_count(5));
  TracedDraws draws(4502);
  std::size_t conditions = 0;
  std::size_t answered = 0;
  for (std::size_t drawn = 0; conditions < tasks && drawn < 2 * tasks; ++drawn) {
    const Task task = random_task(draws);
    SCOPED_TRACE(testing::Message() << drawn << " " << task.text);
    const FeasibleValues alone = values(task.drive, task.axis, task.target);
    const std::optional<Target> more = with_kept_condition(task, alone.intervals, drawn);
    if (!more) continue;
    ++conditions;
    if (!alone.intervals.empty()) ++answered;
    expect_the_same(values(task.drive, task.axis, *more), alone, task, *more);
  }
  EXPECT_EQ(conditions, tasks);
  EXPECT_GT(answered, tasks / 3);
}

TEST(EdgeSearchedValues, FaultsAreToldAllAtOnce) {
  Drive drive = pd_drive();
  drive.load.inertia = -1.0;
  Target target;
  target.require(Quantity::amplitude, {0.2, 0.1});
  EXPECT_THAT(faults_of([&] {
                (void)values(drive, Axis{"load.colour", {1.0}}, target);
              }),
              ElementsAre(HasSubstr("load.inertia = -1"), HasSubstr("load.colour"),
                          HasSubstr("must not contradict itself")));
  EXPECT_THAT(faults_of([&] { (void)usual_axis(pd_drive(), "load.colour"); }),
              ElementsAre("parameter = load.colour: must be a number or a choice of this drive"));
}

TEST(EdgeSearchedValues, WhereNothingMeetsATargetThereIsAClosestOne) {
  const Drive drive = pd_drive();
  const Target impossible = Target{}.require(Quantity::amplitude, {1e3, Target::infinity});
  const FeasibleValues found = values(drive, linear("load.inertia", 1e-3, 1e-2, 3), impossible);
  EXPECT_TRUE(found.intervals.empty());
  ASSERT_TRUE(found.closest);
  EXPECT_TRUE(found.searched.contains(*found.closest));
}

}  // namespace
}  // namespace gearlash::analysed_values_test
