#include "picture/region_map.hpp"

#include "picture/hatching.hpp"

namespace gearlash {
namespace {

/// A parameter's unit in a picture: the author's of angles, else SI.
AngleUnit unit_on_axis(const RegionMapTask& task, const Axis& axis) {
  const std::string unit = unit_of(axis, task.drive);
  return unit == "rad" ? task.angle : AngleUnit{unit == "1" ? "" : unit, 1.0};
}

ChartAxis chart_axis(const RegionMapTask& task, const Axis& axis) {
  const AngleUnit unit = unit_on_axis(task, axis);
  return {.label = std::string(parameter_of(axis, task.drive)->meaning) +
                   (unit.name.empty() ? "" : " (" + unit.name + ")"),
          .logarithmic = axis.logarithmic,
          .low = axis.values.front() / unit.radians,
          .high = axis.values.back() / unit.radians};
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

ContourMap map_of(const RegionMapTask& task, const Axis& x, const Axis& y, Progress& progress) {
  const FeasibleRegion region = feasible_region(task.drive, x, y, task.target, task.cost, progress);
  const MapPoint unit{unit_on_axis(task, x).radians, unit_on_axis(task, y).radians};
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
  const MapPoint now{*present_value(x, task.drive) / unit.x,
                     *present_value(y, task.drive) / unit.y};
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
