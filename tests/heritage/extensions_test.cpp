// What the charts of the recommendations are said to teach, read off the charts themselves.
#include "gearlash/heritage/extensions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gearlash/cycle/limit_cycle.hpp"

namespace gearlash::heritage {
namespace {

const ChartCurve& curve(const Extension& extension, const std::string& name) {
  const auto found = std::find_if(extension.chart.curves.begin(), extension.chart.curves.end(),
                                  [&](const ChartCurve& one) { return one.name == name; });
  if (found == extension.chart.curves.end()) throw std::out_of_range(name);
  return *found;
}

std::vector<double> sizes(const ChartCurve& curve, double low, double high) {
  std::vector<double> found;
  for (const ChartPoint& point : curve.line) {
    if (point.x >= low * (1.0 - 1e-9) && point.x <= high * (1.0 + 1e-9)) found.push_back(point.y);
  }
  return found;
}

double at(const ChartCurve& curve, double place) {
  const std::vector<double> found = sizes(curve, place, place);
  return found.empty() ? std::nan("") : found.front();
}

/// The largest less the smallest, of the smallest; NaN where hunting ends.
double spread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most / *least - 1.0;
}

TEST(Extensions, FrictionOnOneSideHuntsWhateverTheInertias) {
  const Extension extension = heritage::extension(2);
  for (const char* name : {"J_L/J_M 1/4", "J_L/J_M 1", "J_L/J_M 4"}) {
    EXPECT_GT(at(curve(extension, name), 0.0), 0.0) << name;
    EXPECT_GT(at(curve(extension, name), 1.0), 0.0) << name;
    // 0.04 is where the thesis stood in for zero.
    EXPECT_LT(std::abs(at(curve(extension, name), 0.0) / at(curve(extension, name), 0.04) - 1.0),
              0.04)
        << name;
  }
  for (const double end : {0.0, 1.0}) {
    EXPECT_GT(at(curve(extension, "J_L/J_M 1/4"), end), at(curve(extension, "J_L/J_M 1"), end));
    EXPECT_GT(at(curve(extension, "J_L/J_M 1"), end), at(curve(extension, "J_L/J_M 4"), end));
  }
  for (const double size : sizes(curve(extension, "massless load"), 0.005, 1.0)) {
    EXPECT_GT(size, 0.19);
  }
  const ChartCurve& light_motor = curve(extension, "massless motor");
  EXPECT_GT(at(light_motor, 0.0), 0.15);
  EXPECT_LT(at(light_motor, 0.995), 0.001);
  EXPECT_EQ(analyse_limit_cycles(
                {.damping = 0.2, .inertia_ratio = 0.0, .friction_ratio = 0.5, .backlash = 0.3})
                .cycles.front()
                .energy.impacts,
            0.0);
}

TEST(Extensions, HeavyLoadsAreAlikeAndLightOnesDependOnDamping) {
  const Extension extension = heritage::extension(3);
  for (int tenth = 1; tenth <= 6; ++tenth) {
    const ChartCurve& one = curve(extension, "damping 0." + std::to_string(tenth));
    EXPECT_LT(spread(sizes(one, 30.0, 1e3)), 0.05) << one.name;
    if (tenth >= 4) {
      EXPECT_EQ(one.ends.size(), 1U) << one.name;
      for (const double size : sizes(one, 1e-3, 0.1)) EXPECT_TRUE(std::isnan(size)) << one.name;
    }
  }
  for (const double size : sizes(curve(extension, "damping 0.1"), 1e-3, 0.1)) {
    EXPECT_GT(size / 0.3, 2.2);
    EXPECT_LT(size / 0.3, 3.2);
  }
}

TEST(Extensions, RestitutionMakesTheSwingSmaller) {
  const Extension extension = heritage::extension(4);
  ASSERT_EQ(extension.chart.curves.size(), 4U);
  bool any_broken = false;
  for (const ChartCurve& one : extension.chart.curves) {
    const double plastic = at(one, 0.0);
    for (const double size : sizes(one, 0.0, 0.5)) {
      EXPECT_LE(size, plastic * (1.0 + 1e-12)) << one.name;
      EXPECT_GT(size, 0.95 * plastic) << one.name;
    }
    for (const ChartPoint& point : one.line) {
      // Where no steady swing was found a mark tells how far the motion goes.
      const bool marked = std::any_of(one.marks.begin(), one.marks.end(), [&](const ChartPoint& m) {
        return m.x == point.x && m.y > 0.0;
      });
      EXPECT_EQ(marked, std::isnan(point.y)) << one.name << " at " << point.x;
      any_broken = any_broken || marked;
      EXPECT_FALSE(point.y > 1.001 * plastic) << one.name << " at " << point.x;
    }
  }
  EXPECT_TRUE(any_broken);
}

}  // namespace
}  // namespace gearlash::heritage
