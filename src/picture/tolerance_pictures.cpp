#include "picture/tolerance_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "picture/bar_chart.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {
namespace {

std::string run_in_words(const ToleranceReport& report) {
  return fmt::format("{} samples, {} % of them hunt", report.study.sampling.samples(),
                     significant(100.0 * report.study.hunting.value, 3));
}

ChartAxis amplitude_axis(const ToleranceReport& report) {
  const AngleUnit& unit = report.angle;
  return {.label = "amplitude of the limit cycle (" + unit.name + ")",
          .low = 0.0,
          .high = unit.from_radians(report.study.histogram.edges.back())};
}

/// Filled in member by member: where an allocation fails within braces in braces, GCC 12 destroys
/// what they have made twice.
LineChart chart_of(const ToleranceReport& report, const char* title, ChartAxis y,
                   ChartCurve curve) {
  LineChart chart;
  chart.title = title;
  chart.subtitle = run_in_words(report);
  chart.x = amplitude_axis(report);
  chart.y = std::move(y);
  chart.curves.push_back(std::move(curve));
  return chart;
}

/// The samples that hunt in each bin, in per cent of all samples.
LineChart distribution_of(const ToleranceReport& report) {
  const AmplitudeHistogram& histogram = report.study.histogram;
  const double all = static_cast<double>(report.study.sampling.samples());
  ChartCurve curve;
  const auto add = [&](double edge, double percent) {
    curve.line.push_back({report.angle.from_radians(edge), percent});
  };
  add(histogram.edges.front(), 0.0);
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double percent = 100.0 * static_cast<double>(histogram.counts[i]) / all;
    add(histogram.edges[i], percent);
    add(histogram.edges[i + 1], percent);
  }
  add(histogram.edges.back(), 0.0);
  return chart_of(report, "Amplitudes of a production run",
                  {.label = fmt::format("samples in each of {} steps (%)", histogram.counts.size()),
                   .low = 0.0},
                  std::move(curve));
}

LineChart yield_of(const ToleranceReport& report) {
  const AmplitudeHistogram& histogram = report.study.histogram;
  const double all = static_cast<double>(report.study.sampling.samples());
  ChartCurve curve;
  double samples = static_cast<double>(histogram.quiet);
  const auto add = [&](double edge) {
    curve.line.push_back({report.angle.from_radians(edge), 100.0 * samples / all});
  };
  add(0.0);
  add(histogram.edges.front());
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    samples += static_cast<double>(histogram.counts[i]);
    add(histogram.edges[i + 1]);
  }
  return chart_of(report, "Yield against a limit of the amplitude",
                  {.label = "samples up to that amplitude (%)", .low = 0.0, .high = 100.0},
                  std::move(curve));
}

BarChart indices_of(const ToleranceReport& report) {
  BarChart chart{.title = "What decides the amplitude",
                 .subtitle = run_in_words(report),
                 .label = "share of the variance (Sobol's indices)",
                 .value_meaning = "in all",
                 .part_meaning = "alone"};
  for (const NumberSensitivity& number : report.sensitivities.numbers) {
    if (!number.of_amplitude) continue;
    chart.bars.push_back({number.path, std::max(0.0, number.of_amplitude->total.value),
                          std::max(0.0, number.of_amplitude->first_order.value)});
  }
  std::stable_sort(chart.bars.begin(), chart.bars.end(),
                   [](const Bar& a, const Bar& b) { return a.value > b.value; });
  return chart;
}

}  // namespace

std::string draw_tolerances(const ToleranceReport& report, TolerancePicture picture,
                            PictureFormat format) {
  const BarChart indices = indices_of(report);
  if (report.study.histogram.edges.empty() || indices.bars.empty()) {
    throw InvalidInput({{"--plot", "", "must be left out: no sample hunts, or all alike", ""}});
  }
  switch (picture) {
    case TolerancePicture::distribution:
      return draw_line_chart(distribution_of(report), format);
    case TolerancePicture::yield:
      return draw_line_chart(yield_of(report), format);
    case TolerancePicture::indices:
      break;
  }
  return draw_bar_chart(indices, format);
}

}  // namespace gearlash
