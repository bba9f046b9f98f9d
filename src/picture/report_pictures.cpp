#include "picture/report_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/lists.hpp"
#include "gearlash/motion.hpp"
#include "general/assemble/time_scale.hpp"
#include "model/reduced_drive.hpp"
#include "output/change_report.hpp"
#include "output/parameter_text.hpp"
#include "picture/curve_panel.hpp"
#include "picture/drawn_motion.hpp"

namespace gearlash {
namespace {

/// Empty where there is no step response.
NamedCurve response_of(const ComparedDrive& one, double until, const AngleUnit& angle) {
  if (!one.answer) return {.name = one.name + ": not reached"};
  if (!one.answer->step) return {.name = one.name + ": no step response"};
  NamedCurve curve{.name = one.name + ": " + result_text(*one.answer, one.drive)};
  Drive drive = one.drive;
  drive.reference = one.answer->step->step;
  const Motion motion = simulate(drive, {.until = until});
  const double period = drive::time_scales(reduce(drive)).swing;
  for_each_point(drawn_motion(motion, angle, period, {}), [&](const DrawnPoint& point) {
    curve.line.push_back({point.time, point.load_position});
  });
  return curve;
}

/// When the curve is near its end for good.
double end_of_change(const NamedCurve& curve, double near) {
  const auto away = std::find_if(curve.line.rbegin(), curve.line.rend(), [&](const auto& point) {
    return std::abs(point.y - curve.line.back().y) > near;
  });
  return away == curve.line.rend() ? 0.0 : away->x;
}

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
                    .unit = report.drive.nominal.angle_unit.name,
                    .low = 0.0,
                    .high = report.drive.nominal.angle_unit.from_radians(last)},
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
    line.push_back({report.drive.nominal.angle_unit.from_radians(edge), percent});
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
    line.push_back({report.drive.nominal.angle_unit.from_radians(edge), 100.0 * samples / all});
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
  sort_by(bars, [](const Bar& bar) { return -bar.value; });
  return bars;
}

}  // namespace

Plot ceiling_plot(const AnswerReport& report) {
  const Ceiling& ceiling = *report.answer.ceiling;
  std::vector<Bar> bars = of_each(ceiling.terms, [&](const CeilingTerm& term) {
    return Bar{.name = term.source, .value = report.drive.angle_unit.from_radians(term.load)};
  });
  sort_by(bars, [](const Bar& bar) { return -bar.value; });
  return plot_of(
      "What the ceiling of the load is made of",
      "no motion exceeds " + swing_bound_text(*ceiling.load, report.drive.angle_unit, 4) +
          " in the end (proved)",
      bar_panel(bars, {.name = "term of the ceiling", .unit = report.drive.angle_unit.name}));
}

std::optional<Plot> tornado_plot(const Jacobian& sensitivity) {
  const Quantity quantity = quantity_of_effect(sensitivity);
  const bool has_amplitude = quantity == Quantity::amplitude;
  std::vector<Bar> bars;
  for (const std::size_t parameter : by_falling_effect(sensitivity)) {
    const auto elasticity = elasticity_of(sensitivity, quantity, parameter);
    if (elasticity && std::isfinite(*elasticity)) {
      bars.push_back({sensitivity.paths[parameter], *elasticity});
    }
  }
  if (bars.empty()) return std::nullopt;
  const std::string name = has_amplitude ? "amplitude" : "growth at rest";
  return plot_of(has_amplitude ? "What the amplitude of the limit cycle depends on"
                               : "What the growth at rest depends on",
                 "", bar_panel(bars, {.name = name + ", per cent for one per cent more"}));
}

Plot comparison_plot(const ComparisonReport& report) {
  const AngleUnit& angle = report.drives.front().drive.angle_unit;
  const double step = step_of(report).value_or(0.0);
  double until = 0.0;
  for (const ComparedDrive& one : report.drives) {
    if (one.answer && one.answer->step) until = std::max(until, one.answer->step->until);
  }
  std::vector<NamedCurve> curves;
  double end = 0.0;
  for (const ComparedDrive& one : report.drives) {
    curves.push_back(response_of(one, until, angle));
    constexpr double near = 0.01;  // of the step
    constexpr double after = 1.5;  // shows that it stays
    end = std::max(end,
                   after * end_of_change(curves.back(), near * angle.from_radians(std::abs(step))));
  }
  end = std::min(end, until);
  Panel panel{.x = {.name = "time",
                    .unit = is_normalized(report) ? "1/ω_n" : "s",
                    .low = 0.0,
                    .high = end > 0.0     ? end
                            : until > 0.0 ? until
                                          : 1.0},
              .y = {.name = "position of the load", .unit = angle.name}};
  add_curves(curves, 0.0, panel);
  if (!(until > 0.0)) say("no step response", panel);
  return plot_of("A step of the reference by " + (report.axis ? report.axis->path : "drive"),
                 step != 0.0 ? "step of " + angle_text(step, angle, usual_digits) : "",
                 std::move(panel));
}

Plot tolerance_plot(const ToleranceReport& report, std::string_view kind) {
  const std::vector<Bar> indices = indices_of(report);
  if (report.study.histogram.edges.empty() || indices.empty()) {
    refuse("--plot", kind, "must be left out: no sample hunts, or all alike");
  }
  if (kind == "distribution") return distribution_of(report);
  if (kind == "yield") return yield_of(report);
  return plot_of_run(
      report, "What decides the amplitude",
      bar_panel(indices, {.name = "share of the variance (Sobol's indices)"}, "in all", "alone"));
}

}  // namespace gearlash
