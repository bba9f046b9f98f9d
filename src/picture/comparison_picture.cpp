#include "picture/comparison_picture.hpp"

#include <algorithm>
#include <cmath>

#include "gearlash/motion.hpp"
#include "general/assemble/time_scale.hpp"
#include "model/reduced_drive.hpp"
#include "output/parameter_text.hpp"
#include "picture/curve_panel.hpp"
#include "picture/drawn_motion.hpp"

namespace gearlash {
namespace {

/// Empty where there is no step response.
NamedCurve response_of(const ComparedDrive& one, double until, const AngleUnit& angle) {
  if (!one.answer) return {.name = one.name + ": not reached"};
  if (!one.answer->step) return {.name = one.name + ": no step response"};
  NamedCurve curve{.name = one.name + ": " + result_text(*one.answer, angle)};
  Drive drive = one.drive;
  drive.reference = one.answer->step->step;
  const Motion motion = simulate(drive, {.until = until});
  const double period = drive::time_scales(reduce(drive)).swing;
  for (const DrawnPiece& piece : drawn_motion(motion, angle, period, {})) {
    for (const DrawnPoint& point : piece.points) {
      curve.line.push_back({point.time, point.load_position});
    }
  }
  return curve;
}

/// When the curve is near its end for good.
double end_of_change(const NamedCurve& curve, double near) {
  const auto away = std::find_if(curve.line.rbegin(), curve.line.rend(), [&](const auto& point) {
    return std::abs(point.y - curve.line.back().y) > near;
  });
  return away == curve.line.rend() ? 0.0 : away->x;
}

}  // namespace

Plot comparison_plot(const ComparisonReport& report) {
  const AngleUnit& angle = report.angles.front();
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

}  // namespace gearlash
