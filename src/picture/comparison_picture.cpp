#include "picture/comparison_picture.hpp"

#include <algorithm>
#include <cmath>

#include "gearlash/motion.hpp"
#include "general/assemble/time_scale.hpp"
#include "model/reduced_drive.hpp"
#include "output/parameter_text.hpp"
#include "picture/drawn_motion.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {
namespace {

/// Empty where there is no step response.
ChartCurve response_of(const ComparedDrive& one, double until, const AngleUnit& angle) {
  if (!one.answer) return {.name = one.name + ": not reached"};
  if (!one.answer->step) return {.name = one.name + ": no step response"};
  ChartCurve curve{.name = one.name + ": " + result_text(*one.answer, angle)};
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
double end_of_change(const ChartCurve& curve, double near) {
  const auto away = std::find_if(curve.line.rbegin(), curve.line.rend(), [&](const auto& point) {
    return std::abs(point.y - curve.line.back().y) > near;
  });
  return away == curve.line.rend() ? 0.0 : away->x;
}

}  // namespace

std::string draw_comparison(const ComparisonReport& report, PictureFormat format) {
  const AngleUnit& angle = report.angles.front();
  LineChart chart;
  chart.title = "A step of the reference by " + (report.axis ? report.axis->path : "drive");
  const double step = step_of(report).value_or(0.0);
  if (step != 0.0) chart.subtitle = "step of " + angle_text(step, angle, usual_digits);
  double until = 0.0;
  for (const ComparedDrive& one : report.drives) {
    if (one.answer && one.answer->step) until = std::max(until, one.answer->step->until);
  }
  chart.x = {.label = is_normalized(report) ? "time (1/ω_n)" : "time (s)", .low = 0.0, .high = 0.0};
  chart.y.label = "position of the load (" + angle.name + ")";
  chart.empty_meaning = "no step response";
  for (const ComparedDrive& one : report.drives) {
    chart.curves.push_back(response_of(one, until, angle));
    constexpr double near = 0.01;  // of the step
    constexpr double after = 1.5;  // shows that it stays
    const double end =
        end_of_change(chart.curves.back(), near * angle.from_radians(std::abs(step)));
    chart.x.high = std::clamp(after * end, *chart.x.high, until);
  }
  if (!(*chart.x.high > 0.0)) chart.x.high = until > 0.0 ? until : 1.0;
  return draw_line_chart(chart, format);
}

}  // namespace gearlash
