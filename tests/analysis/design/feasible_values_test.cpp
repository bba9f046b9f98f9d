// Feasible values: put back they meet the target, and a scan finds no others.
#include "analysis/design/feasible_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/design/drives.hpp"
#include "analysis/design/target.hpp"
#include "base/range_check.hpp"
#include "base/traced_draws.hpp"

namespace gearlash::feasible_values_test {
namespace {

/// The servo of the thesis's sample problem, about.
ChangeableDrive sample_drive() {
  return changeable(NormalizedServo{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3});
}

Target at_most(double size) {
  Target target;
  target.require(Quantity::amplitude, {0.0, size});
  return target;
}
Target no_hunting() {
  Target target;
  target.no_hunting = true;
  return target;
}
Target at_least_as_fast_as(double frequency) {
  Target target;
  target.require(Quantity::frequency, {frequency, Target::infinity});
  return target;
}

TEST(FeasibleValues, OfBacklashAreInProportionToTheSize) {
  const FeasibleValues found = feasible_values(sample_drive(), "backlash", at_most(0.1));
  ASSERT_EQ(found.intervals.size(), 1U);
  const double size = performance_of(sample_drive().drivetrain()).amplitude;
  EXPECT_NEAR(found.intervals[0].high, 0.3 * 0.1 / size, 1e-15);
  EXPECT_EQ(found.nearest(), found.intervals[0].high);
  EXPECT_FALSE(found.contains(0.3));
}

TEST(FeasibleValues, NoBacklashEndsHunting) {
  const FeasibleValues found = feasible_values(sample_drive(), "backlash", no_hunting());
  EXPECT_TRUE(found.intervals.empty());
  EXPECT_FALSE(found.nearest());
  EXPECT_EQ(found.kind, SearchKind::certified);
}

TEST(FeasibleValues, MayBeSeveralIntervals) {
  const FeasibleValues ratio = feasible_values(sample_drive(), "gear_ratio", no_hunting());
  EXPECT_EQ(ratio.intervals.size(), 2U);  // a very small one, and a very large one
  const FeasibleValues inertia =
      feasible_values(sample_drive(), "load_inertia", at_least_as_fast_as(0.16));
  EXPECT_EQ(inertia.intervals.size(), 2U);  // no hunting at all, and hunting fast
}

TEST(FeasibleValues, AMetTargetHasThePresentValue) {
  const FeasibleValues found = feasible_values(sample_drive(), "error_gain", at_most(1.0));
  EXPECT_TRUE(found.contains(1.0));
  EXPECT_EQ(found.nearest(), 1.0);
}

ChangeableDrive bouncing_drive() {
  return changeable(NormalizedServo{.damping = 0.3,
                                    .inertia_ratio = 2.0,
                                    .friction_ratio = 0.3,
                                    .backlash = 0.3,
                                    .restitution = 0.1});
}

TEST(FeasibleValues, OfBacklashWithBouncesAreInProportionToTheSizeToo) {
  const double size = performance_of(bouncing_drive().drivetrain()).amplitude;
  const FeasibleValues found = feasible_values(bouncing_drive(), "backlash", at_most(0.5 * size));
  EXPECT_EQ(found.kind, SearchKind::scanned);
  ASSERT_EQ(found.intervals.size(), 1U);
  EXPECT_NEAR(found.intervals[0].high, 0.15, 1e-14);
}

TEST(FeasibleValues, WithBouncesEndWhereGrowthAtRestPassesOne) {
  const FeasibleValues found = feasible_values(bouncing_drive(), "load_friction", no_hunting());
  ASSERT_FALSE(found.intervals.empty());
  const double end = found.intervals[0].low;
  const auto growth_at = [](double value) {
    return performance_of(bouncing_drive().with("load_friction", value)).growth_at_rest;
  };
  EXPECT_LT(growth_at(end), 1.0);
  EXPECT_GT(growth_at(end), 1.0 - 2e-6);
  EXPECT_TRUE(found.contains(end));
}

TEST(FeasibleValues, ThatDoNotExistHaveAClosestOne) {
  Target enormous;
  enormous.require(Quantity::amplitude, {100.0, Target::infinity});
  const FeasibleValues found = feasible_values(sample_drive(), "load_inertia", enormous);
  EXPECT_TRUE(found.intervals.empty());
  ASSERT_TRUE(found.closest.has_value());
  const auto amplitude_at = [](double value) {
    return performance_of(sample_drive().with("load_inertia", value)).amplitude;
  };
  for (const double value : {found.searched.low, 0.01, 0.1, 1.0, 10.0, found.searched.high}) {
    EXPECT_GE(amplitude_at(*found.closest), amplitude_at(value)) << value;
  }
}

/// A drive, a parameter and a target, all at random.
struct Task {
  NormalizedServo servo;
  std::string_view parameter;
  Target target;
};

Task drawn_task(SeededDraws& draws) {
  Task task{.servo = {.damping = draws.log_uniform(0.02, 2.0),
                      .inertia_ratio = draws.log_uniform(0.03, 30.0),
                      .friction_ratio = draws.uniform(0.02, 0.98),
                      .backlash = draws.log_uniform(1e-3, 1.0)},
            .parameter = all_parameters[static_cast<std::size_t>(draws.uniform(0.0, 8.0))],
            .target = {}};
  switch (static_cast<int>(draws.uniform(0.0, 4.0))) {
    case 0:
      task.target.no_hunting = true;
      break;
    case 1:
      task.target = at_most(task.servo.backlash * draws.log_uniform(0.01, 3.0));
      break;
    case 2:
      task.target = at_least_as_fast_as(draws.uniform(0.02, 0.2));
      break;
    default:
      task.target = at_least_as_fast_as(draws.uniform(0.02, 0.15));
      task.target.require(Quantity::amplitude,
                          {0.0, task.servo.backlash * draws.log_uniform(0.03, 3.0)});
  }
  return task;
}

std::string describe(const Task& task) {
  const NormalizedServo& servo = task.servo;
  return std::string(task.parameter) + " of damping " + exact_text(servo.damping) +
         " inertia_ratio " + exact_text(servo.inertia_ratio) + " friction_ratio " +
         exact_text(servo.friction_ratio) + " backlash " + exact_text(servo.backlash) +
         " for size <= " + exact_text(task.target.permitted(Quantity::amplitude).high) +
         ", frequency >= " + exact_text(task.target.permitted(Quantity::frequency).low) +
         (task.target.no_hunting ? ", no hunting" : "");
}

struct Scan {
  int met = 0;      ///< values that are feasible
  int slivers = 0;  ///< undecided parts
};

/// Every interval's ends meet the target and what is beyond does not; of `values` values over the
/// range those are feasible that meet it.
void scan(const Task& task, int values, Scan& found_so_far) {
  SCOPED_TRACE(describe(task));
  const ChangeableDrive drive = changeable(task.servo);
  const FeasibleValues found = feasible_values(drive, task.parameter, task.target);
  EXPECT_EQ(found.kind, SearchKind::certified);
  for (const Bounds& sliver : found.undecided) {
    EXPECT_LT(sliver.high - sliver.low, 1e-4 * sliver.high);
    ++found_so_far.slivers;
  }
  const auto is_met_at = [&](double value) {
    return is_met(task.target, performance_of(drive.with(task.parameter, value)));
  };
  for (const Bounds& interval : found.intervals) {
    EXPECT_TRUE(is_met_at(interval.low)) << interval.low;
    EXPECT_TRUE(is_met_at(interval.high)) << interval.high;
    // The next number beyond does not, but for rounding; unless it is of the next interval: hunting
    // that is too slow may be left between two for a billionth of the parameter.
    constexpr double step = 1e-8;
    for (const double beyond : {interval.low * (1.0 - step), interval.high * (1.0 + step)}) {
      const bool is_searched = beyond > found.searched.low && beyond < found.searched.high;
      EXPECT_TRUE(!is_searched || found.contains(beyond) || !is_met_at(beyond)) << beyond;
    }
  }
  if (found.searched.high == 0.0) return;  // the mass that there is none of
  const double low = std::max(found.searched.low, 1e-6 * found.searched.high);
  for (int k = 0; k <= values; ++k) {
    const double value = low * std::pow(found.searched.high / low, static_cast<double>(k) / values);
    if (value > found.searched.high) continue;
    ASSERT_EQ(found.contains(value), is_met_at(value)) << task.parameter << value;
    found_so_far.met += found.contains(value) ? 1 : 0;
  }
}

TEST(PropertyFeasibleValues, AScanFindsNoOthers) {
  TracedDraws draws(500);
  constexpr int tasks = 500;
  constexpr int values = 400;
  Scan all;
  for (int i = 0; i < tasks; ++i) {
    SCOPED_TRACE(i);
    scan(drawn_task(draws), values, all);
  }
  EXPECT_GT(all.met, tasks * values / 10);
  RecordProperty("slivers", all.slivers);
  EXPECT_LT(all.slivers, tasks / 20);
}

TEST(PropertyFeasibleValues, AScanFindsNoOthersOfMasslessSides) {
  TracedDraws draws(501);
  constexpr int tasks = 200;
  constexpr int values = 400;
  Scan all;
  for (int i = 0; i < tasks; ++i) {
    SCOPED_TRACE(i);
    Task task = drawn_task(draws);
    task.servo.inertia_ratio = i % 2 == 0 ? 0.0 : std::numeric_limits<double>::infinity();
    scan(task, values, all);
  }
  EXPECT_GT(all.met, tasks * values / 10);
  RecordProperty("slivers", all.slivers);
  EXPECT_LT(all.slivers, tasks / 20);
}

TEST(PropertyFeasibleValues, AScanFindsNoOthersWithBounces) {
  TracedDraws draws(45);
  constexpr int tasks = 5;
  constexpr int scanned = 30;
  int met = 0;
  for (int i = 0; i < tasks; ++i) {
    SCOPED_TRACE(i);
    Task task = drawn_task(draws);
    task.servo.damping = draws.log_uniform(0.1, 0.6);
    task.servo.inertia_ratio = draws.log_uniform(0.3, 3.0);
    task.servo.restitution = draws.uniform(0.05, 0.3);
    task.parameter = all_parameters[2 * static_cast<std::size_t>(i)];
    const ChangeableDrive drive = changeable(task.servo);
    const FeasibleValues found = feasible_values(drive, task.parameter, task.target);
    EXPECT_TRUE(found.undecided.empty());
    const auto is_met_at = [&](double value) {
      return is_met(task.target, performance_of(drive.with(task.parameter, value)));
    };
    for (const Bounds& interval : found.intervals) {
      EXPECT_TRUE(is_met_at(interval.low)) << interval.low;
      EXPECT_TRUE(is_met_at(interval.high)) << interval.high;
    }
    // Within a factor of ten of the present value: farther off a search for cycles takes long.
    const double low = std::max(found.searched.low, 0.1 * found.present);
    const double high = std::min(found.searched.high, 10.0 * found.present + 0.5);
    for (int k = 0; k <= scanned; ++k) {
      const double value = low + (high - low) * k / scanned;
      ASSERT_EQ(found.contains(value), is_met_at(value)) << task.parameter << value;
      met += found.contains(value) ? 1 : 0;
    }
  }
  EXPECT_GT(met, tasks * scanned / 10);
  EXPECT_LT(met, tasks * scanned * 9 / 10);
}

TEST(EdgeFeasibleValues, BesideAShaftWithoutFrictionAreFound) {
  const ChangeableDrive drive = changeable(NormalizedServo{
      .damping = 0.2, .inertia_ratio = 2.0, .friction_ratio = 0.0, .backlash = 0.3});
  for (const std::string_view parameter : all_parameters) {
    if (parameter == "restitution") continue;
    const FeasibleValues found = feasible_values(drive, parameter, no_hunting());
    EXPECT_EQ(found.intervals.empty(), parameter != "load_friction")
        << parameter;  // without friction at the load nothing else ends it
  }
}

TEST(EdgeTarget, ContradictionsAreFaults) {
  Target target = at_most(0.1);
  target.require(Quantity::amplitude, {0.2, Target::infinity});
  target.require(Quantity::frequency, {5.0, 4.0});
  EXPECT_EQ(faults(target).size(), 2U);
  target = always_at_rest();
  target.require(Quantity::amplitude, {0.1, Target::infinity});
  EXPECT_EQ(faults(target).size(), 1U);
  EXPECT_TRUE(faults(no_hunting()).empty());
}

}  // namespace
}  // namespace gearlash::feasible_values_test
