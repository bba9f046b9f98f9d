#include "picture/attractor_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "output/report_units.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {
namespace {

constexpr int digits = 6;

struct Curves {
  ChartCurve load;
  ChartCurve motor;
};

/// In the unit of the backlash; positions from the reference.
Curves curves_of(const AttractorPicture& picture, const hybrid::Trajectory& motion, double from,
                 const hybrid::AffineForm& reference) {
  const AngleUnit& unit = picture.angle;
  constexpr int samples = 4000;
  Curves curves;
  for (int i = 0; i <= samples; ++i) {
    const hybrid::State state = motion.at(from + (motion.end_time() - from) * i / samples);
    const drive::ShaftStates shafts = drive::shafts_of(state);
    const double at = reference.at(state.numbers);
    curves.load.line.push_back(
        {unit.from_radians(shafts.load_position - at), unit.from_radians(shafts.load_speed)});
    curves.motor.line.push_back(
        {unit.from_radians(shafts.motor_position - at), unit.from_radians(shafts.motor_speed)});
  }
  return curves;
}

Curves curves_of(const AttractorPicture& picture, const drive::FoundCycle& cycle) {
  const double from = cycle.orbit.start_time;
  const hybrid::Trajectory motion = hybrid::simulate(
      picture.search.system, cycle.orbit.start, {.from = from, .until = from + cycle.period()});
  // The search's positions are from the reference.
  return curves_of(picture, motion, from,
                   {hybrid::Vector::Zero(picture.search.system.size()), 0.0});
}

/// Some of its mean periods, as far on as it was watched.
Curves curves_of(const AttractorPicture& picture, const drive::IrregularFound& irregular,
                 const drive::Outcome& outcome) {
  constexpr double periods = 5.0;
  drive::ReducedDrive drive = picture.drive;
  drive.reference = drive::settled(drive.reference);
  drive.load_torque = drive::settled(drive.load_torque);
  const drive::DriveSystem system = drive::drive_system(drive);
  const hybrid::Trajectory motion = hybrid::simulate(
      system.system, drive::drive_start(drive, system, outcome.start), {.until = outcome.watched});
  const double from = std::max(0.0, motion.end_time() - periods * irregular.period);
  return curves_of(picture, motion, from, system.reference);
}

}  // namespace

std::string draw_attractors(const AttractorPicture& picture, PictureFormat format) {
  const AngleUnit& unit = picture.angle;
  LineChart chart;
  chart.title = picture.title;
  chart.subtitle = "backlash " + significant(unit.from_radians(picture.drive.backlash), digits) +
                   " " + unit.name;
  chart.x.label = "position from the reference, " + unit.name;
  chart.y.label = fmt::format("speed, {}{}", unit.name, picture.is_normalized ? " ω_n" : "/s");
  chart.empty_meaning = "no cycle was found";
  const auto add = [&](Curves curves, const std::string& what) {
    curves.load.name = "load, " + what;
    curves.motor.name = "motor, " + what;
    chart.curves.push_back(std::move(curves.load));
    chart.curves.push_back(std::move(curves.motor));
  };
  for (const drive::FoundCycle& cycle : picture.search.cycles) {
    add(curves_of(picture, cycle), std::string(name_of(cycle.stability)) + " cycle");
  }
  if (chart.curves.empty() && !picture.search.irregular.empty()) {
    const auto outcome = std::find_if(
        picture.search.outcomes.begin(), picture.search.outcomes.end(),
        [](const drive::Outcome& one) { return one.end == drive::MotionEnd::irregular; });
    add(curves_of(picture, picture.search.irregular[outcome->which], *outcome), "for some periods");
  }
  return draw_line_chart(chart, format);
}

}  // namespace gearlash
