// The scan of one parameter's values, of targets whose answers are known.
#include "question/change/value_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/traced_draws.hpp"

namespace gearlash::value_scan_test {
namespace {

/// Meets the target within some intervals, and is missed by the distance to the nearest of them.
JudgedValue judged(double value, const std::vector<Bounds>& met) {
  JudgedValue result{.value = value, .moves = true, .beyond = Target::infinity};
  for (const Bounds& interval : met) {
    const double outside = std::max(interval.low - value, value - interval.high);
    result.beyond = std::min(result.beyond, outside);
  }
  result.is_met = result.beyond <= 0.0;
  result.beyond_limits = result.beyond;
  return result;
}

FeasibleValues scanned(const Judge& judge, const std::vector<double>& first, const ScanPlan& plan,
                       const Resolution& resolution) {
  const std::vector<JudgedValue> tried = tried_between(judged_values(judge, first), judge, plan);
  FeasibleValues found;
  put_together(
      parts_between(tried), [&](double value) { return judge(value).is_met; },
      [&](double met, double unmet) { return last_met(judge, met, unmet, resolution); }, found);
  return found;
}

std::vector<double> whole_numbers(int last) {
  std::vector<double> values;
  for (int i = 0; i <= last; ++i) values.push_back(i);
  return values;
}

constexpr Resolution fine{.smooth = 1e-12, .at_jump = 1e-6};

TEST(ValueScan, FindsEveryIntervalThatIsWiderThanItsGrid) {
  TracedDraws draws(1960);
  for (int i = 0; i < 300; ++i) {
    std::vector<Bounds> met;
    for (double from = draws.uniform(0.1, 3.0); from < 17.0; from += draws.uniform(1.1, 4.0)) {
      met.push_back({from, from + draws.uniform(1.1, 3.0)});
      from = met.back().high;
    }
    const FeasibleValues found =
        scanned([&](double value) { return judged(value, met); }, whole_numbers(20), {}, fine);
    ASSERT_EQ(found.intervals.size(), met.size()) << i;
    for (std::size_t k = 0; k < met.size(); ++k) {
      // Each end is the last number that meets the target.
      EXPECT_GE(found.intervals[k].low, met[k].low) << i;
      EXPECT_NEAR(found.intervals[k].low, met[k].low, 1e-9) << i;
      EXPECT_LE(found.intervals[k].high, std::min(20.0, met[k].high)) << i;
      EXPECT_NEAR(found.intervals[k].high, std::min(20.0, met[k].high), 1e-9) << i;
    }
    EXPECT_TRUE(found.undecided.empty()) << i;
  }
}

TEST(ValueScan, LooksCloserNearALimit) {
  // Between 6 and 7 the limit is touched from 6.42 to 6.58.
  const std::vector<Bounds> met = {{6.42, 6.58}};
  const Judge judge = [&](double value) { return judged(value, met); };
  EXPECT_TRUE(scanned(judge, whole_numbers(20), {.most_halvings = 0}, fine).intervals.empty());
  const FeasibleValues found = scanned(judge, whole_numbers(20), {}, fine);
  ASSERT_EQ(found.intervals.size(), 1U);
  EXPECT_NEAR(found.intervals[0].low, 6.42, 1e-9);
  EXPECT_EQ(closest_of(tried_values(judge, whole_numbers(20))), 6.5);
}

TEST(ValueScan, LeavesOpenWhatIsUnknown) {
  const FeasibleValues found = scanned(
      [](double value) {
        JudgedValue result = judged(value, {{2.5, 20.0}});
        if (value > 10.3 && value < 12.6) result.is_known = result.is_met = false;
        return result;
      },
      whole_numbers(20), {}, fine);
  ASSERT_EQ(found.intervals.size(), 2U);
  ASSERT_EQ(found.undecided.size(), 1U);
  EXPECT_EQ(found.intervals[0].high, found.undecided[0].low);
  EXPECT_EQ(found.intervals[1].low, found.undecided[0].high);
  EXPECT_LE(found.undecided[0].low, 10.3);
  EXPECT_GE(found.undecided[0].high, 12.6);
  EXPECT_LT(found.undecided[0].high - found.undecided[0].low, 2.6);
}

TEST(ValueScan, LocatesAJumpNoFurtherThanIsWorthIt) {
  std::size_t calls = 0;
  const Judge jump = [&](double value) {
    ++calls;
    return JudgedValue{.value = value, .is_met = value < 3.3, .beyond = value < 3.3 ? -1.0 : 1.0};
  };
  const LastMet last = last_met(jump, 3.0, 4.0, {.smooth = 1e-12, .at_jump = 1e-3});
  EXPECT_LT(last.value, 3.3);
  EXPECT_GE(last.first_unmet, 3.3);
  EXPECT_LE(last.first_unmet - last.value, 1e-3 * 3.3);
  EXPECT_LT(calls, 20U);
  // The ends are known, whatever is found there again.
  const Judge forgetful = [](double value) {
    const bool is_met = value < 3.3 && value != 3.0;
    return JudgedValue{.value = value, .is_met = is_met, .beyond = is_met ? -1.0 : 1.0};
  };
  EXPECT_NEAR(last_met(forgetful, 3.0, 4.0, {.smooth = 1e-12, .at_jump = 1e-3}).value, 3.3, 4e-3);
  // About 0 a relative distance is never reached.
  const Judge at_zero = [](double value) {
    return JudgedValue{.value = value, .is_met = value <= 0.0, .beyond = value <= 0.0 ? -1.0 : 1.0};
  };
  const LastMet zero =
      last_met(at_zero, 0.0, 1.0, {.smooth = 1e-9, .at_jump = 1e-3, .least = 1e-4});
  EXPECT_EQ(zero.value, 0.0);
  EXPECT_LE(zero.first_unmet, 1e-4);
}

}  // namespace
}  // namespace gearlash::value_scan_test
