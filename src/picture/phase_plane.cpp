// Drawing motions in the phase plane.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "model/reduced_drive.hpp"
#include "picture/axis_scale.hpp"
#include "picture/gnuplot.hpp"
#include "picture/motion_style.hpp"

namespace gearlash {
namespace {

constexpr char between_colour[] = "#f5d9a8";  ///< between load and motor

struct Colours {
  const char* load;
  const char* motor;
};
constexpr std::array<Colours, 4> shaft_colours = {
    Colours{load_colour, motor_colour}, Colours{"#009e73", "#cc79a7"},
    Colours{"#000000", "#8a8a8a"}, Colours{"#56b4e9", "#e69f00"}};

std::string legend_of(const std::string& shaft, const std::string& name) {
  return name.empty() ? shaft : shaft + ", " + name;
}

const std::string& motor_name(const DrawnMotion& drawn) {
  return drawn.name_of_motor.empty() ? drawn.name : drawn.name_of_motor;
}

/// The style and the name of a thin line of one shaft.
struct ThinStyle {
  const char* line;
  const char* name;
};
ThinStyle thin_style(MotionRole role) {
  switch (role) {
    case MotionRole::to_rest:
      return {"linewidth 0.9 dashtype (3,3) linecolor rgb '#6e6e6e'", "on its way to rest"};
    case MotionRole::to_hunting:
      return {"linewidth 0.9 linecolor rgb '#56b4e9'", "on its way to hunting"};
    case MotionRole::running_away:
      return {"linewidth 0.9 dashtype (12,3,3,3) linecolor rgb '#aa0000'", "running away"};
    default:
      return {"linewidth 0.9 dashtype (1,4) linecolor rgb '#000000'", "end not known"};
  }
}

bool is_thin(MotionRole role) { return role >= MotionRole::to_rest; }

/// One motion of the picture.
class PlaneCurve {
 public:
  /// `place` is the index in the picture, `subject` the index among the motions in the foreground.
  PlaneCurve(const DrawnMotion& drawn, const MotionPicture& picture, std::size_t place,
             std::size_t subject)
      : drawn_(drawn),
        window_(picture.window ? &*picture.window : nullptr),
        name_(fmt::format("motion{}", place)),
        number_(subject),
        curve_(name_),
        leaps_(name_ + "_leaps"),
        gaps_(name_ + "_gaps") {}

  /// Speeds that leap between two pieces are not joined by the line of the motion.
  void add(const std::vector<DrawnPiece>& pieces) {
    double fastest = 0.0;
    for (const DrawnPiece& piece : pieces) {
      for (const DrawnPoint& point : piece.points) {
        fastest = std::max({fastest, std::abs(point.load_speed), std::abs(point.motor_speed)});
      }
    }
    constexpr double visible_leap = 1e-3;
    const DrawnPoint* last = nullptr;
    for (const DrawnPiece& piece : pieces) {
      const DrawnPoint& first = piece.points.front();
      if (last != nullptr &&
          std::max(std::abs(first.load_speed - last->load_speed),
                   std::abs(first.motor_speed - last->motor_speed)) > visible_leap * fastest) {
        curve_.gap();
        add_leap(*last, first);
      }
      add(piece);
      last = &piece.points.back();
    }
  }

  void mark_impacts(const std::vector<DrawnPiece>& pieces, double width, double height) {
    if (drawn_.role != MotionRole::subject) return;
    ImpactMarks marks(name_ + "_impacts", width, height);
    for (const DrawnPiece& piece : pieces) {
      if (!piece.ends_with_impact) continue;
      const DrawnPoint& point = piece.points.back();
      marks.add(point.load_position - point.reference, point.load_speed);
      marks.add(point.motor_position - point.reference, point.motor_speed);
    }
    if (!marks.block().is_empty()) impacts_ = marks.block().text();
  }

  std::string data() const {
    return curve_.text() + (leaps_.is_empty() ? "" : leaps_.text()) +
           (gaps_.is_empty() ? "" : gaps_.text()) + impacts_;
  }

