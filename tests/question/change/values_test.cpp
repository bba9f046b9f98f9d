// Feasible values: put back they meet the target, and a scan finds no others.
#include "question/change/values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/range_check.hpp"
#include "base/traced_draws.hpp"
#include "question/axis.hpp"
#include "question/change/drives.hpp"
#include "question/change/target.hpp"

namespace gearlash::values_test {
namespace {

/// The servo of the thesis's sample problem, about.
Drive sample_drive() {
  return drive_of(NormalizedServo{
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
  const FeasibleValues found = values(sample_drive(), "backlash", at_most(0.1));
  ASSERT_EQ(found.intervals.size(), 1U);
  const double size = amplitude_in(closed_answer(sample_drive()));
  EXPECT_NEAR(found.intervals[0].high, 0.3 * 0.1 / size, 1e-15);
  EXPECT_EQ(found.nearest(), found.intervals[0].high);
  EXPECT_FALSE(found.contains(0.3));
}

TEST(FeasibleValues, NoBacklashEndsHunting) {
  const FeasibleValues found = values(sample_drive(), "backlash", no_hunting());
  EXPECT_TRUE(found.intervals.empty());
  EXPECT_FALSE(found.nearest());
  EXPECT_EQ(found.kind, SearchKind::certified);
}

TEST(FeasibleValues, MayBeSeveralIntervals) {
  const FeasibleValues ratio = values(sample_drive(), "gearbox.ratio", no_hunting());
  EXPECT_EQ(ratio.intervals.size(), 2U);  // a very small one, and a very large one
  const FeasibleValues inertia = values(sample_drive(), "load.inertia", at_least_as_fast_as(0.16));
  EXPECT_EQ(inertia.intervals.size(), 2U);  // no hunting at all, and hunting fast
}

TEST(FeasibleValues, AMetTargetHasThePresentValue) {
  const FeasibleValues found = values(sample_drive(), "controller.proportional", at_most(1.0));
  EXPECT_TRUE(found.contains(1.0));
  EXPECT_EQ(found.nearest(), 1.0);
}

Drive bouncing_drive() {
  return drive_of(NormalizedServo{.damping = 0.3,
                                  .inertia_ratio = 2.0,
                                  .friction_ratio = 0.3,
                                  .backlash = 0.3,
                                  .restitution = 0.1});
}

TEST(FeasibleValues, OfBacklashWithBouncesAreInProportionToTheSizeToo) {
  const double size = amplitude_in(closed_answer(bouncing_drive()));
  const FeasibleValues found = values(bouncing_drive(), "backlash", at_most(0.5 * size));
  EXPECT_EQ(found.kind, SearchKind::scanned);
  ASSERT_EQ(found.intervals.size(), 1U);
  EXPECT_NEAR(found.intervals[0].high, 0.15, 1e-14);
}

TEST(FeasibleValues, WithBouncesEndWhereGrowthAtRestPassesOne) {
  const FeasibleValues found = values(bouncing_drive(), "load.friction", no_hunting());
  ASSERT_FALSE(found.intervals.empty());
  const double end = found.intervals[0].low;
  const auto growth_at = [](double value) {
    return line_of(bouncing_drive(), "load.friction").growth_at(value);
  };
  EXPECT_LT(growth_at(end), 1.0);
  EXPECT_GT(growth_at(end), 1.0 - 2e-6);
  EXPECT_TRUE(found.contains(end));
}

TEST(FeasibleValues, ThatDoNotExistHaveAClosestOne) {
  Target enormous;
  enormous.require(Quantity::amplitude, {100.0, Target::infinity});
  const FeasibleValues found = values(sample_drive(), "load.inertia", enormous);
  EXPECT_TRUE(found.intervals.empty());
  ASSERT_TRUE(found.closest.has_value());
  const auto amplitude_at = [](double value) {
    return amplitude_in(line_of(sample_drive(), "load.inertia").answer_at(value));
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
  const Drive drive = drive_of(task.servo);
  const FeasibleValues found = gearlash::values(drive, task.parameter, task.target);
  EXPECT_EQ(found.kind, SearchKind::certified);
  for (const Bounds& sliver : found.undecided) {
    EXPECT_LT(sliver.high - sliver.low, 1e-4 * sliver.high);
    ++found_so_far.slivers;
  }
  const auto is_met_at = [&](double value) {
    return is_met(task.target, line_of(drive, task.parameter).answer_at(value));
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
    const Drive drive = drive_of(task.servo);
    const FeasibleValues found = values(drive, task.parameter, task.target);
    EXPECT_TRUE(found.undecided.empty());
    const auto is_met_at = [&](double value) {
      return is_met(task.target, line_of(drive, task.parameter).answer_at(value));
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

/// One of five conditions that nearly every drive keeps.
QuantityLimit loose_limit(std::size_t kind) {
  constexpr double loose = 1e6;
  switch (kind) {
    case 0:
      return {Quantity::bandwidth, {1.0 / loose, Target::infinity}};
    case 1:
      return {Quantity::phase_margin, {1.0 / loose, Target::infinity}};
    case 2:
      return {Quantity::ceiling, {0.0, loose}};
    default:
      return {Quantity::overshoot, {-Target::infinity, loose}};
  }
}

/// What the condition took away misses it, at a value that is looked at by itself.
void expect_missed(const Drive& drive, std::string_view parameter, const Bounds& interval,
                   const FeasibleValues& narrowed, const Target& target) {
  const Axis axis{.path = std::string(parameter)};
  constexpr int values = 40;
  for (int i = 0; i <= values; ++i) {
    const double value = interval.low + (interval.high - interval.low) * i / values;
    if (narrowed.contains(value)) continue;
    Drive changed = drive;
    set_on(axis, changed, value);
    EXPECT_FALSE(is_met(target, analyse(changed, wanted_for(target)))) << value;
  }
}

// A condition that the answers keep loses no proof, no range and no interval.
TEST(PropertyFeasibleValues, AConditionMoreLosesNothing) {
  TracedDraws draws(4501);
  constexpr std::size_t tasks = 200;
  constexpr std::size_t kinds = 4;
  constexpr std::size_t steps = 40;  // one in forty is on a step, which takes milliseconds a value
  std::size_t same = 0;
  for (std::size_t i = 0; i < tasks && !testing::Test::HasFailure(); ++i) {
    const Task task = drawn_task(draws);
    SCOPED_TRACE(testing::Message() << i << " " << describe(task));
    const Drive drive = drive_of(task.servo);
    const FeasibleValues alone = values(drive, task.parameter, task.target);
    Target more = task.target;
    if (i % steps != 0 && i % kinds == 3) {
      more.no_runaway = true;
    } else {
      more.limits.push_back(loose_limit(i % steps == 0 ? 3 : i % kinds));
    }
    const FeasibleValues both = values(drive, task.parameter, more);
    EXPECT_EQ(both.kind, alone.kind);
    EXPECT_EQ(both.searched, alone.searched);
    if (both.intervals == alone.intervals) {
      ++same;
      continue;
    }
    for (const Bounds& interval : alone.intervals) {
      expect_missed(drive, task.parameter, interval, both, more);
    }
  }
  RecordProperty("the same intervals", std::to_string(same));
  EXPECT_GT(same, tasks * 9 / 10);
}

TEST(EdgeFeasibleValues, BesideAShaftWithoutFrictionAreFound) {
  const Drive drive = drive_of(NormalizedServo{
      .damping = 0.2, .inertia_ratio = 2.0, .friction_ratio = 0.0, .backlash = 0.3});
  for (const std::string_view parameter : all_parameters) {
    if (parameter == "contact.restitution") continue;
    const FeasibleValues found = values(drive, parameter, no_hunting());
    EXPECT_EQ(found.intervals.empty(), parameter != "load.friction")
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
}  // namespace gearlash::values_test
