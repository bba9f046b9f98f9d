// The public face of charts: what is looked up is what analyse() answers, to the error stated.
#include "gearlash/chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "analysis/faults_of.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"

namespace gearlash::chart_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Grid sample_grid() {
  return {.drive = normal_form(0.1, 1.0, 0.1, 0.3),
          .axes = {linear("servo.damping", 0.05, 0.7, 60),
                   logarithmic("servo.inertia_ratio", 1.0 / 9.0, 9.0, 60)}};
}

Answer exact_at(double damping, double inertia_ratio) {
  return analyse(normal_form(damping, inertia_ratio, 0.1, 0.3), {.proofs = false});
}

TEST(Chart, AnswersAsAnalyseDoes) {
  const DesignChart chart(sample_grid(), Quantity::amplitude);
  EXPECT_EQ(chart.quantity(), Quantity::amplitude);
  EXPECT_EQ(chart.grid().axes, sample_grid().axes);
  EXPECT_LE(chart.accuracy().stated_error, 1e-3);
  int interpolated = 0;
  for (const double damping : {0.0613, 0.123, 0.19, 0.271, 0.33}) {
    for (const double inertia_ratio : {0.2, 0.77, 2.0, 6.1}) {
      const ChartAnswer answer = chart.look_up({damping, inertia_ratio});
      const Answer exact = exact_at(damping, inertia_ratio);
      EXPECT_EQ(answer.verdict, exact.verdict);
      ASSERT_EQ(answer.value.has_value(), exact.largest_stable() != nullptr);
      if (!answer.value) continue;
      const double amplitude = exact.largest_stable()->amplitude;
      EXPECT_NEAR(*answer.value, amplitude, (answer.error.value() + 1e-13) * amplitude);
      interpolated += answer.source == ChartSource::interpolated;
    }
  }
  EXPECT_GT(interpolated, 10);
}

TEST(Chart, WithoutToleranceIsSolvedAndCopiesShareIt) {
  const DesignChart chart(sample_grid(), Quantity::amplitude, {.tolerance = 0.0});
  const DesignChart copy = chart;
  const ChartAnswer answer = copy.look_up({0.19, 2.0});
  EXPECT_EQ(answer, chart.look_up({0.19, 2.0}));
  EXPECT_EQ(answer.source, ChartSource::solved);
  EXPECT_STREQ(name_of(answer.source), "solved");
  EXPECT_EQ(answer.error, 0.0);
  EXPECT_NEAR(answer.value.value(), exact_at(0.19, 2.0).largest_stable()->amplitude, 1e-14);
}

TEST(Chart, WhereThereIsNoAnswerItIsEmpty) {
  Grid grid = sample_grid();
  set(grid.drive, "servo.friction_ratio", 0.5);
  const DesignChart chart(grid, Quantity::amplitude);
  const ChartAnswer quiet = chart.look_up({0.69, 1.0});
  EXPECT_EQ(quiet.verdict, Verdict::cannot_hunt);
  EXPECT_FALSE(quiet.value);
  for (const double outside : {0.8, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(chart.look_up({outside, 1.0}), ChartAnswer{});
  }
}

using test::faults_of;

TEST(EdgeChart, BadInputIsAFault) {
  const auto built = [](const Grid& grid, double tolerance = 1e-3) {
    return faults_of([&] { DesignChart(grid, Quantity::amplitude, {.tolerance = tolerance}); });
  };
  Grid misspelt = sample_grid();
  misspelt.axes[0].path = "servo.dumping";
  EXPECT_THAT(built(misspelt), ElementsAre(HasSubstr("servo.dumping")));
  Grid short_axis = sample_grid();
  short_axis.axes[1].values.resize(3);
  EXPECT_THAT(built(short_axis), ElementsAre(HasSubstr("axis 2 = 3 values: must be at least 4")));
  EXPECT_THAT(built(sample_grid(), -1.0), ElementsAre(HasSubstr("tolerance = -1")));
  const DesignChart chart(sample_grid(), Quantity::amplitude);
  EXPECT_THAT(faults_of([&] { (void)chart.look_up({0.1}); }),
              ElementsAre("place = 1 values: must be 2, one for each axis"));
}

}  // namespace
}  // namespace gearlash::chart_test
