// Cubics between the values of a table: exact for what is cubic, on every kind of axis.
#include "analysis/grid/cubic_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/seeded_draws.hpp"

namespace gearlash::cubic_table_test {
namespace {

double cubic(double s) { return ((0.7 * s - 1.1) * s + 0.3) * s + 2.0; }

const Axis even{"servo.friction_ratio", {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}};
const Axis uneven{"servo.damping", {0.1, 0.15, 0.4, 0.5, 0.9}};
const Axis even_logarithms{"servo.inertia_ratio", {0.125, 0.25, 0.5, 1.0, 2.0, 4.0}, true};
const Axis uneven_logarithms{"servo.backlash", {0.25, 0.5, 2.0, 3.0}, true};

double place_on(const Axis& axis, double value) {
  return axis.logarithmic ? std::log(value) : value;
}

TEST(OracleCubicTable, IsExactForCubicsOnOneAxis) {
  SeededDraws draws(901);
  for (const Axis& axis : {even, uneven, even_logarithms, uneven_logarithms}) {
    SCOPED_TRACE(axis.path);
    std::vector<double> values;
    for (const double value : axis.values) values.push_back(cubic(place_on(axis, value)));
    const CubicTable table({axis}, values);
    for (int i = 0; i < 200; ++i) {
      const double value = draws.uniform(axis.values.front(), axis.values.back());
      const CubicPlace place = table.axes().front().at(value);
      // Of a few dozen operations with weights up to 4 and values up to 9.
      EXPECT_NEAR(table.at({&place, 1}), cubic(place_on(axis, value)), 1e-14) << value;
    }
  }
}

TEST(OracleCubicTable, IsExactForProductsOfCubics) {
  const std::vector<Axis> axes = {uneven, even_logarithms, even, uneven_logarithms};
  std::vector<double> values;
  for (const double a : axes[0].values) {
    for (const double b : axes[1].values) {
      for (const double c : axes[2].values) {
        for (const double d : axes[3].values) {
          values.push_back(cubic(a) * cubic(std::log(b)) * cubic(c) * cubic(-std::log(d)));
        }
      }
    }
  }
  const CubicTable table(axes, values);
  const std::array place = {0.33, 0.21, 0.91, 2.9};
  std::array<CubicPlace, 4> places;
  for (std::size_t axis = 0; axis < 4; ++axis) places[axis] = table.axes()[axis].at(place[axis]);
  const double exact =
      cubic(place[0]) * cubic(std::log(place[1])) * cubic(place[2]) * cubic(-std::log(place[3]));
  EXPECT_NEAR(table.at(places), exact, 1e-14 * std::abs(exact) * 50.0);
}

TEST(CubicAxis, FindsTheIntervalOfAPlace) {
  for (const Axis& axis : {even, uneven, even_logarithms, uneven_logarithms}) {
    SCOPED_TRACE(axis.path);
    const CubicAxis cubics(axis);
    ASSERT_EQ(cubics.intervals(), axis.values.size() - 1);
    for (std::size_t i = 0; i < cubics.intervals(); ++i) {
      EXPECT_EQ(cubics.at(0.5 * (axis.values[i] + axis.values[i + 1])).interval, i);
    }
    EXPECT_EQ(cubics.at(axis.values.front()).interval, 0U);
    EXPECT_EQ(cubics.at(axis.values.back()).interval, cubics.intervals() - 1);
  }
}

TEST(EdgeCubicAxis, ContainsItsEndsAndNothingBeyond) {
  const CubicAxis axis(uneven);
  EXPECT_TRUE(axis.contains(0.1));
  EXPECT_TRUE(axis.contains(0.9));
  EXPECT_FALSE(axis.contains(std::nextafter(0.1, 0.0)));
  EXPECT_FALSE(axis.contains(std::nextafter(0.9, 1.0)));
  EXPECT_FALSE(axis.contains(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace gearlash::cubic_table_test
