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
#include "picture/plot_making.hpp"

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

Plot plot_of_run(const ToleranceStudy& study, const char* title, Panel panel) {
  return plot_of(title,
                 fmt::format("{} samples, {} % of them hunt", study.sampling.samples(),
                             significant(100.0 * study.hunting.value, 3)),
                 std::move(panel));
}

Panel panel_over_amplitude(const AmplitudeHistogram& histogram, const AngleUnit& angle,
                           PlotAxis percent, MapCurve line) {
  for (MapPoint& point : line) point.x = angle.from_radians(point.x);
  Panel panel{.x = {.name = "amplitude of the limit cycle",
                    .unit = angle.name,
                    .low = 0.0,
                    .high = angle.from_radians(histogram.edges.back())},
              .y = std::move(percent)};
  add_curves({{.line = std::move(line)}}, 0.0, panel);
  return panel;
}

/// The samples that hunt in each bin, in per cent of all samples.
Panel distribution_of(const AmplitudeHistogram& histogram, double all, const AngleUnit& angle) {
  MapCurve line = {{histogram.edges.front(), 0.0}};
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double percent = 100.0 * static_cast<double>(histogram.counts[i]) / all;
    add_all(line, MapCurve{{histogram.edges[i], percent}, {histogram.edges[i + 1], percent}});
  }
  line.push_back({histogram.edges.back(), 0.0});
  return panel_over_amplitude(
      histogram, angle,
      {.name = fmt::format("samples in each of {} steps", histogram.counts.size()),
       .unit = "%",
       .low = 0.0},
      std::move(line));
}

Panel yield_of(const AmplitudeHistogram& histogram, double all, const AngleUnit& angle) {
  double samples = static_cast<double>(histogram.quiet);
  MapCurve line = {{0.0, 100.0 * samples / all}, {histogram.edges.front(), 100.0 * samples / all}};
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    samples += static_cast<double>(histogram.counts[i]);
    line.push_back({histogram.edges[i + 1], 100.0 * samples / all});
  }
  return panel_over_amplitude(
      histogram, angle,
      {.name = "samples up to that amplitude", .unit = "%", .low = 0.0, .high = 100.0},
      std::move(line));
}

[[noreturn]] void refuse_picture(const char* kind, const std::string& why) {
  refuse("picture", kind, "must be left out: " + why);
}

}  // namespace

Plot ceiling_plot(const AnswerReport& report) {
  const Ceiling& ceiling = *report.answer.ceiling;
  if (ceiling.terms.empty()) {
    refuse_picture("ceiling", ceiling.load ? "this drive has no gap, dry friction or encoder"
                                           : ceiling.reason);
  }
  std::vector<Bar> bars = of_each(ceiling.terms, [&](const CeilingTerm& term) {
    return Bar{.name = term.source, .value = report.drive.angle_unit.from_radians(term.load)};
  });
  sort_by(bars, [](const Bar& bar) { return -bar.value; });
  return plot_of(
      "What the ceiling of the load is made of",
      "no motion exceeds " + DriveUnits(report.drive).swing_at_most(*ceiling.load) +
          " in the end (proved)",
      bar_panel(bars, {.name = "term of the ceiling", .unit = report.drive.angle_unit.name}));
}

Plot tornado_plot(const Jacobian& sensitivity) {
  const Quantity quantity = quantity_of_effect(sensitivity);
  const bool has_amplitude = quantity == Quantity::amplitude;
  std::vector<Bar> bars;
  for (const std::size_t parameter : by_falling_effect(sensitivity)) {
    const auto elasticity = elasticity_of(sensitivity, quantity, parameter);
    if (elasticity && std::isfinite(*elasticity)) {
      bars.push_back({sensitivity.paths[parameter], *elasticity});
    }
  }
  if (bars.empty()) {
    const std::string& why = sensitivity.reason;
    refuse_picture("tornado", "this drive has no sensitivities" + (why.empty() ? why : "; " + why));
  }
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

Plot tolerance_plot(PictureKind kind, const ToleranceStudy& study, const AngleUnit& angle) {
  const AmplitudeHistogram& histogram = study.histogram;
  const bool is_yield = kind == PictureKind::yield;
  if (histogram.edges.empty()) {
    refuse_picture(is_yield ? "yield" : "distribution", "no sample hunts, or all alike");
  }
  const auto all = static_cast<double>(study.sampling.samples());
  return is_yield ? plot_of_run(study, "Yield against a limit of the amplitude",
                                yield_of(histogram, all, angle))
                  : plot_of_run(study, "Amplitudes of a production run",
                                distribution_of(histogram, all, angle));
}

Plot indices_plot(const ToleranceStudy& study, const SensitivityStudy& sensitivities) {
  std::vector<Bar> bars;
  for (const NumberSensitivity& number : sensitivities.numbers) {
    if (!number.of_amplitude) continue;
    bars.push_back({number.path, std::max(0.0, number.of_amplitude->total.value),
                    std::max(0.0, number.of_amplitude->first_order.value)});
  }
  if (bars.empty()) refuse_picture("indices", "no sample hunts, or all alike");
  sort_by(bars, [](const Bar& bar) { return -bar.value; });
  return plot_of_run(
      study, "What decides the amplitude",
      bar_panel(bars, {.name = "share of the variance (Sobol's indices)"}, "in all", "alone"));
}

}  // namespace gearlash
