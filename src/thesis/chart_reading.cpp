#include "thesis/chart_reading.hpp"

#include <algorithm>
#include <boost/math/interpolators/makima.hpp>
#include <cmath>
#include <utility>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "thesis/exact_curve.hpp"
#include "thesis/figures.hpp"
#include "thesis/settled_cycle.hpp"

namespace gearlash::thesis {
namespace {

std::vector<DesignChart1960> make_charts() {
  std::vector<DesignChart1960> charts;
  for (const Figure& figure : thesis_figures()) {
    if (figure.along != Along::inertia_ratio) continue;
    DesignChart1960 chart;
    chart.figure = figure.number;
    chart.friction_ratio = figure.curves.front().servo.friction_ratio;
    chart.inertia_ratios = figure.grid;
    for (const FigureCurve& curve : figure.curves) {
      chart.dampings.push_back(curve.servo.damping);
      chart.amplitudes.push_back(of_each(figure.grid, [&](double place) {
        return run_until_settled(program_parameters(servo_at(figure, curve, place))).amplitude;
      }));
    }
    charts.push_back(std::move(chart));
  }
  return charts;
}

/// A smooth curve through the five points of a damping over the logarithm of the inertia ratio.
/// Makima interpolation resembles a French curve and does not overshoot.
double read_curve(const std::vector<double>& inertia_ratios, std::vector<double> amplitudes,
                  double inertia_ratio) {
  std::vector<double> places =
      of_each(inertia_ratios, [](double ratio) { return std::log(ratio); });
  const double place = std::clamp(std::log(inertia_ratio), places.front(), places.back());
  return std::max(0.0, boost::math::interpolators::makima<std::vector<double>>(
                           std::move(places), std::move(amplitudes))(place));
}

/// Linear interpolation in the damping between two curves.
double between(const std::array<double, 2>& dampings, const std::array<double, 2>& amplitudes,
               double damping) {
  const double share = (damping - dampings[0]) / (dampings[1] - dampings[0]);
  return (1.0 - share) * amplitudes[0] + share * amplitudes[1];
}

}  // namespace

const std::vector<DesignChart1960>& design_charts_1960() {
  static const std::vector<DesignChart1960> charts = make_charts();
  return charts;
}

ChartReading read_chart(const NormalizedServo& servo) {
  require_none(faults(servo));
  const auto& charts = design_charts_1960();
  const std::vector<double>& ratios = charts.front().inertia_ratios;
  RangeCheck check;
  check.within("damping", servo.damping, charts.front().dampings.front(),
               charts.front().dampings.back());
  // Typed decimals may miss 1/9 by their rounding.
  constexpr double rounding = 1e-3;
  if (!(servo.inertia_ratio >= ratios.front() * (1.0 - rounding) &&
        servo.inertia_ratio <= ratios.back() * (1.0 + rounding))) {
    check.refuse("inertia_ratio", exact_text(servo.inertia_ratio),
                 "must be from 1/9 to 9, where the charts of 1960 end");
  }
  require_none(check.faults());

  ChartReading reading;
  const auto distance = [&](const DesignChart1960& chart) {
    return std::abs(chart.friction_ratio - servo.friction_ratio);
  };
  reading.chart = &*std::min_element(charts.begin(), charts.end(), by(distance));
  const DesignChart1960& chart = *reading.chart;
  std::size_t below = 0;
  while (below + 2 < chart.dampings.size() && servo.damping > chart.dampings[below + 1]) ++below;
  reading.neighbours = {chart.dampings[below], chart.dampings[below + 1]};
  reading.read = {read_curve(ratios, chart.amplitudes[below], servo.inertia_ratio),
                  read_curve(ratios, chart.amplitudes[below + 1], servo.inertia_ratio)};
  reading.chart_amplitude = between(reading.neighbours, reading.read, servo.damping);
  reading.amplitude = reading.chart_amplitude * servo.backlash / charted_backlash;
  return reading;
}

std::optional<ReadingError> reading_error(const NormalizedServo& servo,
                                          const ChartReading& reading) {
  NormalizedServo charted = servo;
  charted.backlash = charted_backlash;
  const auto amplitude_at = [&](double damping, double inertia_ratio) {
    NormalizedServo one = charted;
    one.damping = damping;
    one.inertia_ratio = inertia_ratio;
    return exact_amplitude(one).value_or(0.0);
  };
  const double exact = amplitude_at(servo.damping, servo.inertia_ratio);
  charted.friction_ratio = reading.chart->friction_ratio;
  const double on_chart = amplitude_at(servo.damping, servo.inertia_ratio);
  std::array<double, 2> at_ratio{};
  std::array<double, 2> through_points{};
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<double> amplitudes = of_each(reading.chart->inertia_ratios, [&](double ratio) {
      return amplitude_at(reading.neighbours[i], ratio);
    });
    at_ratio[i] = amplitude_at(reading.neighbours[i], servo.inertia_ratio);
    through_points[i] =
        read_curve(reading.chart->inertia_ratios, std::move(amplitudes), servo.inertia_ratio);
    if (at_ratio[i] == 0.0 || through_points[i] == 0.0) return std::nullopt;
  }
  if (exact == 0.0 || on_chart == 0.0) return std::nullopt;
  const double along_line = between(reading.neighbours, at_ratio, servo.damping);
  const double along_curves = between(reading.neighbours, through_points, servo.damping);
  return ReadingError{.friction_ratio = on_chart / exact - 1.0,
                      .damping = along_line / on_chart - 1.0,
                      .inertia_ratio = along_curves / along_line - 1.0,
                      .program = reading.chart_amplitude / along_curves - 1.0,
                      .whole = reading.chart_amplitude / exact - 1.0};
}

}  // namespace gearlash::thesis
