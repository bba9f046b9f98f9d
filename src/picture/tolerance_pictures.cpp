#include "picture/tolerance_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "picture/curve_panel.hpp"

namespace gearlash {
namespace {

Plot plot_of_run(const ToleranceReport& report, const char* title, Panel panel) {
  return plot_of(title,
                 fmt::format("{} samples, {} % of them hunt", report.study.sampling.samples(),
                             significant(100.0 * report.study.hunting.value, 3)),
                 std::move(panel));
}

Plot plot_over_amplitude(const ToleranceReport& report, const char* title, PlotAxis percent,
                         MapCurve line) {
  const double last = report.study.histogram.edges.back();
  Panel panel{.x = {.name = "amplitude of the limit cycle",
                    .unit = report.angle.name,
                    .low = 0.0,
                    .high = report.angle.from_radians(last)},
              .y = std::move(percent)};
  add_curves({{.line = std::move(line)}}, 0.0, panel);
  return plot_of_run(report, title, std::move(panel));
}

/// The samples that hunt in each bin, in per cent of all samples.
Plot distribution_of(const ToleranceReport& report) {
  const AmplitudeHistogram& histogram = report.study.histogram;
  const double all = static_cast<double>(report.study.sampling.samples());
  MapCurve line;
  const auto add = [&](double edge, double percent) {
    line.push_back({report.angle.from_radians(edge), percent});
  };
  add(histogram.edges.front(), 0.0);
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double percent = 100.0 * static_cast<double>(histogram.counts[i]) / all;
    add(histogram.edges[i], percent);
    add(histogram.edges[i + 1], percent);
  }
  add(histogram.edges.back(), 0.0);
  return plot_over_amplitude(
      report, "Amplitudes of a production run",
      {.name = fmt::format("samples in each of {} steps", histogram.counts.size()),
       .unit = "%",
       .low = 0.0},
      std::move(line));
}

Plot yield_of(const ToleranceReport& report) {
  const AmplitudeHistogram& histogram = report.study.histogram;
  const double all = static_cast<double>(report.study.sampling.samples());
  MapCurve line;
  double samples = static_cast<double>(histogram.quiet);
  const auto add = [&](double edge) {
    line.push_back({report.angle.from_radians(edge), 100.0 * samples / all});
  };
  add(0.0);
  add(histogram.edges.front());
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    samples += static_cast<double>(histogram.counts[i]);
    add(histogram.edges[i + 1]);
  }
  return plot_over_amplitude(
      report, "Yield against a limit of the amplitude",
      {.name = "samples up to that amplitude", .unit = "%", .low = 0.0, .high = 100.0},
      std::move(line));
}

std::vector<Bar> indices_of(const ToleranceReport& report) {
  std::vector<Bar> bars;
  for (const NumberSensitivity& number : report.sensitivities.numbers) {
    if (!number.of_amplitude) continue;
    bars.push_back({number.path, std::max(0.0, number.of_amplitude->total.value),
                    std::max(0.0, number.of_amplitude->first_order.value)});
  }
  std::stable_sort(bars.begin(), bars.end(),
                   [](const Bar& a, const Bar& b) { return a.value > b.value; });
  return bars;
}

}  // namespace

Plot tolerance_plot(const ToleranceReport& report, TolerancePicture picture) {
  const std::vector<Bar> indices = indices_of(report);
  if (report.study.histogram.edges.empty() || indices.empty()) {
    throw InvalidInput({{"--plot", "", "must be left out: no sample hunts, or all alike", ""}});
  }
  switch (picture) {
    case TolerancePicture::distribution:
      return distribution_of(report);
    case TolerancePicture::yield:
      return yield_of(report);
    case TolerancePicture::indices:
      break;
  }
  return plot_of_run(
      report, "What decides the amplitude",
      bar_panel(indices, {.name = "share of the variance (Sobol's indices)"}, "in all", "alone"));
}

}  // namespace gearlash
