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

struct Column {
  const char* name;
  double DrawnPoint::*member;
};
constexpr std::array<Column, 5> columns = {{{"time", &DrawnPoint::time},
                                            {"load", &DrawnPoint::load_position},
                                            {"motor", &DrawnPoint::motor_position},
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
  Json json = {{"name", drawn.name}};
  std::vector<DrawnPiece> pieces;
  try {
    pieces = legible_curve(picture, drawn.motion);
  } catch (const InvalidInput& error) {
    json["reason"] = error.what();
    return json;
  }
  json["columns"] = columns_json(pieces, sensing, picture.angle, numbers);
  json["events"] = json_list(drawn.motion.events(), [](const MotionEvent& event) {
    return Json{event.time, event.what, event.mode_after};
  });
  return json;
}

Json axis_json(const DrawnAxis& axis, bool is_logarithmic) {
  return {{"label", axis.label},
          {"logarithmic", is_logarithmic},
          {"low", axis.ends.low},
          {"high", axis.ends.high},
          {"tics", json_list(axis.tics, [](const Tic& tic) {
             return Json{tic.text, tic.at};
           })}};
}

// In the order of the enumerators.
constexpr std::array layer_kinds = {"line", "area", "marks", "hatching"};
constexpr std::array mark_shapes = {"plus",     "cross",         "star",    "open_square",
                                    "square",   "circle",        "disc",    "open_triangle",
                                    "triangle", "open_wedge",    "wedge",   "open_diamond",
                                    "diamond",  "open_pentagon", "pentagon"};

template <class Enumerator, std::size_t Count>
const char* name_of(Enumerator one, const std::array<const char*, Count>& names) {
  return names.at(static_cast<std::size_t>(one));
}

Json layer_json(const Layer& layer, Numbers& numbers) {
  std::vector<double> points;
  for (const MapPoint& point : layer.points) points.insert(points.end(), {point.x, point.y});
  return {{"kind", name_of(layer.kind, layer_kinds)},
          {"name", layer.name},
          {"colour", layer.colour},
          {"width", layer.width},
          {"dashes", layer.dashes},
          {"mark", name_of(layer.mark, mark_shapes)},
          {"size", layer.size},
          {"points", numbers.add(points)}};
}

Json panel_json(const Panel& panel, Numbers& numbers) {
  return {{"title", panel.title},
          {"x", axis_json(drawn_x(panel), panel.x.logarithmic)},
          {"y", axis_json(drawn_y(panel), panel.y.logarithmic)},
          {"layers",
           json_list(panel.layers, [&](const Layer& layer) { return layer_json(layer, numbers); })},
          {"texts", json_list(panel.texts, [](const PlotText& text) {
             return Json{
                 {"x", text.at.x}, {"y", text.at.y}, {"text", text.text}, {"colour", text.colour}};
           })}};
}

}  // namespace

Json motion_picture_json(const MotionPicture& picture, Numbers& numbers) {
  const drive::ReducedDrive reduced = reduce(picture.drive);
  const AngleUnit& angle = picture.angle;
  Json json = {
      {"subtitle", picture.subtitle},
      {"unit", angle.name},
      {"time_unit", is_normalized(picture.drive) ? "1/ω_n" : "s"},
      {"torque_unit", is_normalized(picture.drive) ? "K rad" : "N m"},
      {"gap", angle.from_radians(reduced.backlash)},
      {"torque_limit", std::isfinite(reduced.torque_limit) ? Json(reduced.torque_limit) : Json()}};
  json["motions"] = json_list(picture.motions, [&](const DrawnMotion& drawn) {
    return motion_json(drawn, picture, reduced.sensing, numbers);
  });
  return json;
}

Json plot_json(const Plot& plot, Numbers& numbers) {
  return {{"title", plot.title},
          {"subtitles", plot.subtitles},
          {"columns", json_list(plot.columns, [&](const PlotColumn& column) {
             return json_list(column,
                              [&](const Panel& panel) { return panel_json(panel, numbers); });
           })}};
}

}  // namespace gearlash::web
