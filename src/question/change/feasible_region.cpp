#include "question/change/feasible_region.hpp"

#include <algorithm>
#include <functional>

#include "base/on_threads.hpp"
#include "base/progress_part.hpp"
#include "base/shared_progress.hpp"
#include "question/analyse.hpp"
#include "question/change/closed_form_line.hpp"

namespace gearlash {
namespace {

Drive drive_at(const Drive& drive, const Axis& x, const Axis& y, const MapPoint& place) {
  Drive changed = drive;
  set_on(x, changed, place.x);
  set_on(y, changed, place.y);
  return changed;
}

double cost_of(Cost cost, const Drivetrain& drive, const Drivetrain& present) {
  switch (cost) {
    case Cost::bandwidth:
      return natural_frequency(drive) / natural_frequency(present);
    case Cost::stiffness:
      return drive.stiffness / present.stiffness;
    case Cost::damping:
      break;
  }
  return normalize(drive).damping;
}

/// The values at every point of the two axes, x fastest.
template <class Value>
std::vector<Value> at_all_points(const Axis& x, const Axis& y,
                                 const std::function<Value(const MapPoint&)>& value_at,
                                 Progress& progress) {
  const std::size_t row = x.values.size();
  std::vector<Value> values(row * y.values.size());
  SharedProgress shared(progress, values.size());
  on_threads(0, values.size(), [&](std::size_t i) {
    if (shared.is_stopped()) return;
    values[i] = value_at({x.values[i % row], y.values[i / row]});
    shared.finish(1);
  });
  return values;
}

std::vector<Contour> cost_lines(const Drive& drive, const Axis& x, const Axis& y, Cost cost,
                                Progress& progress) {
  const std::function<double(const MapPoint&)> cost_at = [&](const MapPoint& place) {
    return cost_of(cost, referred_drivetrain(drive_at(drive, x, y, place)),
                   referred_drivetrain(drive));
  };
  const std::vector<double> costs = at_all_points(x, y, cost_at, progress);
  std::vector<Contour> lines;
  for (const double level : round_levels(costs)) {
    const auto side_of = [level](double value) {
      return value > level ? Side::inside : Side::outside;
    };
    std::vector<Side> corners;
    for (const double value : costs) corners.push_back(side_of(value));
    const auto side_at = [&](const MapPoint& place) { return side_of(cost_at(place)); };
    lines.push_back({level, boundary_of_region(x, y, corners, side_at, {}, progress)});
  }
  return lines;
}

Side side_at(const Drive& drive, const Axis& x, const Axis& y, const MapPoint& place,
             const Target& target, const Wanted& wanted) {
  const Drive changed = drive_at(drive, x, y, place);
  const FinalServo servo = servo_without_checks(changed);
  if (!faults(servo.drivetrain).empty()) return Side::unknown;
  Answer answer = answer_of(servo);
  add_figures(changed, wanted, answer, no_progress());
  return is_met(target, answer) ? Side::inside : Side::outside;
}

}  // namespace

const char* name_of(Cost cost) {
  switch (cost) {
    case Cost::bandwidth:
      return "bandwidth";
    case Cost::damping:
      return "damping";
    case Cost::stiffness:
      break;
  }
  return "stiffness";
}

Axis axis_to_draw(const Drive& drive, std::string_view parameter, std::size_t count) {
  constexpr double factor = 30.0;
  constexpr double of_ten_times_critical = 0.1;
  const ClosedFormLine line = *ClosedFormLine::along(drive, std::string(parameter));
  Bounds range = line.range();
  if (line.present() == 0.0 && !line.is_share()) {
    range.high *= of_ten_times_critical;
  } else if (!line.is_share()) {
    range = {std::max(range.low, line.present() / factor),
             std::min(range.high, line.present() * factor)};
  }
  if (!(range.low < range.high)) return {.path = std::string(parameter), .values = {range.low}};
  return spaced_axis(std::string(parameter), std::string(parameter), range.low, range.high, count,
                     range.low > 0.0 ? Spacing::logarithmic : Spacing::linear);
}

std::size_t values_to_draw(const Drive& drive, std::string_view x, std::string_view y) {
  const auto may_bounce = [&](std::string_view parameter) {
    return ClosedFormLine::along(drive, std::string(parameter))->has_bounces();
  };
  return may_bounce(x) || may_bounce(y) ? 40 : 200;
}

FeasibleRegion feasible_region(const Drive& drive, const Axis& x, const Axis& y,
                               const Target& target, Cost cost, Progress& progress) {
  const Wanted wanted = wanted_for(target, drive);
  const std::function<Side(const MapPoint&)> side = [&](const MapPoint& place) {
    return side_at(drive, x, y, place, target, wanted);
  };
  ProgressPart of_points(progress, 0.0, 0.5);
  ProgressPart of_boundary(progress, 0.5, 0.9);
  ProgressPart of_lines(progress, 0.9, 1.0);
  const std::vector<Side> corners = at_all_points(x, y, side, of_points);
  return {.x = x,
          .y = y,
          .boundary = boundary_of_region(x, y, corners, side, {}, of_boundary),
          .costs = cost_lines(drive, x, y, cost, of_lines)};
}

Side side_of_target(const Drive& drive, const FeasibleRegion& region, const MapPoint& place,
                    const Target& target) {
  return side_at(drive, region.x, region.y, place, target, wanted_for(target, drive));
}

}  // namespace gearlash
