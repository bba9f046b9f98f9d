// Motions in the phase plane.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/extent.hpp"
#include "base/lists.hpp"
#include "model/reduced_drive.hpp"
#include "picture/curve_panel.hpp"
#include "picture/motion_style.hpp"
#include "picture/plot_making.hpp"

namespace gearlash {
namespace {

struct Colours {
  const char* load;
  const char* motor;
};
constexpr std::array<Colours, 4> shaft_colours = {
    Colours{load_colour, motor_colour}, Colours{"#009e73", "#cc79a7"},
    Colours{"#000000", "#8a8a8a"}, Colours{"#56b4e9", "#e69f00"}};

const Layer leap_style{.colour = "#555555", .width = 0.8, .dashes = "1,3"};

std::string legend_of(const std::string& shaft, const std::string& name) {
  return name.empty() ? shaft : shaft + ", " + name;
}

/// A start, and the thin line of one shaft from it, by what it leads to.
struct WayStyle {
  MotionRole leads;
  Layer start;
  Layer line;
};
const WayStyle way_styles[] = {
    {MotionRole::to_rest,
     {.name = "start that leads to rest", .colour = "#444444", .size = 0.25},
     {.name = "on its way to rest", .colour = "#6e6e6e", .width = 1.3, .dashes = "6,2"}},
    {MotionRole::to_hunting,
     {.name = "to hunting", .colour = load_colour, .mark = Mark::circle},
     {.name = "on its way to hunting", .colour = "#56b4e9", .width = 0.9}},
    {MotionRole::running_away,
     {.name = "to running away", .colour = "#aa0000", .mark = Mark::cross, .size = 0.65},
     {.name = "running away", .colour = "#aa0000", .width = 0.9, .dashes = "12,3,3,3"}},
    {MotionRole::not_known,
     {.name = "to an end not known", .mark = Mark::plus, .size = 0.45},
     {.name = "end not known", .width = 0.9, .dashes = "1,4"}}};

bool is_thin(MotionRole role) { return role >= MotionRole::to_rest; }

/// One shaft's line, without the leaps of its speed, and these.
struct ShaftLine {
  MapCurve line;
  MapCurve leaps;
};

MapPoint load_at(const DrawnPoint& point) {
  return {point.load_position - point.reference, point.load_speed};
}
MapPoint motor_at(const DrawnPoint& point) {
  return {point.motor_position - point.reference, point.motor_speed};
}
using ShaftAt = MapPoint (*)(const DrawnPoint&);

ShaftLine line_of(const std::vector<DrawnPiece>& pieces, ShaftAt at) {
  double fastest = 0.0;
  for_each_point(pieces, [&](const DrawnPoint& point) {
    fastest = std::max({fastest, std::abs(point.load_speed), std::abs(point.motor_speed)});
  });
  constexpr double visible_leap = 1e-3;
  ShaftLine drawn;
  const DrawnPoint* last = nullptr;
  for (const DrawnPiece& piece : pieces) {
    const MapPoint first = at(piece.points.front());
    if (last != nullptr && std::abs(first.y - at(*last).y) > visible_leap * fastest) {
      append({}, drawn.line);
      append({at(*last), first}, drawn.leaps);
    }
    for (const DrawnPoint& point : piece.points) drawn.line.push_back(at(point));
    last = &piece.points.back();
  }
  return drawn;
}

/// The pieces of a motion. A cycle is closed; if it starts just after an impact, it ends with that
/// one.
std::vector<DrawnPiece> curve_of(const MotionPicture& picture, const DrawnMotion& drawn) {
  std::vector<DrawnPiece> pieces = legible_curve(picture, drawn.motion);
  for (DrawnPiece& piece : pieces) {
    std::erase_if(piece.points, [&](const DrawnPoint& point) { return point.time < drawn.from; });
  }
  std::erase_if(pieces, [](const DrawnPiece& piece) { return piece.points.empty(); });
  if (!drawn.is_cycle) return pieces;
  const DrawnPoint start = pieces.front().points.front();
  DrawnPiece& last = pieces.back();
  const double jump = std::abs(start.load_speed - last.points.back().load_speed);
  const double speed = std::abs(start.load_speed) + std::abs(last.points.back().load_speed);
  constexpr double smallest_visible_jump = 1e-3;
  if (jump > smallest_visible_jump * speed) last.ends_with_impact = true;
  pieces.push_back({.points = {start}});
  return pieces;
}

/// The area between both shafts while the faces are apart, without bounces, many of which would
/// hide one another.
Layer apart_area(const std::vector<DrawnPiece>& pieces, bool is_first) {
  Layer area{
      .kind = LayerKind::area, .name = "faces apart", .colour = is_first ? "#f5d9a8" : "#faecd3"};
  for (const DrawnPiece& piece : pieces) {
    if (!piece.is_apart) continue;
    if (piece.is_bounce) {
      area.name = "crossing the gap";
      continue;
    }
    MapCurve outline = of_each(piece.points, load_at);
    for (auto point = piece.points.rbegin(); point != piece.points.rend(); ++point) {
      outline.push_back(motor_at(*point));
    }
    append(outline, area.points);
  }
  if (area.points.empty()) area.name.clear();
  return area;
}

/// Draws motions, the main ones on top.
class PhasePanel {
 public:
  explicit PhasePanel(const MotionPicture& picture)
      : picture_(picture), window_(picture.window ? &*picture.window : nullptr) {
    for (const DrawnMotion& drawn : picture.motions) pieces_.push_back(curve_of(picture, drawn));
    set_axes();
    std::size_t subjects = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (window_ != nullptr || picture.motions[i].role != MotionRole::subject) continue;
      panel.layers.push_back(apart_area(pieces_[i], subjects++ == 0));
    }
    add_starts();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (is_thin(picture.motions[i].role)) add_thin(picture.motions[i].role, pieces_[i]);
    }
    subjects = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!is_thin(picture.motions[i].role)) add_main(picture.motions[i], pieces_[i], subjects);
    }
    if (picture.motions.empty() && panel.layers.empty()) say("no cycle was found", panel);
    add_rulers();
  }

  Panel panel;

 private:
  void set_axes() {
    Extent positions;
    Extent speeds;
    if (pieces_.empty()) {
      positions.include(0.0);
      speeds.include(0.0);
    }
    for (const std::vector<DrawnPiece>& pieces : pieces_) {
      for_each_point(pieces, [&](const DrawnPoint& point) {
        for (const MapPoint& shaft : {load_at(point), motor_at(point)}) {
          positions.include(shaft.x);
          speeds.include(shaft.y);
        }
      });
    }
    x_ = window_ != nullptr ? window_->positions : widened(positions, 0.05);
    y_ = window_ != nullptr ? window_->speeds : widened(speeds, 0.05);
    const std::string& unit = picture_.drive.angle_unit.name;
    panel.x = {.name = "position from the reference", .unit = unit, .low = x_.low, .high = x_.high};
    panel.y = {.name = "speed",
               .unit = is_normalized(picture_.drive) ? unit + " ω_n" : unit + "/s",
               .low = y_.low,
               .high = y_.high};
  }

  void add(Layer layer, const std::string& name, ShaftLine drawn) {
    layer.name = name;
    const auto is_inside = [&](const MapPoint& point) {
      return x_.contains(point.x) && y_.contains(point.y);
    };
    if (any_of(drawn.line, is_inside) || name.empty()) {
      layer.points = near(std::move(drawn.line), panel);
    } else {
      layer.name += ", outside";
    }
    panel.layers.push_back(std::move(layer));
    if (drawn.leaps.empty()) return;
    panel.layers.push_back(with(leap_style, near(std::move(drawn.leaps), panel)));
  }

  void add_thin(MotionRole role, const std::vector<DrawnPiece>& pieces) {
    const bool is_of_motor = window_ != nullptr && window_->is_of_motor;
    const Layer& style =
        way_styles[static_cast<int>(role) - static_cast<int>(MotionRole::to_rest)].line;
    add(style, legend_of(is_of_motor ? "motor" : "load", style.name),
        line_of(pieces, is_of_motor ? motor_at : load_at));
  }

  /// `subjects`: the number of those before.
  void add_main(const DrawnMotion& drawn, const std::vector<DrawnPiece>& pieces,
                std::size_t& subjects) {
    const bool is_unstable = drawn.role == MotionRole::unstable;
    const Colours colour = is_unstable ? Colours{"#000000", "#8a8a8a"}
                                       : shaft_colours[subjects % shaft_colours.size()];
    const double width = drawn.role == MotionRole::background ? 0.8
                         : is_unstable                        ? 1.6
                         : drawn.is_cycle                     ? 2.8
                                                              : 2.0;
    add({.colour = colour.load, .width = width, .dashes = is_unstable ? "2,2" : ""},
        legend_of("load", drawn.name), line_of(pieces, load_at));
    add({.colour = colour.motor, .width = 0.8 * width, .dashes = is_unstable ? "6,3,1,3" : "8,4"},
        legend_of("motor", drawn.name_of_motor.empty() ? drawn.name : drawn.name_of_motor),
        line_of(pieces, motor_at));
    if (drawn.role != MotionRole::subject) return;
    ++subjects;
    MapCurve impacts;
    for (const DrawnPiece& piece : pieces) {
      if (!piece.ends_with_impact) continue;
      impacts.push_back(load_at(piece.points.back()));
      impacts.push_back(motor_at(piece.points.back()));
    }
    panel.layers.push_back(impact_marks(impacts, x_, y_, drawn.is_cycle ? 0.8 : 0.5));
  }

  /// Marks of the starts by what they lead to, and the borders between them.
  void add_starts() {
    if (window_ == nullptr) return;
    for (const WayStyle& style : way_styles) {
      Layer marks = style.start;
      marks.kind = LayerKind::marks;
      for (const DrawnStart& start : window_->starts) {
        if (start.leads == style.leads) marks.points.push_back({start.position, start.speed});
      }
      if (!marks.points.empty()) panel.layers.push_back(std::move(marks));
    }
    if (window_->borders.empty()) return;
    panel.layers.push_back({.name = "border between basins",
                            .colour = "#e69f00",
                            .width = 2.0,
                            .dashes = "10,3",
                            .points = joined(window_->borders)});
  }

  /// Lines at 0, and a bar of the gap's width for comparison.
  void add_rulers() {
    panel.layers.push_back(zero_lines(panel, {.width = 0.7}));
    const double gap = picture_.drive.angle_unit.from_radians(reduce(picture_.drive).backlash);
    const double width = x_.high - x_.low;
    const double height = y_.high - y_.low;
    constexpr double visible = 0.005;  // of the axis
    if (gap < visible * width || gap > 0.7 * width) return;
    const double left = x_.low + 0.03 * width;
    const double up = y_.low + 0.04 * height;
    const Bounds ends{up - 0.01 * height, up + 0.01 * height};
    panel.layers.push_back({.width = 1.5,
                            .points = joined({{{left, ends.low}, {left, ends.high}},
                                              {{left, up}, {left + gap, up}},
                                              {{left + gap, ends.low}, {left + gap, ends.high}}})});
    constexpr double half_a_word = 0.06;
    panel.texts.push_back({.at = {left + gap + half_a_word * width, up}, .text = "backlash"});
  }

  const MotionPicture& picture_;
  const PhaseWindow* window_;
  std::vector<std::vector<DrawnPiece>> pieces_;
  Bounds x_;
  Bounds y_;
};

}  // namespace

Plot phase_plot(const MotionPicture& picture) {
  return plot_of(picture.title, picture.subtitle.empty() ? numbers_line(picture) : picture.subtitle,
                 PhasePanel(picture).panel);
}

}  // namespace gearlash
