#include "picture/comparison_picture.hpp"

#include "gearlash/motion.hpp"
#include "general/assemble/time_scale.hpp"
#include "input/drive_file.hpp"
#include "output/report_units.hpp"
#include "picture/drawn_motion.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {
namespace {

ChartCurve response_of(const SensorCase& one) {
  Drive drive = one.report.drive;
  drive.reference = one.response.step;
  const Motion motion = simulate(drive, {.until = one.response.until});
  const double period = drive::time_scales(reduce(drive)).swing;
  ChartCurve curve;
  curve.name = std::string("sensor on ") + name_of(one.place) + ": " + headline(one.report);
  for (const DrawnPiece& piece : drawn_motion(motion, one.report.angle, period, {})) {
    for (const DrawnPoint& point : piece.points) {
      curve.line.push_back({point.time, point.load_position});
    }
  }
  return curve;
}

}  // namespace

std::string draw_comparison(const ComparisonReport& report, PictureFormat format) {
  constexpr int digits = 4;
  const SensorCase& first = report.cases.front();
  const AngleUnit& unit = first.report.angle;
  const auto angle = [&](double radians) { return angle_text(radians, unit, digits); };
  LineChart chart;
  chart.title = "Step of " + angle(first.response.step) + " by the place of the sensor";
  chart.subtitle = "backlash " + angle(reduce(first.report.drive).backlash);
  chart.x.label = first.report.is_normalized ? "time (1/ω_n)" : "time (s)";
  chart.y.label = "position of the load (" + unit.name + ")";
  for (const SensorCase& one : report.cases) chart.curves.push_back(response_of(one));
  return draw_line_chart(chart, format);
}

}  // namespace gearlash