  /// Lowest first.
  void add_fill(std::vector<std::string>& layers) const {
    if (gaps_.is_empty()) return;
    layers.push_back(
        fmt::format("${}_gaps using 1:2 with filledcurves closed fill solid {} noborder "
                    "linecolor rgb '{}' {}",
                    name_, number_ == 0 ? "1" : "0.5", between_colour,
                    number_ > 0           ? "notitle"
                    : leaves_out_bounces_ ? "title 'crossing the gap'"
                                          : "title 'faces apart'"));
  }

  /// `is_first`: of its role, which is then named.
  void add_lines(std::vector<std::string>& layers, bool is_first) const {
    if (is_thin(drawn_.role)) {
      const ThinStyle style = thin_style(drawn_.role);
      const bool is_of_motor = window_ != nullptr && window_->is_of_motor;
      const std::string title =
          is_first ? "title " + quoted(legend_of(is_of_motor ? "motor" : "load", style.name))
                   : "notitle";
      layers.push_back(fmt::format("${} using {} with lines {} {}", name_,
                                   is_of_motor ? "3:4" : "1:2", style.line, title));
      add_leap_lines(layers, is_of_motor ? 3 : 1);
      return;
    }
    const bool is_unstable = drawn_.role == MotionRole::unstable;
    const Colours colour =
        is_unstable ? Colours{"#000000", "#8a8a8a"} : shaft_colours[number_ % shaft_colours.size()];
    const double width = drawn_.role == MotionRole::background ? 0.8
                         : is_unstable                         ? 1.6
                         : drawn_.is_cycle                     ? 2.8
                                                               : 2.0;
    layers.push_back(
        fmt::format("${} using 1:2 with lines linewidth {}{} linecolor rgb '{}' "
                    "title {}",
                    name_, width, is_unstable ? " dashtype (2,2)" : "", colour.load,
                    quoted(legend_of("load", drawn_.name))));
    layers.push_back(
        fmt::format("${} using 3:4 with lines linewidth {} dashtype {} linecolor rgb '{}' title {}",
                    name_, 0.8 * width, is_unstable ? "(6,3,1,3)" : "(8,4)", colour.motor,
                    quoted(legend_of("motor", motor_name(drawn_)))));
    add_leap_lines(layers, 1);
    add_leap_lines(layers, 3);
    if (impacts_.empty()) return;
    layers.push_back(fmt::format(
        "${}_impacts using 1:2 with points pointtype 7 pointsize {} linecolor rgb "
        "'black' {}",
        name_, drawn_.is_cycle ? 0.8 : 0.5, number_ == 0 ? "title 'impact'" : "notitle"));
  }

  MotionRole role() const { return drawn_.role; }

  Extent positions;
  Extent speeds;

 private:
  void add(const DrawnPiece& piece) {
    for (const DrawnPoint& point : piece.points) {
      const double load = point.load_position - point.reference;
      const double motor = point.motor_position - point.reference;
      if (is_thin(drawn_.role) && is_far_away(point)) {
        if (!is_interrupted_) curve_.gap();
        is_interrupted_ = true;
        continue;
      }
      is_interrupted_ = false;
      curve_.row(load, point.load_speed, motor, point.motor_speed);
      positions.include(load);
      positions.include(motor);
      speeds.include(point.load_speed);
      speeds.include(point.motor_speed);
    }
    if (!piece.is_apart || drawn_.role != MotionRole::subject || window_ != nullptr) return;
    if (piece.is_bounce) {  // many bounces would hide one another
      leaves_out_bounces_ = true;
      return;
    }
    for (const DrawnPoint& point : piece.points) {
      gaps_.row(point.load_position - point.reference, point.load_speed);
    }
    for (auto point = piece.points.rbegin(); point != piece.points.rend(); ++point) {
      gaps_.row(point->motor_position - point->reference, point->motor_speed);
    }
    gaps_.gap();
  }

  /// More than a window's width outside, where nothing is seen of it.
  bool is_far_away(const DrawnPoint& point) const {
    if (window_ == nullptr) return false;
    const auto is_far = [](double value, const Bounds& range) {
      const double width = range.high - range.low;
      return value < range.low - width || value > range.high + width;
    };
    const double shown = window_->is_of_motor ? point.motor_position : point.load_position;
    return is_far(shown - point.reference, window_->positions) ||
           is_far(window_->is_of_motor ? point.motor_speed : point.load_speed, window_->speeds);
  }

