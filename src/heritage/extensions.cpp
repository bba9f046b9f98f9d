#include "gearlash/heritage/extensions.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "exact_curve.hpp"
#include "gearlash/cycle/limit_cycle.hpp"

namespace gearlash::heritage {
namespace {

constexpr double charted_backlash = 0.3;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

ChartCurve curve(std::string name, const std::vector<double>& places,
                 const std::function<NormalizedServo(double)>& servo_at) {
  ExactCurve exact = exact_curve(places, servo_at);
  return {.name = std::move(name), .line = std::move(exact.line), .ends = std::move(exact.ends)};
}

/// With bounces: steady swings as the line, the extent of those that do not repeat as marks.
ChartCurve bouncing_curve(std::string name, const std::vector<double>& places,
                          const std::function<NormalizedServo(double)>& servo_at) {
  ChartCurve result{.name = std::move(name)};
  for (const double place : places) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo_at(place));
    const LimitCycle* cycle = largest_stable(analysis);
    result.line.push_back({place, cycle != nullptr ? cycle->size : nothing});
    if (cycle == nullptr) result.marks.push_back({place, analysis.irregular_size});
  }
  return result;
}

std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(low + (high - low) * i / (count - 1));
  return places;
}

std::vector<double> evenly_in_logarithm(double low, double high, int count) {
  std::vector<double> places;
  for (const double exponent : evenly(std::log(low), std::log(high), count)) {
    places.push_back(std::exp(exponent));
  }
  return places;
}

const ChartAxis size_axis{.label = "size of limit cycle (rad)", .low = 0.0};

Extension zero_friction_and_inertia() {
  Extension result{
      .number = 2,
      .wish = "Extend the program to include the zero friction and zero inertia cases.",
      .lesson =
          "With friction all on one side the servo hunts whatever its inertias, at a friction "
          "ratio of 0 as of 1, and the lighter the load the more. A side without inertia takes no "
          "energy "
          "at the impact; the servo hunts all the same, though with a motor without inertia the "
          "swing vanishes as the friction moves to the load. The size at a friction ratio of 0 is "
          "within four per cent of that at 0.04, which the thesis took for it.",
      .chart = {.title = "Recommendation 2: zero friction and zero inertia",
                .subtitle = "damping 0.2, backlash 0.3",
                .x = {.label = "friction ratio, load friction to total friction",
                      .low = 0.0,
                      .high = 1.0},
                .y = size_axis}};
  const std::vector<std::pair<std::string, double>> ratios = {{"massless load", 0.0},
                                                              {"J_L/J_M 1/4", 0.25},
                                                              {"J_L/J_M 1", 1.0},
                                                              {"J_L/J_M 4", 4.0},
                                                              {"massless motor", infinity}};
  for (const auto& [name, ratio] : ratios) {
    result.chart.curves.push_back(
        curve(name, evenly(0.0, 1.0, 201), [ratio = ratio](double friction_ratio) {
          return NormalizedServo{.damping = 0.2,
                                 .inertia_ratio = ratio,
                                 .friction_ratio = friction_ratio,
                                 .backlash = charted_backlash};
        }));
  }
  return result;
}

Extension wide_inertia_ratios() {
  Extension result{
      .number = 3,
      .wish = "Extend the program to include a larger range of inertia ratios.",
      .lesson =
          "Beyond a ratio of 30 the curves are flat: a heavier load neither calms the servo nor "
          "makes it worse, the motor's inertia then being negligible. Below 1/10 everything "
          "depends on damping: at 0.1 the servo swings by two to three times the backlash, from "
          "0.4 on it "
          "comes to rest.",
      .chart = {.title = "Recommendation 3: inertia ratios from 1/1000 to 1000",
                .subtitle = "friction ratio 0.2, backlash 0.3",
                .x = {.label = "inertia ratio, load to motor",
                      .logarithmic = true,
                      .low = 1e-3,
                      .high = 1e3},
                .y = size_axis,
                .end_meaning = "hunting ends"}};
  constexpr int dampings = 6;
  for (int tenth = 1; tenth <= dampings; ++tenth) {
    result.chart.curves.push_back(curve(fmt::format("damping 0.{}", tenth),
                                        evenly_in_logarithm(1e-3, 1e3, 601), [tenth](double ratio) {
                                          return NormalizedServo{.damping = tenth / 10.0,
                                                                 .inertia_ratio = ratio,
                                                                 .friction_ratio = 0.2,
                                                                 .backlash = charted_backlash};
                                        }));
  }
  return result;
}

Extension elastic_contact(const std::function<void(double share)>& done) {
  Extension result{
      .number = 4,
      .wish =
          "Reprogram the contact phase to include the case of elastic contact and to include "
          "the \"lossy\" case for all types of contact between elastic contact and plastic "
          "contact.",
      .lesson =
          "As restitution rises the swing becomes smaller on the whole, not larger. Up to a "
          "restitution of a half the plastic charts are right within five per cent, on the safe "
          "side. Beyond, steady swings end and begin again: where a curve is broken none was "
          "found, and the motion goes on without repeating (marks, at half its extent).",
      .chart = {.title = "Recommendation 4: from plastic to elastic contact",
                .subtitle = "friction ratio 0.1, inertia ratio 2, backlash 0.3",
                .x = {.label = "restitution", .low = 0.0, .high = 1.0},
                .y = size_axis,
                .line_meaning = "steady swing",
                .mark_meaning = "does not repeat: its extent",
                .mark_size = 0.55}};
  constexpr std::array dampings = {0.1, 0.19, 0.3, 0.5};
  for (const double damping : dampings) {
    const auto servo_at = [damping](double restitution) {
      return NormalizedServo{.damping = damping,
                             .inertia_ratio = 2.0,
                             .friction_ratio = 0.1,
                             .backlash = charted_backlash,
                             .restitution = restitution};
    };
    result.chart.curves.push_back(
        bouncing_curve(fmt::format("damping {}", damping), evenly(0.0, 1.0, 51), servo_at));
    if (done) done(static_cast<double>(result.chart.curves.size()) / dampings.size());
  }
  return result;
}

}  // namespace

Extension extension(int number, const std::function<void(double share)>& done) {
  switch (number) {
    case 2:
      return zero_friction_and_inertia();
    case 3:
      return wide_inertia_ratios();
    case 4:
      return elastic_contact(done);
    default:
      throw std::out_of_range("no such recommendation");
  }
}

}  // namespace gearlash::heritage
