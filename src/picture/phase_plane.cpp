// Drawing motions in the phase plane.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "model/reduced_drive.hpp"
#include "picture/gnuplot.hpp"
#include "picture/motion_style.hpp"

namespace gearlash {
namespace {

constexpr char between_colour[] = "#f5d9a8";  ///< between load and motor

struct Colours {
  const char* load;
  const char* motor;
};
constexpr std::array<Colours, 4> colours = {
    Colours{load_colour, motor_colour}, Colours{"#009e73", "#cc79a7"},
    Colours{"#000000", "#8a8a8a"}, Colours{"#56b4e9", "#e69f00"}};

std::string legend_of(const std::string& shaft, const std::string& name) {
  return name.empty() ? shaft : shaft + ", " + name;
}

const std::string& motor_name(const DrawnMotion& drawn) {
  return drawn.name_of_motor.empty() ? drawn.name : drawn.name_of_motor;
}

/// One motion of the picture.
class PlaneCurve {
 public:
  /// `place` is the index in the picture, `subject` the index among the motions in the foreground.
  PlaneCurve(const DrawnMotion& drawn, std::size_t place, std::size_t subject)
      : drawn_(drawn),
        name_(fmt::format("motion{}", place)),
        number_(subject),
        curve_(name_),
        gaps_(name_ + "_gaps") {}

  void add(const DrawnPiece& piece) {
    for (const DrawnPoint& point : piece.points) {
      const double load = point.load_position - point.reference;
      const double motor = point.motor_position - point.reference;
      curve_.row(load, point.load_speed, motor, point.motor_speed);
      positions.include(load);
      positions.include(motor);
      speeds.include(point.load_speed);
      speeds.include(point.motor_speed);
    }
    if (!piece.is_apart || drawn_.is_background) return;
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

  void mark_impacts(const std::vector<DrawnPiece>& pieces, double width, double height) {
    if (drawn_.is_background) return;
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
    return curve_.text() + (gaps_.is_empty() ? "" : gaps_.text()) + impacts_;
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

  void add_lines(std::vector<std::string>& layers) const {
    const Colours& colour = colours[number_ % colours.size()];
    const double width = drawn_.is_background ? 0.8 : drawn_.is_cycle ? 2.8 : 2.0;
    layers.push_back(
        fmt::format("${} using 1:2 with lines linewidth {} linecolor rgb '{}' title {}", name_,
                    width, colour.load, quoted(legend_of("load", drawn_.name))));
    layers.push_back(fmt::format(
        "${} using 3:4 with lines linewidth {} dashtype (8,4) linecolor rgb '{}' "
        "title {}",
        name_, 0.8 * width, colour.motor, quoted(legend_of("motor", motor_name(drawn_)))));
    if (impacts_.empty()) return;
    layers.push_back(fmt::format(
        "${}_impacts using 1:2 with points pointtype 7 pointsize {} linecolor rgb "
        "'black' {}",
        name_, drawn_.is_cycle ? 0.8 : 0.5, number_ == 0 ? "title 'impact'" : "notitle"));
  }

  Extent positions;
  Extent speeds;

 private:
  const DrawnMotion& drawn_;
  std::string name_;
  std::size_t number_;  ///< among the foreground; gives the colours
  DataBlock curve_;     ///< load position, load speed, motor position, motor speed
  DataBlock gaps_;      ///< closed outlines, without bounces
  bool leaves_out_bounces_ = false;
  std::string impacts_;
};

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
  return "set xlabel " + quoted("position from the reference (" + unit + ")") + "\nset ylabel " +
         quoted("speed (" + per_time + ")") + "\nset xrange " + range_of(positions) +
         "\nset yrange " + range_of(speeds) +
         "\nset xzeroaxis linetype -1 linewidth 0.7\nset yzeroaxis linetype -1 linewidth 0.7\n";
}

/// A bar of the gap's width, for comparison.
std::string gap_bar(const MotionPicture& picture, const Extent& positions, const Extent& speeds) {
  const double gap = picture.angle.from_radians(reduce(picture.drive).backlash);
  if (!(gap > 0.0) || gap > positions.width()) return "";
  const double left = positions.low;
  const double height = speeds.low;
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
    PlaneCurve& curve = curves.emplace_back(drawn, curves.size(), subjects);
    if (!drawn.is_background) ++subjects;
    for (const DrawnPiece& piece : pieces.back()) curve.add(piece);
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
  for (const PlaneCurve& curve : curves) curve.add_lines(layers);
  if (layers.empty()) {
    layers.emplace_back("1/0 notitle");
    data += "set label 2 'no cycle was found' at graph 0.5, graph 0.5 center\n";
  }
  std::vector<std::string> legend = {"faces apart", "impact"};
  for (const DrawnMotion& drawn : picture.motions) {
    legend.push_back(legend_of("load", drawn.name));
    legend.push_back(legend_of("motor", motor_name(drawn)));
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
