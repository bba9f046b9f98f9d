#include "thesis/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/lists.hpp"
#include "base/progress_part.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/grid.hpp"
#include "thesis/exact_curve.hpp"
#include "thesis/settled_cycle.hpp"

namespace gearlash::thesis {
namespace {

const std::vector<double> inertia_ratios(charted_inertia_ratios.begin(),
                                         charted_inertia_ratios.end());
const std::vector<double> friction_ratios(charted_friction_ratios.begin(),
                                          charted_friction_ratios.end());
const std::vector<double> backlashes = {0.1, 0.2, 0.3, 0.4, 0.5};

std::string ratio_text(double ratio) {
  return ratio < 1.0 ? fmt::format("1/{:.0f}", 1.0 / ratio) : fmt::format("{:.0f}", ratio);
}

std::vector<FigureCurve> by_damping(double inertia_ratio, double friction_ratio) {
  std::vector<FigureCurve> curves;
  for (int tenth = 1; tenth <= charted_dampings; ++tenth) {
    curves.push_back({fmt::format("damping 0.{}", tenth),
                      charted_servo(tenth / 10.0, inertia_ratio, friction_ratio)});
  }
  return curves;
}

std::vector<FigureCurve> by_inertia_ratio(const std::vector<double>& ratios,
                                          double friction_ratio) {
  return of_each(ratios, [&](double ratio) {
    return FigureCurve{"J_L/J_M " + ratio_text(ratio), charted_servo(0.1, ratio, friction_ratio)};
  });
}

Figure design_chart(int number, double friction_ratio) {
  return {number,
          fmt::format("Design chart for friction ratio of {:.1f} and backlash equal to 0.3",
                      friction_ratio),
          Along::inertia_ratio, inertia_ratios, by_damping(1.0, friction_ratio)};
}

std::vector<Figure> make_figures() {
  return {{2, "Size of limit cycle for damping coefficient equal to 0.1 and backlash equal to 0.3",
           Along::friction_ratio, friction_ratios, by_inertia_ratio(inertia_ratios, 0.2)},
          {3, "Size of limit cycle for balanced inertia and backlash equal to 0.3",
           Along::friction_ratio, friction_ratios, by_damping(1.0, 0.2)},
          {4, "Size of limit cycle for balanced inertia and friction ratio of 0.2", Along::backlash,
           backlashes, by_damping(1.0, 0.2)},
          {5,
           "Size of limit cycle for balanced inertia, friction ratio equal to all values, damping "
           "coefficient 0.1",
           Along::backlash,
           backlashes,
           {{"friction ratio 0.04", charted_servo(0.1, 1.0, 0.04)},
            {"friction ratio 0.2", charted_servo(0.1, 1.0, 0.2)},
            {"friction ratio 1.0", charted_servo(0.1, 1.0, 1.0)}}},
          {6, "Size of limit cycle for friction ratio of 0.2 and damping coefficient of 0.1",
           Along::backlash, backlashes, by_inertia_ratio({1.0 / 4.0, 1.0, 4.0}, 0.2)},
          design_chart(7, 0.1),
          design_chart(8, 0.2),
          design_chart(9, 0.4),
          design_chart(10, 0.6),
          design_chart(11, 1.0)};
}

/// The places of the continuum, from end to end of the grid.
std::vector<double> places(const Figure& figure) {
  constexpr std::size_t count = 401;
  const double high = figure.grid.back();
  return figure.along == Along::backlash
             ? linear("backlash", 0.0, high, count).values
             : logarithmic("ratio", figure.grid.front(), high, count).values;
}

PlotAxis axis_of(const Figure& figure) {
  switch (figure.along) {
    case Along::friction_ratio:
      return {.name = "friction ratio, load friction to total friction",
              .logarithmic = true,
              .low = friction_ratios.front(),
              .high = friction_ratios.back(),
              .tics = {{0.04, "0.04"},
                       {0.1, "0.1"},
                       {0.2, "0.2"},
                       {0.4, "0.4"},
                       {0.6, "0.6"},
                       {1.0, "1.0"}}};
    case Along::backlash:
      return {.name = "backlash", .unit = "rad", .low = 0.0, .high = figure.grid.back()};
    case Along::inertia_ratio:
      break;
  }
  return {.name = "inertia ratio, load to motor",
          .logarithmic = true,
          .low = inertia_ratios.front(),
          .high = inertia_ratios.back(),
          .tics = {{1.0 / 9.0, "1/9"}, {0.25, "1/4"}, {1.0, "1"}, {4.0, "4"}, {9.0, "9"}}};
}

// --- phase trajectories ---

PhaseFigure phase_figure(int number, double damping, double inertia_ratio, double friction_ratio,
                         double mark_size) {
  constexpr double until = 25.0;
  return {number,
          fmt::format("Phase trajectory for J_L/J_M = {}, F_L/F_Total = {:.1f}, damping {:.1f} and "
                      "backlash 0.3; marks every 0.08 s",
                      inertia_ratio < 1.0 ? "0.25" : ratio_text(inertia_ratio), friction_ratio,
                      damping),
          charted_servo(damping, inertia_ratio, friction_ratio), until, mark_size};
}

struct PhaseCurves {
  NamedCurve load{.name = "load"};
  NamedCurve motor{.name = "motor, in the gap"};
};

/// The step response of the program and of the exact servo, both from rest on the forward face.
void add_exact(const PhaseFigure& figure, PhaseCurves& curves) {
  constexpr double spacing = 0.02;
  const double half_gap = 0.5 * figure.servo.backlash;
  const Trajectory motion = simulate(figure.servo, engaged_start(figure.servo, 0.0, 0.0, 1.0),
                                     {.until = figure.until, .reference = 1.0});
  for (const Segment& segment : motion.segments()) {
    const bool apart = segment.phase.mode == Mode::separated;
    const int points = std::max(1, static_cast<int>((segment.end - segment.start) / spacing));
    for (int i = 0; i <= points; ++i) {
      const double share = static_cast<double>(i) / points;
      // The last point is just before the end, where the state is already that after the event.
      const double time =
          segment.start + (i == points ? 1.0 - 1e-12 : share) * (segment.end - segment.start);
      const ServoState state = motion.at(time);
      curves.load.line.push_back({state.load_position, state.load_speed});
      if (!apart) continue;
      const double motor = state.motor_position - segment.phase.face * half_gap;
      curves.motor.line.push_back({motor, state.motor_speed});
    }
    curves.motor.line.push_back({not_a_number, not_a_number});
  }
}

void add_program(const PhaseFigure& figure, PhaseCurves& curves) {
  Program1960<double> program(program_parameters(figure.servo));
  while (program.line().time < figure.until) {
    program.step([&](const PrintedLine& line) {
      curves.load.marks.push_back({line.load_position, line.load_speed});
      if (!program.combined() && !line.at_contact) {
        curves.motor.marks.push_back({line.motor_position, line.motor_speed});
      }
    });
  }
}

}  // namespace

NormalizedServo charted_servo(double damping, double inertia_ratio, double friction_ratio) {
  return {.damping = damping,
          .inertia_ratio = inertia_ratio,
          .friction_ratio = friction_ratio,
          .backlash = charted_backlash};
}

const std::vector<PhaseFigure>& thesis_phase_figures() {
  static const std::vector<PhaseFigure> figures = {
      phase_figure(12, 0.1, 0.25, 0.2, 0.45), phase_figure(13, 0.6, 4.0, 0.2, 0.2),
      phase_figure(14, 0.1, 1.0, 1.0, 0.45), phase_figure(15, 0.2, 1.0, 1.0, 0.45)};
  return figures;
}

Plot plot_of(const PhaseFigure& figure) {
  PhaseCurves curves;
  add_exact(figure, curves);
  add_program(figure, curves);
  Panel panel{.x = {.name = "position angle, θ", .unit = "rad"},
              .y = {.name = "time rate of change of position angle", .unit = "rad/s"}};
  add_curves({std::move(curves.load), std::move(curves.motor)}, figure.mark_size, panel);
  explain_curves("exact", "program of 1960", figure.mark_size, "", panel);
  return gearlash::plot_of(fmt::format("Figure {}", figure.number), figure.caption,
                           std::move(panel));
}

const std::vector<Figure>& thesis_figures() {
  static const std::vector<Figure> figures = make_figures();
  return figures;
}

NormalizedServo servo_at(const Figure& figure, const FigureCurve& curve, double place) {
  NormalizedServo servo = curve.servo;
  switch (figure.along) {
    case Along::friction_ratio:
      servo.friction_ratio = place;
      break;
    case Along::backlash:
      servo.backlash = place;
      break;
    case Along::inertia_ratio:
      servo.inertia_ratio = place;
      break;
  }
  return servo;
}

NamedCurve work_out(const Figure& figure, const FigureCurve& curve, Progress& progress) {
  NamedCurve drawn =
      exact_curve(places(figure), [&](double place) { return servo_at(figure, curve, place); });
  drawn.name = curve.name;
  for (std::size_t i = 0; i < figure.grid.size(); ++i) {
    const double place = figure.grid[i];
    const SettledCycle cycle =
        run_until_settled(program_parameters(servo_at(figure, curve, place)));
    if (cycle.hunts) drawn.marks.push_back({place, cycle.amplitude});
    if (!progress.go_on(static_cast<double>(i + 1) / static_cast<double>(figure.grid.size())))
      break;
  }
  return drawn;
}

Plot plot_of(const Figure& figure, Progress& progress) {
  std::vector<NamedCurve> curves;
  bool has_ends = false;
  for (const FigureCurve& one : figure.curves) {
    ProgressPart part(progress, curves.size(), figure.curves.size());
    if (!part.go_on(0.0)) break;
    NamedCurve curve = work_out(figure, one, part);
    const bool hunts = any_of(
        curve.line, [](const MapPoint& point) { return point.x > 0.0 && !std::isnan(point.y); });
    if (!hunts) {
      curve.name += ": rests";
      curve.line.clear();
    }
    has_ends = has_ends || !curve.ends.empty();
    curves.push_back(std::move(curve));
  }
  Panel panel{.x = axis_of(figure),
              .y = {.name = "size of limit cycle", .unit = "rad", .low = 0.0}};
  if (figure.along == Along::inertia_ratio) panel.y.high = 1.0;  // one scale for all design charts
  constexpr double mark_size = 0.65;
  add_curves(curves, mark_size, panel);
  explain_curves("exact", "program of 1960", mark_size, has_ends ? "hunting ends" : "", panel);
  return gearlash::plot_of(fmt::format("Figure {}", figure.number), figure.caption,
                           std::move(panel));
}

std::vector<int> figure_numbers() {
  std::vector<int> numbers = of_each(thesis_figures(), &Figure::number);
  add_all(numbers, of_each(thesis_phase_figures(), &PhaseFigure::number));
  return numbers;
}

std::optional<Plot> figure_plot(int number, Progress& progress) {
  for (const Figure& figure : thesis_figures()) {
    if (figure.number == number) return plot_of(figure, progress);
  }
  for (const PhaseFigure& figure : thesis_phase_figures()) {
    if (figure.number == number) return plot_of(figure);
  }
  return std::nullopt;
}

}  // namespace gearlash::thesis
