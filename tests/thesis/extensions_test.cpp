// What the charts of the recommendations are said to teach, read off the charts themselves.
#include "thesis/extensions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/stopping.hpp"
#include "closed_form/limit_cycle.hpp"
#include "thesis/chart_errors.hpp"

namespace gearlash::thesis::extensions_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Each curve has a layer for its line, its marks and its open circles.
NamedCurve curve(const Extension& extension, const std::string& name) {
  const std::vector<Layer>& layers = extension.plot.columns.at(0).at(0).layers;
  for (std::size_t i = 0; i + 2 < layers.size(); ++i) {
    if (layers[i].name != name) continue;
    return {name, layers[i].points, layers[i + 1].points, layers[i + 2].points};
  }
  throw std::out_of_range(name);
}

std::vector<double> amplitudes(const NamedCurve& curve, double low, double high) {
  std::vector<double> found;
  for (const MapPoint& point : curve.line) {
    if (point.x >= low * (1.0 - 1e-9) && point.x <= high * (1.0 + 1e-9)) found.push_back(point.y);
  }
  return found;
}

double at(const NamedCurve& curve, double place) {
  const std::vector<double> found = amplitudes(curve, place, place);
  return found.empty() ? std::nan("") : found.front();
}

/// The largest less the smallest, of the smallest; NaN where hunting ends.
double spread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most / *least - 1.0;
}

TEST(Extensions, FrictionOnOneSideHuntsWhateverTheInertias) {
  const Extension extension = thesis::extension(2);
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
  for (const double amplitude : amplitudes(curve(extension, "massless load"), 0.005, 1.0)) {
    EXPECT_GT(amplitude, 0.19);
  }
  const NamedCurve light_motor = curve(extension, "massless motor");
  EXPECT_GT(at(light_motor, 0.0), 0.15);
  EXPECT_LT(at(light_motor, 0.995), 0.001);
  EXPECT_EQ(analyse_limit_cycles(
                {.damping = 0.2, .inertia_ratio = 0.0, .friction_ratio = 0.5, .backlash = 0.3})
                .cycles.front()
                .energy.impacts,
            0.0);
}

TEST(Extensions, HeavyLoadsAreAlikeAndLightOnesDependOnDamping) {
  const Extension extension = thesis::extension(3);
  for (int tenth = 1; tenth <= 6; ++tenth) {
    const NamedCurve one = curve(extension, "damping 0." + std::to_string(tenth));
    EXPECT_LT(spread(amplitudes(one, 30.0, 1e3)), 0.05) << one.name;
    if (tenth >= 4) {
      EXPECT_EQ(one.ends.size(), 1U) << one.name;
      for (const double amplitude : amplitudes(one, 1e-3, 0.1))
        EXPECT_TRUE(std::isnan(amplitude)) << one.name;
    }
  }
  for (const double amplitude : amplitudes(curve(extension, "damping 0.1"), 1e-3, 0.1)) {
    EXPECT_GT(amplitude / 0.3, 2.2);
    EXPECT_LT(amplitude / 0.3, 3.2);
  }
}

TEST(Extensions, RestitutionMakesTheSwingsDrawnSmaller) {
  const Extension extension = thesis::extension(4);
  bool any_irregular = false;
  for (const char* name : {"damping 0.1", "damping 0.19", "damping 0.3", "damping 0.5"}) {
    const NamedCurve one = curve(extension, name);
    const double plastic = at(one, 0.0);
    for (const MapPoint& steady : one.marks) {
      EXPECT_LE(steady.y, plastic * 1.001) << one.name << " at " << steady.x;
      EXPECT_TRUE(steady.x > 0.5 || steady.y > 0.95 * plastic) << one.name << " at " << steady.x;
    }
    for (const MapPoint& irregular : one.ends) {
      any_irregular = true;
      EXPECT_GT(irregular.x, 0.5) << one.name;
      EXPECT_GT(irregular.y, 0.0) << one.name << " at " << irregular.x;
    }
    EXPECT_EQ(one.marks.size() + one.ends.size(), 51U) << one.name;
  }
  EXPECT_TRUE(any_irregular);
}

/// Over all servos of the thesis's charts that hunt.
TEST(Extensions, RestitutionOverTheChartsOf1960) {
  double least = infinity;
  double most = 0.0;
  bool any_irregular = false;
  for (NormalizedServo servo : charted_servos()) {
    const LimitCycleAnalysis plastic = analyse_limit_cycles(servo);
    if (plastic.cycles.empty()) continue;
    const double amplitude = plastic.cycles.front().amplitude;
    servo.restitution = 0.1;
    EXPECT_NEAR(largest_stable(analyse_limit_cycles(servo))->amplitude, amplitude,
                0.01 * amplitude);
    servo.restitution = 0.5;
    const LimitCycleAnalysis half = analyse_limit_cycles(servo);
    const LimitCycle* cycle = largest_stable(half);
    any_irregular = any_irregular || cycle == nullptr;
    if (cycle == nullptr) continue;
    least = std::min(least, cycle->amplitude / amplitude);
    most = std::max(most, cycle->amplitude / amplitude);
  }
  EXPECT_NEAR(least, 2.0 / 3.0, 0.05);
  EXPECT_NEAR(most, 1.5, 0.1);
  EXPECT_TRUE(any_irregular);
}

TEST(ChartErrors, LeaveOutTheServoAtWhichTheyAreStopped) {
  const auto run = [](const ProgramParameters& parameters, Progress& progress) {
    return run_until_settled(parameters, {}, progress);
  };
  test::Stopping within_the_first(100);
  EXPECT_TRUE(chart_errors(run, within_the_first).empty());
  EXPECT_LE(within_the_first.asked, 101);
  test::Stopping after_it(200'000);
  EXPECT_FALSE(chart_errors(run, after_it).empty());
}

}  // namespace
}  // namespace gearlash::thesis::extensions_test
