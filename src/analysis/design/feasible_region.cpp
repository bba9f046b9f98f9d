#include "analysis/design/feasible_region.hpp"

#include <algorithm>
#include <functional>

#include "base/on_threads.hpp"
#include "base/progress_part.hpp"
#include "base/shared_progress.hpp"

namespace gearlash {
namespace {

Drivetrain drive_at(const ChangeableDrive& drive, const ParameterAxis& x, const ParameterAxis& y,
                    const MapPoint& place) {
  return drive.with(x.parameter, place.x, y.parameter, place.y);
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
std::vector<Value> at_all_points(const ParameterAxis& x, const ParameterAxis& y,
                                 const std::function<Value(const MapPoint&)>& value_at,
                                 Progress& progress) {
  const std::size_t row = x.values.values.size();
  std::vector<Value> values(row * y.values.values.size());
  SharedProgress shared(progress, values.size());
  on_threads(0, values.size(), [&](std::size_t i) {
    if (shared.is_stopped()) return;
    values[i] = value_at({x.values.values[i % row], y.values.values[i / row]});
    shared.finish(1);
  });
  return values;
}

std::vector<Contour> cost_lines(const ChangeableDrive& drive, const ParameterAxis& x,
                                const ParameterAxis& y, Cost cost, Progress& progress) {
  const std::function<double(const MapPoint&)> cost_at = [&](const MapPoint& place) {
    return cost_of(cost, drive_at(drive, x, y, place), drive.drivetrain());
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
    lines.push_back(
        {level, boundary_of_region(x.values, y.values, corners, side_at, {}, progress)});
  }
  return lines;
}

Side side_at(const ChangeableDrive& drive, const ParameterAxis& x, const ParameterAxis& y,
             const MapPoint& place, const Target& target) {
  const Drivetrain changed = drive_at(drive, x, y, place);
  if (!validate(changed).empty()) return Side::unknown;
  return is_met(target, performance_of(changed)) ? Side::inside : Side::outside;
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

ParameterAxis parameter_axis(std::string_view parameter, const Bounds& range, std::size_t count) {
  return {std::string(parameter),
          spaced_axis(std::string(parameter), "", range.low, range.high, count,
                      range.low > 0.0 ? Spacing::logarithmic : Spacing::linear)};
}

std::size_t values_to_draw(const ChangeableDrive& drive, std::string_view x, std::string_view y) {
  const bool may_bounce = drive.drivetrain().restitution > 0.0 ||
                          drive.number(x).is_restitution() || drive.number(y).is_restitution();
  return may_bounce ? 40 : 400;
}

Bounds range_to_draw(const ChangeableDrive& drive, std::string_view parameter) {
  constexpr double factor = 30.0;
  constexpr double of_ten_times_critical = 0.1;
  const Bounds whole = drive.range(parameter);
  const double present = drive.present_value(parameter);
  if (drive.number(parameter).is_restitution()) return whole;
  if (present == 0.0) return {whole.low, of_ten_times_critical * whole.high};
  return {std::max(whole.low, present / factor), std::min(whole.high, present * factor)};
}

FeasibleRegion feasible_region(const ChangeableDrive& drive, const ParameterAxis& x,
                               const ParameterAxis& y, const Target& target, Cost cost,
                               Progress& progress) {
  const std::function<Side(const MapPoint&)> side = [&](const MapPoint& place) {
    return side_at(drive, x, y, place, target);
  };
  ProgressPart of_points(progress, 0.0, 0.5);
  ProgressPart of_boundary(progress, 0.5, 0.9);
  ProgressPart of_lines(progress, 0.9, 1.0);
  const std::vector<Side> corners = at_all_points(x, y, side, of_points);
  return {.x = x,
          .y = y,
          .boundary = boundary_of_region(x.values, y.values, corners, side, {}, of_boundary),
          .costs = cost_lines(drive, x, y, cost, of_lines)};
}

Side side_of_target(const ChangeableDrive& drive, const FeasibleRegion& region,
                    const MapPoint& place, const Target& target) {
  return side_at(drive, region.x, region.y, place, target);
}

}  // namespace gearlash
