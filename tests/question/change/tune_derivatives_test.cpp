// The derivatives that lead a tuning, beside differences of what is analysed.
#include "question/change/tune_derivatives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"
#include "question/axis.hpp"
#include "question/loop/linear_loop.hpp"
#include "question/pd_drive.hpp"
#include "question/series/toleranced_samples.hpp"

namespace gearlash::tune_derivatives_test {
namespace {

TuneTask hunting_task() {
  TuneTask task{.series = {pd_drive(), {}},
                .tuned = {logarithmic("controller.proportional", 2.0, 200.0, 2),
                          linear("controller.derivative", 0.01, 0.1, 2)},
                .least_phase_margin = 0.3};
  set(task.series.nominal, "controller.proportional", 60.0);
  task.target.require(Quantity::amplitude, {1e-4, 1e-3});
  task.target.require(Quantity::frequency, {0.0, 40.0});
  task.target.require(Quantity::bandwidth, {5.0, Target::infinity});
  return task;
}

/// −ln bandwidth, then what is limited, in their order.
std::vector<double> numbers_of(const Drive& drive) {
  const auto loop = drive::loop_figures(reduce(drive)).value();
  const Answer answer = analyse(drive, {.proofs = false});
  const double bandwidth = loop.bandwidth.value();
  const double amplitude = answer.value(Quantity::amplitude).value();
  return {-std::log(bandwidth),
          (0.3 - loop.phase_margin.value()) / 0.3,
          (5.0 - bandwidth) / 5.0,
          (amplitude - 1e-3) / 1e-3,
          (1e-4 - amplitude) / 1e-4,
          (answer.value(Quantity::frequency).value() - 40.0) / 40.0,
          0.0 - answer.value(Quantity::frequency).value()};
}

TEST(OracleTunedSlopes, AgreeWithDifferences) {
  const TuneTask task = hunting_task();
  const Drive& drive = task.series.nominal;
  ASSERT_TRUE(may_have_slopes(task));
  const auto found = slopes_of_unit(drive, task, no_progress());
  ASSERT_TRUE(found);
  std::vector<SlopedNumber> all = found->sizes;
  all.insert(all.end(), found->limited.begin(), found->limited.end());
  const std::vector<double> values = numbers_of(drive);
  ASSERT_EQ(all.size(), values.size());
  for (std::size_t axis = 0; axis < task.tuned.size(); ++axis) {
    constexpr double step = 1e-4;
    const double position =
        position_on(task.tuned[axis], present_value(task.tuned[axis], drive).value());
    const auto beside = [&](double away) {
      Drive changed = drive;
      set_on(task.tuned[axis], changed, value_at(task.tuned[axis], position + away));
      return numbers_of(changed);
    };
    const std::vector<double> above = beside(step);
    const std::vector<double> below = beside(-step);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_NEAR(all[i].value, values[i], 1e-9 * std::abs(values[i])) << i;
      const double slope = 0.5 * (above[i] - below[i]) / step;
      EXPECT_NEAR(all[i].slopes[axis], slope, 1e-5 * (std::abs(slope) + 1e-3)) << i << ' ' << axis;
    }
  }
}

TEST(TunedSlopes, AreThereWhereTheMotionHasThem) {
  TuneTask task = hunting_task();
  task.target.no_hunting = true;
  EXPECT_FALSE(may_have_slopes(task));  // no theorem gives the growth at rest of a searched drive
  task.series.nominal = sample_data_sheet();
  EXPECT_TRUE(may_have_slopes(task));
  task.target.require(Quantity::static_error, {0.0, 1e-3});
  EXPECT_FALSE(may_have_slopes(task));
  TuneTask of_drive = hunting_task();
  of_drive.aim = Aim::settling;
  EXPECT_FALSE(may_have_slopes(of_drive));
  of_drive = hunting_task();
  of_drive.series.nominal.sampling = Sampling{.period = 1e-3};
  EXPECT_FALSE(may_have_slopes(of_drive));
  of_drive = hunting_task();
  of_drive.series.nominal.sensor.encoder.resolution = 1e-3;
  EXPECT_FALSE(slopes_of_unit(of_drive.series.nominal, of_drive, no_progress()));
}

/// At rest the limits of a motion are far, and level.
TEST(TunedSlopes, OfADriveThatRestsAreThoseOfItsLoop) {
  TuneTask task = hunting_task();
  task.target.limits.clear();
  task.target.require(Quantity::amplitude, {0.0, 1e-3});
  set(task.series.nominal, "controller.proportional", 2.0);
  const auto found = slopes_of_unit(task.series.nominal, task, no_progress());
  ASSERT_TRUE(found);
  ASSERT_EQ(found->limited.size(), 2U);
  EXPECT_EQ(found->limited[1].value, -1.0);
  EXPECT_EQ(found->limited[1].slopes, (std::vector{0.0, 0.0}));
  EXPECT_NE(found->sizes[0].slopes[0], 0.0);
  task.target.require(Quantity::amplitude, {1e-4, 1e-3});
  EXPECT_FALSE(slopes_of_unit(task.series.nominal, task, no_progress()));
}

}  // namespace
}  // namespace gearlash::tune_derivatives_test
