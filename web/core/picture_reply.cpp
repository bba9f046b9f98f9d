#include "picture_reply.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "model/reduced_drive.hpp"
#include "picture/drawn_motion.hpp"
#include "picture/motion_style.hpp"

namespace gearlash::web {
namespace {

const char* name_of(MotionRole role) {
  switch (role) {
    case MotionRole::subject:
      return "subject";
    case MotionRole::background:
      return "background";
    case MotionRole::unstable:
      return "unstable";
    case MotionRole::to_rest:
      return "to rest";
    case MotionRole::to_hunting:
      return "to hunting";
    case MotionRole::running_away:
      return "running away";
    case MotionRole::not_known:
      return "not known";
  }
  return "";
}

struct Column {
  const char* name;
  double DrawnPoint::*member;
};
constexpr std::array<Column, 7> columns = {{{"time", &DrawnPoint::time},
                                            {"load", &DrawnPoint::load_position},
                                            {"load_speed", &DrawnPoint::load_speed},
                                            {"motor", &DrawnPoint::motor_position},
                                            {"motor_speed", &DrawnPoint::motor_speed},
                                            {"torque", &DrawnPoint::motor_torque},
                                            {"reference", &DrawnPoint::reference}}};

/// Columns of all pieces, one behind the other.
Json columns_json(const std::vector<DrawnPiece>& pieces, const drive::Sensing& sensing,
                  const AngleUnit& angle, Numbers& numbers) {
  Json json;
  std::vector<double> column;
  const auto add = [&](const char* name, const auto& value_of) {
    column.clear();
    for (const DrawnPiece& piece : pieces) {
      for (const DrawnPoint& point : piece.points) column.push_back(value_of(point));
    }
    json[name] = numbers.add(column);
  };
  for (const Column& one : columns) {
    add(one.name, [&](const DrawnPoint& point) { return point.*one.member; });
  }
  if (!(sensing.resolution > 0.0)) return json;
  const double step = angle.from_radians(sensing.resolution);
  const double share = sensing.load_share_of_position;
  add("encoder", [&](const DrawnPoint& point) {
    const double position = share * point.load_position + (1.0 - share) * point.motor_position;
    return step * std::round(position / step);
  });
  return json;
}

Json motion_json(const DrawnMotion& drawn, const MotionPicture& picture,
                 const drive::Sensing& sensing, Numbers& numbers) {
  Json json = {{"name", drawn.name},
               {"name_of_motor", drawn.name_of_motor.empty() ? drawn.name : drawn.name_of_motor},
               {"role", name_of(drawn.role)},
               {"is_cycle", drawn.is_cycle}};
  std::vector<DrawnPiece> pieces;
  try {
    pieces = legible_curve(picture, drawn.motion);
  } catch (const InvalidInput& error) {
    json["reason"] = error.what();
    return json;
  }
  json["columns"] = columns_json(pieces, sensing, picture.angle, numbers);
  json["pieces"] = json_list(pieces, [](const DrawnPiece& piece) {
    return Json{piece.points.size(), piece.is_apart, piece.is_bounce, piece.ends_with_impact};
  });
  json["events"] = json_list(drawn.motion.events(), [](const MotionEvent& event) {
    return Json{event.time, event.what, event.mode_after};
  });
  return json;
}

Json window_json(const PhaseWindow& window, Numbers& numbers) {
  Json borders = Json::array();
  for (const auto& border : window.borders) {
    std::vector<double> curve;
    for (const auto& [x, y] : border) curve.insert(curve.end(), {x, y});
    borders.push_back(numbers.add(curve));
  }
  return {{"positions", {window.positions.low, window.positions.high}},
          {"speeds", {window.speeds.low, window.speeds.high}},
          {"is_of_motor", window.is_of_motor},
          {"borders", std::move(borders)}};
}

Json points_json(const std::vector<ChartPoint>& points, Numbers& numbers) {
  std::vector<double> curve;
  for (const ChartPoint& point : points) curve.insert(curve.end(), {point.x, point.y});
  return numbers.add(curve);
}

Json curves_json(const std::vector<MapCurve>& curves, Numbers& numbers) {
  return json_list(curves, [&](const MapCurve& points) {
    std::vector<double> curve;
    for (const MapPoint& point : points) curve.insert(curve.end(), {point.x, point.y});
    return numbers.add(curve);
  });
}

Json axis_json(const ChartAxis& axis) {
  return {{"label", axis.label},
          {"logarithmic", axis.logarithmic},
          {"low", json_optional(axis.low)},
          {"high", json_optional(axis.high)},
          {"tics", json_list(axis.tics, [](const auto& tic) {
             return Json{tic.first, tic.second};
           })}};
}

}  // namespace

Json motion_picture_json(const MotionPicture& picture, Numbers& numbers) {
  const drive::ReducedDrive reduced = reduce(picture.drive);
  const AngleUnit& angle = picture.angle;
  Json json = {
      {"title", picture.title},
      {"subtitle", picture.subtitle},
      {"numbers", numbers_line(picture)},
      {"unit", angle.name},
      {"time_unit", is_normalized(picture.drive) ? "1/ω_n" : "s"},
      {"speed_unit", angle.name + (is_normalized(picture.drive) ? " ω_n" : "/s")},
      {"torque_unit", is_normalized(picture.drive) ? "K rad" : "N m"},
      {"gap", angle.from_radians(reduced.backlash)},
      {"torque_limit", std::isfinite(reduced.torque_limit) ? Json(reduced.torque_limit) : Json()}};
  json["motions"] = json_list(picture.motions, [&](const DrawnMotion& drawn) {
    return motion_json(drawn, picture, reduced.sensing, numbers);
  });
  json["window"] = picture.window ? window_json(*picture.window, numbers) : Json(nullptr);
  return json;
}

Json contour_map_json(const ContourMap& map, Numbers& numbers) {
  return {{"title", map.title},
          {"subtitle", map.subtitle},
          {"x", axis_json(map.x)},
          {"y", axis_json(map.y)},
          {"regions", json_list(map.regions,
                                [&](const ColouredRegion& region) {
                                  return Json{{"meaning", region.meaning},
                                              {"colour", region.colour},
                                              {"outlines", curves_json(region.outlines, numbers)}};
                                })},
          {"contours", json_list(map.contours,
                                 [&](const Contour& contour) {
                                   return Json{{"level", contour.level},
                                               {"curves", curves_json(contour.curves, numbers)}};
                                 })},
          {"boundary", curves_json(map.boundary, numbers)},
          {"hatching", curves_json(map.hatching, numbers)},
          {"inner_boundary", curves_json(map.inner_boundary, numbers)},
          {"inner_hatching", curves_json(map.inner_hatching, numbers)},
          {"boundary_meaning", map.boundary_meaning},
          {"hatching_meaning", map.hatching_meaning},
          {"inner_meaning", map.inner_meaning}};
}

Json line_chart_json(const LineChart& chart, Numbers& numbers) {
  return {{"title", chart.title},
          {"subtitle", chart.subtitle},
          {"x", axis_json(chart.x)},
          {"y", axis_json(chart.y)},
          {"curves", json_list(chart.curves,
                               [&](const ChartCurve& curve) {
                                 return Json{{"name", curve.name},
                                             {"line", points_json(curve.line, numbers)},
                                             {"marks", points_json(curve.marks, numbers)},
                                             {"ends", points_json(curve.ends, numbers)}};
                               })},
          {"line_meaning", chart.line_meaning},
          {"mark_meaning", chart.mark_meaning},
          {"end_meaning", chart.end_meaning}};
}

}  // namespace gearlash::web
