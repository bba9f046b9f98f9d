#include "picture/region_map.hpp"

#include "picture/hatching.hpp"

namespace gearlash {
namespace {

/// The author's unit of angles for a backlash, else 1.
double unit_of_axis(const RegionMapTask& task, const std::string& parameter) {
  return task.drive.number(parameter).is_backlash() ? task.angle.radians : 1.0;
}

ChartAxis chart_axis(const RegionMapTask& task, const ParameterAxis& axis) {
  const ChangeableNumber& number = task.drive.number(axis.parameter);
  const std::string& unit = number.is_backlash() ? task.angle.name : number.unit;
  const double size = unit_of_axis(task, axis.parameter);
  return {.label = number.description + (unit == "1" ? "" : " (" + unit + ")"),
          .logarithmic = axis.values.logarithmic,
          .low = axis.values.values.front() / size,
          .high = axis.values.values.back() / size};
}

std::string meaning_of(Cost cost) {
  switch (cost) {
    case Cost::bandwidth:
      return "bandwidth, times now";
    case Cost::stiffness:
      return "stiffness, times now";
    case Cost::damping:
      break;
  }
  return "damping ratio";
}

}  // namespace

ContourMap map_of(const RegionMapTask& task, const ParameterAxis& x, const ParameterAxis& y,
                  Progress& progress) {
  const FeasibleRegion region = feasible_region(task.drive, x, y, task.target, task.cost, progress);
  const MapPoint unit{unit_of_axis(task, x.parameter), unit_of_axis(task, y.parameter)};
  const auto shown = [&](std::vector<MapCurve> curves) {
    for (MapCurve& curve : curves) {
      for (MapPoint& point : curve) point = {point.x / unit.x, point.y / unit.y};
    }
    return curves;
  };
  ContourMap map{.title = "Target: " + task.target_text,
                 .x = chart_axis(task, x),
                 .y = chart_axis(task, y),
                 .boundary = shown(region.boundary),
                 .contour_meaning = meaning_of(task.cost),
                 .boundary_meaning = "limit",
                 .hatching_meaning = "not met",
                 .mark_meaning = "now"};
  for (const Contour& contour : region.costs) {
    map.contours.push_back({contour.level, shown(contour.curves)});
  }
  const MapPoint now{task.drive.present_value(x.parameter) / unit.x,
                     task.drive.present_value(y.parameter) / unit.y};
  const auto within = [](const ChartAxis& axis, double value) {
    return value >= *axis.low && value <= *axis.high;
  };
  if (within(map.x, now.x) && within(map.y, now.y)) map.mark = now;
  map.hatching =
      hatching(map.boundary, Paper(map.x, map.y), {.stretch = [&](const MapPoint& middle) {
                 return side_of_target(task.drive, region, {middle.x * unit.x, middle.y * unit.y},
                                       task.target) == Side::outside;
               }});
  return map;
}

}  // namespace gearlash
