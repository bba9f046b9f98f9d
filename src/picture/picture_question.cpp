// The picture that answers a question: what it shows is found, then drawn.
#include <fmt/format.h>

#include "base/range_check.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/comparison.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/input.hpp"
#include "gearlash/picture.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "output/describe_report.hpp"
#include "picture/answer_picture.hpp"
#include "picture/bifurcation_picture.hpp"
#include "picture/grid_chart.hpp"
#include "picture/grid_map.hpp"
#include "picture/motion_picture.hpp"
#include "picture/nyquist_picture.hpp"
#include "picture/report_pictures.hpp"
#include "question/analyse.hpp"
#include "question/axis.hpp"
#include "question/change/derivatives.hpp"
#include "question/map/bifurcations.hpp"
#include "question/motion.hpp"
#include "question/series/tolerance_study.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash {
namespace {

AngleUnit unit_named(const std::string& angle) {
  return angle_unit_of(read_measured("angle", "1 " + angle, dimensions::angle));
}

/// The drive with that unit, unless none is named.
Drive in_unit(Drive drive, const std::string& angle) {
  if (!angle.empty()) drive.angle_unit = unit_named(angle);
  return drive;
}

/// Of the motions and bounds of one drive.
Plot answer_plot(const PictureQuestion& question, Progress& progress) {
  const Analysis analysis =
      analyse_in_full(question.drive, {.ceiling = true, .causes = true}, progress);
  const AnswerReport report = report_of(question.drive, analysis.answer);
  switch (question.kind) {
    case PictureKind::time:
      return time_plot(response_picture(report, analysis));
    case PictureKind::ceiling:
      return ceiling_plot(report);
    case PictureKind::tornado:
      return tornado_plot(sensitivities(question.drive, analysis, progress));
    default:
      return phase_plot(phase_picture(report, analysis, progress));
  }
}

Plot nyquist_plot_of(const PictureQuestion& question, Progress& progress) {
  const Answer answer = analyse(question.drive, {.ceiling = true, .causes = true}, progress);
  return nyquist_plot(describe_report_of(question.drive, answer), question.part);
}

void require_axes(const PictureQuestion& question, std::size_t least, std::size_t most) {
  const std::size_t count = question.axes.size();
  if (count >= least && count <= most) return;
  refuse("axes", fmt::format("{}", count),
         least == most ? fmt::format("must be {}", most)
                       : fmt::format("must be {} or {}", least, most));
}

Plot grid_plot(const PictureQuestion& question, Progress& progress) {
  const bool is_map = question.kind == PictureKind::map;
  require_axes(question, is_map ? 2 : 1, 2);
  GridTable table{.grid = {.drive = question.drive, .axes = question.axes}};
  require_none(faults(table.grid));
  require_none(faults_of_picture(table.grid, {}, !is_map));
  for (const Axis& axis : question.axes) {
    if (is_map && axis.values.size() < 2) refuse(axis.path, "1 value", "must have two or more");
  }
  table.present = is_map && question.marks_drive ? place_on_map(table.grid) : std::nullopt;
  if (!question.target.empty()) {
    table.target_text = question.target;
    table.target =
        read_target("target", question.target,
                    is_normalized(question.drive) ? TimeScale::unknown : TimeScale::known);
  }
  table.table = Table(table.grid.size(),
                      quantities_drawn(table.grid, question.quantity, is_map && !table.target));
  work_out(table, progress);
  if (!is_map) return chart_plot(table, question.quantity);
  add_borders(table, progress);
  return map_plot(table, question.quantity);
}

Plot branches_plot(const PictureQuestion& question, Progress& progress) {
  require_axes(question, 1, 1);
  const Grid grid{.drive = question.drive, .axes = question.axes};
  require_none(faults(grid));
  require_none(faults_of_branches(grid, question.quantity));
  return bifurcation_plot(bifurcations_of(grid.drive, grid.axes.front(), progress), grid,
                          question.quantity);
}

Plot steps_plot(const PictureQuestion& question, Progress& progress) {
  require_axes(question, 0, 1);
  const Axis places{.path = "sensor.position", .values = {0.0, 1.0, 2.0}};
  ComparisonReport report{.axis = question.axes.empty() ? places : question.axes.front()};
  require_none(faults(Grid{.drive = question.drive, .axes = {*report.axis}}));
  const std::vector<NamedDrive> drives = named_along(*report.axis, question.drive);
  report.drives = compare(drives, {}, progress);
  return comparison_plot(report);
}

Plot run_plot(const PictureQuestion& question, Progress& progress) {
  if (question.varied.empty()) {
    refuse("varied", "none", "must have a number with a tolerance, such as \"0.61 oz in2 ± 10 %\"");
  }
  TolerancedDrive series{question.drive, question.varied};
  const bool searched = is_searched(series);
  if (!searched) series.nominal = without_ended_signals(series.nominal);
  const StudyQuestions asked{.amplitude =
                                 searched ? Quantity::motor_amplitude : Quantity::amplitude};
  const SamplePlan plan = usual_sampling(series, asked);
  const ToleranceStudy study = study_tolerances(series, plan, asked, progress);
  if (question.kind != PictureKind::indices) {
    return tolerance_plot(question.kind, study, question.drive.angle_unit);
  }
  return indices_plot(study, study_sensitivities(series, plan, asked, progress));
}

MotionPicture picture_of(const Drive& drive, const Motion& motion, const std::string& angle) {
  MotionPicture picture{.drive = in_unit(drive, angle)};
  if (is_normalized(drive)) picture.drive.servo->natural_frequency = 1.0;  // as in all SI
  picture.period = period_of_loop(picture.drive);
  picture.motions.push_back({.motion = motion});
  return picture;
}

}  // namespace

Plot picture_of(const PictureQuestion& asked, Progress& progress) {
  PictureQuestion question = asked;
  question.drive = in_unit(std::move(question.drive), question.angle);
  switch (question.kind) {
    case PictureKind::nyquist:
      return nyquist_plot_of(question, progress);
    case PictureKind::curves:
    case PictureKind::map:
      return grid_plot(question, progress);
    case PictureKind::bifurcation:
      return branches_plot(question, progress);
    case PictureKind::comparison:
      return steps_plot(question, progress);
    case PictureKind::distribution:
    case PictureKind::yield:
    case PictureKind::indices:
      return run_plot(question, progress);
    default:
      return answer_plot(question, progress);
  }
}

Plot time_plot(const Drive& drive, const Motion& motion, const std::string& angle) {
  return time_plot(picture_of(drive, motion, angle));
}

Plot phase_plot(const Drive& drive, const Motion& motion, const std::string& angle, double from) {
  MotionPicture picture = picture_of(drive, motion, angle);
  picture.motions.front().from = from;
  return phase_plot(picture);
}

Plot tolerance_plot(PictureKind kind, const ToleranceStudy& study, const std::string& angle) {
  return tolerance_plot(kind, study, unit_named(angle));
}

}  // namespace gearlash
