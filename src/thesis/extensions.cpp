#include "thesis/extensions.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/grid.hpp"
#include "thesis/exact_curve.hpp"
#include "thesis/figures.hpp"

namespace gearlash::thesis {
namespace {

NamedCurve named_curve(std::string name, const std::vector<double>& places,
                       const std::function<NormalizedServo(double)>& servo_at) {
  NamedCurve curve = exact_curve(places, servo_at);
  curve.name = std::move(name);
  return curve;
}

/// With bounces: limit cycles are marks joined by a line, which is interrupted where the amplitude
/// jumps. Open circles show the extent of irregular motion.
NamedCurve bouncing_curve(std::string name, const std::vector<double>& places,
                          const std::function<NormalizedServo(double)>& servo_at) {
  constexpr double leap = 0.08;
  NamedCurve result{.name = std::move(name)};
  double before = not_a_number;
  for (const double place : places) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo_at(place));
    const LimitCycle* cycle = largest_stable(analysis);
    const double amplitude = cycle != nullptr ? cycle->amplitude : not_a_number;
    if (std::abs(amplitude / before - 1.0) > leap) result.line.push_back({place, not_a_number});
    result.line.push_back({place, amplitude});
    (cycle != nullptr ? result.marks : result.ends)
        .push_back({place, cycle != nullptr ? amplitude : analysis.irregular_amplitude});
    before = amplitude;
  }
  return result;
}

Plot plot_over(PlotAxis x, const char* title, const char* subtitle,
               const std::vector<NamedCurve>& curves, const char* mark_meaning,
               const char* end_meaning) {
  constexpr double mark_size = 0.3;
  Panel panel{.x = std::move(x), .y = {.name = "size of limit cycle", .unit = "rad", .low = 0.0}};
  add_curves(curves, mark_size, panel);
  explain_curves("", mark_meaning, mark_size, end_meaning, panel);
  return plot_of(title, subtitle, std::move(panel));
}

Extension zero_friction_and_inertia() {
  Extension result{
      .number = 2,
      .wish = "Extend the program to include the zero friction and zero inertia cases.",
      .lesson =
          "With friction all on one side the servo hunts whatever its inertias, as long as both "
          "sides have some; at this damping the lighter the load the more. At a friction ratio of "
          "0 the size is, for the inertia ratios 1/4 to 4 drawn here, within four per cent of that "
          "at 0.04, which the thesis took for it. A side without inertia takes no energy at the "
          "impact; the servo hunts all the same. As the friction moves to the load the swing of a "
          "motor without inertia vanishes, that of a load without inertia grows."};
  const std::vector<std::pair<std::string, double>> ratios = {{"massless load", 0.0},
                                                              {"J_L/J_M 1/4", 0.25},
                                                              {"J_L/J_M 1", 1.0},
                                                              {"J_L/J_M 4", 4.0},
                                                              {"massless motor", infinity}};
  const std::vector<NamedCurve> curves = of_each(ratios, [](const auto& one) {
    return named_curve(
        one.first, linear("friction ratio", 0.0, 1.0, 201).values,
        [&](double friction_ratio) { return charted_servo(0.2, one.second, friction_ratio); });
  });
  result.plot = plot_over(
      {.name = "friction ratio, load friction to total friction", .low = 0.0, .high = 1.0},
      "Recommendation 2: zero friction and zero inertia", "damping 0.2, backlash 0.3", curves, "",
      "");
  return result;
}

Extension wide_inertia_ratios() {
  Extension result{
      .number = 3,
      .wish = "Extend the program to include a larger range of inertia ratios.",
      .lesson =
          "At a friction ratio of 0.2 the curves are flat beyond an inertia ratio of 30: for the "
          "same damping coefficient a heavier load neither calms the servo nor makes it worse, the "
          "motor's inertia then being negligible. Below 1/10 everything depends on damping: at 0.1 "
          "the servo swings by two to three times the backlash, from 0.4 on it comes to rest."};
  std::vector<NamedCurve> curves;
  for (int tenth = 1; tenth <= charted_dampings; ++tenth) {
    curves.push_back(named_curve(
        fmt::format("damping 0.{}", tenth), logarithmic("inertia ratio", 1e-3, 1e3, 601).values,
        [tenth](double ratio) { return charted_servo(tenth / 10.0, ratio, 0.2); }));
  }
  result.plot = plot_over(
      {.name = "inertia ratio, load to motor", .logarithmic = true, .low = 1e-3, .high = 1e3},
      "Recommendation 3: inertia ratios from 1/1000 to 1000", "friction ratio 0.2, backlash 0.3",
      curves, "", "hunting ends");
  return result;
}

Extension elastic_contact(Progress& progress) {
  Extension result{
      .number = 4,
      .wish =
          "Reprogram the contact phase to include the case of elastic contact and to include "
          "the \"lossy\" case for all types of contact between elastic contact and plastic "
          "contact.",
      .lesson =
          "For these servos the swing becomes smaller on the whole as restitution rises, and up to "
          "a half the plastic charts are right within five per cent, on the safe side. Elsewhere "
          "on "
          "the charts a restitution of a half can take a third off the swing, add a half to it, or "
          "keep it from repeating; up to a tenth they hold within one per cent. Beyond a half, "
          "steady swings end and "
          "begin again, and one gives way to another at a leap: where a curve is broken none was "
          "found, and the motion goes on without repeating."};
  std::vector<NamedCurve> curves;
  constexpr std::array dampings = {0.1, 0.19, 0.3, 0.5};
  for (const double damping : dampings) {
    const auto servo_at = [damping](double restitution) {
      NormalizedServo servo = charted_servo(damping, 2.0, 0.1);
      servo.restitution = restitution;
      return servo;
    };
    curves.push_back(bouncing_curve(fmt::format("damping {}", damping),
                                    linear("restitution", 0.0, 1.0, 51).values, servo_at));
    if (!progress.go_on(static_cast<double>(curves.size()) / dampings.size())) break;
  }
  result.plot = plot_over({.name = "restitution", .low = 0.0, .high = 1.0},
                          "Recommendation 4: from plastic to elastic contact",
                          "friction ratio 0.1, inertia ratio 2, backlash 0.3", curves,
                          "steady swing, the largest", "does not repeat: half its extent");
  return result;
}

}  // namespace

Extension extension(int number, Progress& progress) {
  switch (number) {
    case 2:
      return zero_friction_and_inertia();
    case 3:
      return wide_inertia_ratios();
    case 4:
      return elastic_contact(progress);
    default:
      throw std::out_of_range("no such recommendation");
  }
}

}  // namespace gearlash::thesis