  void add_leap(const DrawnPoint& before, const DrawnPoint& after) {
    for (const DrawnPoint* point : {&before, &after}) {
      leaps_.row(point->load_position - point->reference, point->load_speed,
                 point->motor_position - point->reference, point->motor_speed);
    }
    leaps_.gap();
  }

  void add_leap_lines(std::vector<std::string>& layers, int column) const {
    if (leaps_.is_empty()) return;
    layers.push_back(fmt::format(
        "${}_leaps using {}:{} with lines linewidth 0.8 dashtype (1,3) linecolor rgb '#555555' "
        "notitle",
        name_, column, column + 1));
  }

  const DrawnMotion& drawn_;
  const PhaseWindow* window_;
  std::string name_;
  std::size_t number_;  ///< among the foreground; gives the colours
  DataBlock curve_;     ///< load position, load speed, motor position, motor speed
  DataBlock leaps_;     ///< likewise, before and after
  DataBlock gaps_;      ///< closed outlines, without bounces
  bool leaves_out_bounces_ = false;
  bool is_interrupted_ = true;
  std::string impacts_;
};

/// Marks of the starts by what they lead to, and the borders between them.
struct StartLayers {
  std::string data;
  std::vector<std::string> layers;
  std::vector<std::string> names;
};

StartLayers start_layers(const MotionPicture& picture) {
  struct Mark {
    MotionRole leads;
    const char* style;
    const char* name;
  };
  constexpr std::array marks = {
      Mark{MotionRole::to_rest, "pointtype 7 pointsize 0.25 linecolor rgb '#444444'",
           "start that leads to rest"},
      Mark{MotionRole::to_hunting, "pointtype 6 pointsize 0.5 linecolor rgb '#0072b2'",
           "to hunting"},
      Mark{MotionRole::running_away, "pointtype 2 pointsize 0.65 linecolor rgb '#aa0000'",
           "to running away"},
      Mark{MotionRole::not_known, "pointtype 1 pointsize 0.45 linecolor rgb '#000000'",
           "to an end not known"}};
  StartLayers drawn;
  if (!picture.window) return drawn;
  for (const Mark& mark : marks) {
    DataBlock block(fmt::format("starts{}", static_cast<int>(mark.leads)));
    for (const DrawnStart& start : picture.window->starts) {
      if (start.leads == mark.leads) block.row(start.position, start.speed);
    }
    if (block.is_empty()) continue;
    drawn.data += block.text();
    drawn.layers.push_back(fmt::format("$starts{} using 1:2 with points {} title {}",
                                       static_cast<int>(mark.leads), mark.style,
                                       quoted(mark.name)));
    drawn.names.emplace_back(mark.name);
  }
  DataBlock borders("borders");
  for (const auto& curve : picture.window->borders) {
    for (const auto& [position, speed] : curve) borders.row(position, speed);
    borders.gap();
  }
  if (borders.is_empty()) return drawn;
  drawn.data += borders.text();
  drawn.layers.emplace_back(
      "$borders using 1:2 with lines linewidth 2 dashtype (10,3) linecolor rgb '#e69f00' title "
      "'border between basins'");
  drawn.names.emplace_back("border between basins");
  return drawn;
}

/// The pieces of a motion. A cycle is closed; if it starts just after an impact, it ends with that
/// one.
std::vector<DrawnPiece> curve_of(const MotionPicture& picture, const DrawnMotion& drawn) {
  std::vector<DrawnPiece> pieces = legible_curve(picture, drawn.motion);
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

std::string axes(const MotionPicture& picture, const Extent& positions, const Extent& speeds) {
  const std::string& unit = picture.angle.name;
  const std::string per_time = is_normalized(picture.drive) ? unit + " ω_n" : unit + "/s";
  const Bounds right = picture.window ? picture.window->positions : widened(positions, 0.05);
  const Bounds up = picture.window ? picture.window->speeds : widened(speeds, 0.05);
  const AxisScale x = axis_scale('x', "position from the reference", unit, right, 7);
  const AxisScale y = axis_scale('y', "speed", per_time, up, 7);
  return "set xlabel " + quoted(x.label) + "\nset ylabel " + quoted(y.label) + "\n" + x.tics +
         y.tics +
         fmt::format("set xrange [{:.7g}:{:.7g}]\nset yrange [{:.7g}:{:.7g}]\n", right.low,
                     right.high, up.low, up.high) +
         "set xzeroaxis linetype -1 linewidth 0.7\nset yzeroaxis linetype -1 linewidth 0.7\n";
}

/// A bar of the gap's width, for comparison.
std::string gap_bar(const MotionPicture& picture, const Extent& positions, const Extent& speeds) {
  const double gap = picture.angle.from_radians(reduce(picture.drive).backlash);
  const Bounds right = picture.window ? picture.window->positions : positions;
  const Bounds up = picture.window ? picture.window->speeds : speeds;
  const double width = right.high - right.low;
  constexpr double visible = 0.005;  // of the axis
  if (gap < visible * width || gap > (picture.window ? 0.7 : 1.0) * width) return "";
  const double inside = picture.window ? 0.04 : -0.025;  // of the axes
  const double left = right.low + std::max(inside, 0.0) * width;
  const double height = up.low + inside * (up.high - up.low);
  return fmt::format(
      "set arrow 1 from {:.7g},{:.7g} to {:.7g},{:.7g} heads size graph 0.008,90 front linewidth "
      "1.5\nset label 4 {} at {:.7g},{:.7g} left offset 0.6,0 front\n",
      left, height, left + gap, height, quoted("backlash", "/*0.87"), left + gap, height);
}

}  // namespace

std::string draw_phase_plane(const MotionPicture& picture, PictureFormat format) {
  std::vector<std::vector<DrawnPiece>> pieces;
  std::vector<PlaneCurve> curves;
  Extent positions;
  Extent speeds;
  std::size_t subjects = 0;
  for (const DrawnMotion& drawn : picture.motions) {
    pieces.push_back(curve_of(picture, drawn));
    PlaneCurve& curve = curves.emplace_back(drawn, picture, curves.size(), subjects);
    if (drawn.role == MotionRole::subject) ++subjects;
    curve.add(pieces.back());
    for (const double value : {curve.positions.low, curve.positions.high}) positions.include(value);
    for (const double value : {curve.speeds.low, curve.speeds.high}) speeds.include(value);
  }
  if (curves.empty()) {
    positions.include(0.0);
    speeds.include(0.0);
  }
  std::string data;
  std::vector<std::string> layers;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    curves[i].mark_impacts(pieces[i], positions.width(), speeds.width());
    data += curves[i].data();
    curves[i].add_fill(layers);
  }
  const StartLayers starts = start_layers(picture);
  data += starts.data;
  layers.insert(layers.end(), starts.layers.begin(), starts.layers.end());
  std::vector<std::string> legend = {"faces apart", "impact"};
  legend.insert(legend.end(), starts.names.begin(), starts.names.end());
  // The main motions lie on top.
  std::set<MotionRole> named;
  for (const bool thin : {true, false}) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const DrawnMotion& drawn = picture.motions[i];
      if (is_thin(drawn.role) != thin) continue;
      const bool is_first = named.insert(drawn.role).second;
      curves[i].add_lines(layers, is_first);
      if (thin) {
        if (is_first) legend.push_back(legend_of("motor", thin_style(drawn.role).name));
        continue;
      }
      legend.push_back(legend_of("load", drawn.name));
      legend.push_back(legend_of("motor", motor_name(drawn)));
    }
  }
  if (curves.empty() && starts.layers.empty()) {
    layers.emplace_back("1/0 notitle");
    data += "set label 2 'no cycle was found' at graph 0.5, graph 0.5 center\n";
  }
  return run_gnuplot(terminal(format) +
                         heading(picture.title, picture.subtitle.empty() ? numbers_line(picture)
                                                                         : picture.subtitle) +
                         "set grid linewidth 0.5 linecolor rgb '#c4c4c4'\n" +
                         legend_below(legend, format).commands + axes(picture, positions, speeds) +
                         gap_bar(picture, positions, speeds) + data + plot_command(layers),
                     picture.title);
}

}  // namespace gearlash
