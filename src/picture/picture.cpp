#include "picture/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "input/units.hpp"
#include "picture/drawn_curve.hpp"
#include "picture/gnuplot.hpp"
#include "picture/gnuplot_script.hpp"

namespace gearlash {
namespace {

// Colours that the colour-blind tell apart (Okabe and Ito) and that differ in grey; dashes and
// widths say the same once more.
constexpr char load_colour[] = "#0072b2";
constexpr char motor_colour[] = "#d55e00";
constexpr char reference_colour[] = "#555555";
constexpr char gap_colour[] = "#dcdcdc";
constexpr char between_colour[] = "#f5d9a8";  ///< load and motor, in the phase plane
constexpr char apart_colour[] = "#fdf3dd";

std::string numbers_line(const MotionPicture& picture) {
  const NormalizedServo& servo = picture.servo;
  const AngleUnit& angle = picture.units.angle;
  std::string line = fmt::format("damping {}, inertia ratio {}, friction ratio {}, backlash {} {}",
                                 significant(servo.damping, 3), significant(servo.inertia_ratio, 3),
                                 significant(servo.friction_ratio, 3),
                                 significant(angle.from_radians(servo.backlash), 4), angle.name);
  if (servo.restitution > 0.0) line += ", restitution " + significant(servo.restitution, 3);
  if (picture.units.natural_frequency) {
    line += fmt::format(", natural frequency {} rad/s",
                        significant(*picture.units.natural_frequency, 4));
  }
  return line;
}

/// Terminal, title, grid, and a legend below the plot, where it covers nothing.
std::string preamble(const MotionPicture& picture, PictureFormat format) {
  return std::string(terminal(format)) + "set encoding utf8\nset title " +
         quoted(picture.title, "/:Bold") + " offset 0,1.1\nset label 1 " +
         quoted(numbers_line(picture), "/*0.87") +
         " at graph 0.5, screen 0.905 center\n"
         "set tmargin screen 0.88\n"
         "set rmargin screen 0.97\n"
         "set key at screen 0.54, 0.02 bottom center horizontal maxcols 3 Left reverse "
         "samplen 3 spacing 1.25\n"
         "set grid linewidth 0.5 linecolor rgb '#c4c4c4'\n"
         "set tics nomirror out\nset border linewidth 0.8\n";
}

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// With a margin, and never empty.
  std::string text() const {
    const double extent = high > low ? high - low : std::max(1.0, std::abs(high));
    return fmt::format("[{:.7g}:{:.7g}]", low - 0.05 * extent, high + 0.05 * extent);
  }
};

/// Impacts, each unless it would cover the one before it.
class ImpactMarks {
 public:
  ImpactMarks(std::string name, double x_extent, double y_extent)
      : marks_(std::move(name)), x_extent_(x_extent), y_extent_(y_extent) {}

  void add(double x, double y) {
    constexpr double smallest_distance = 0.004;  // of the extent: a fraction of a mark
    if (std::abs(x - x_) < smallest_distance * x_extent_ &&
        std::abs(y - y_) < smallest_distance * y_extent_) {
      return;
    }
    x_ = x;
    y_ = y;
    marks_.row(x, y);
  }
  const DataBlock& block() const { return marks_; }

 private:
  DataBlock marks_;
  double x_extent_;
  double y_extent_;
  double x_ = std::numeric_limits<double>::infinity();
  double y_ = std::numeric_limits<double>::infinity();
};

void require_legible(const MotionPicture& picture) {
  const std::size_t count = picture.trajectory.events().size();
  if (count > most_events_drawn) {
    throw InvalidInput(
        {{"--until", fmt::format("a motion with {} events", count),
          fmt::format("must be shorter to be drawn, {} events at most", most_events_drawn), ""}});
  }
  const ReportUnits& units = picture.units;
  if (picture.trajectory.end_time() > longest_time_drawn) {
    throw InvalidInput(
        {{"--until", significant(units.time(picture.trajectory.end_time()), 6),
          fmt::format("must be at most {} {} to be drawn",
                      significant(units.time(longest_time_drawn), 6), units.time_unit()),
          ""}});
  }
}

// --- time response ---

struct TimeResponse {
  DataBlock curve{"curve"};  ///< time, load, motor, lower and upper edge of the gap
  std::string apart;         ///< commands: rectangles behind the grid
  Span times;
  Span positions;
};

void add_piece(const CurvePiece& piece, double reference, double half_gap, TimeResponse& response) {
  for (const CurvePoint& point : piece.points) {
    const double load = point.load_position + reference;
    response.curve.row(point.time, load, point.motor_position + reference, load - half_gap,
                       load + half_gap);
    response.times.include(point.time);
    response.positions.include(load - half_gap);
    response.positions.include(load + half_gap);
  }
  if (piece.separated) {
    response.apart += fmt::format(
        "set object rectangle from first {:.7g}, graph 0 to first {:.7g}, graph 1 behind fillcolor "
        "rgb '{}' fillstyle solid noborder\n",
        piece.points.front().time, piece.points.back().time, apart_colour);
  }
}

DataBlock impacts_over_time(const std::vector<CurvePiece>& pieces, double reference,
                            const TimeResponse& response) {
  ImpactMarks marks("impacts", response.times.high - response.times.low,
                    response.positions.high - response.positions.low);
  for (const CurvePiece& piece : pieces) {
    if (!piece.ends_with_impact) continue;
    const CurvePoint& point = piece.points.back();
    marks.add(point.time, point.motor_position + reference);
  }
  return marks.block();
}

std::vector<std::string> time_layers(const TimeResponse& response, const DataBlock& impacts,
                                     double reference, bool has_gap) {
  std::vector<std::string> layers;
  if (!response.apart.empty()) {
    layers.push_back(
        fmt::format("keyentry with boxes fill solid noborder linecolor rgb '{}' title "
                    "'faces apart'",
                    apart_colour));
  }
  if (has_gap) {
    layers.push_back(
        fmt::format("$curve using 1:4:5 with filledcurves fill solid noborder "
                    "linecolor rgb '{}' title 'gap, ± half the backlash'",
                    gap_colour));
  }
  layers.push_back(
      fmt::format("{:.7g} with lines linewidth 1 dashtype 4 linecolor rgb '{}' title "
                  "'reference'",
                  reference, reference_colour));
  layers.push_back(
      fmt::format("$curve using 1:2 with lines linewidth 2 linecolor rgb '{}' title "
                  "'load'",
                  load_colour));
  layers.push_back(
      fmt::format("$curve using 1:3 with lines linewidth 1.6 dashtype (8,4) linecolor "
                  "rgb '{}' title 'motor'",
                  motor_colour));
  if (!impacts.is_empty()) {
    layers.emplace_back(
        "$impacts using 1:2 with points pointtype 7 pointsize 0.55 linecolor rgb "
        "'black' title 'impact'");
  }
  return layers;
}

// --- phase plane ---

struct PhasePlane {
  explicit PhasePlane(const std::string& name)
      : curve(name), gaps(name + "_gaps"), impacts_name(name + "_impacts") {}

  DataBlock curve;  ///< load position, load speed, motor position, motor speed
  DataBlock gaps;   ///< closed outlines, but for bounces
  bool leaves_out_bounces = false;
  std::string impacts_name;
  Span positions;
  Span speeds;
};

void add_piece(const CurvePiece& piece, PhasePlane& plane) {
  for (const CurvePoint& point : piece.points) {
    plane.curve.row(point.load_position, point.load_speed, point.motor_position, point.motor_speed);
    plane.positions.include(point.load_position);
    plane.positions.include(point.motor_position);
    plane.speeds.include(point.load_speed);
    plane.speeds.include(point.motor_speed);
  }
  if (!piece.separated) return;
  if (piece.is_bounce) {  // many of them would hide one another
    plane.leaves_out_bounces = true;
    return;
  }
  for (const CurvePoint& point : piece.points)
    plane.gaps.row(point.load_position, point.load_speed);
  for (auto point = piece.points.rbegin(); point != piece.points.rend(); ++point) {
    plane.gaps.row(point->motor_position, point->motor_speed);
  }
  plane.gaps.gap();
}

DataBlock impacts_in_plane(const std::vector<CurvePiece>& pieces, const PhasePlane& plane,
                           double position_extent, double speed_extent) {
  ImpactMarks marks(plane.impacts_name, position_extent, speed_extent);
  for (const CurvePiece& piece : pieces) {
    if (!piece.ends_with_impact) continue;
    const CurvePoint& point = piece.points.back();
    marks.add(point.load_position, point.load_speed);
    marks.add(point.motor_position, point.motor_speed);
  }
  return marks.block();
}

/// Of a motion that is the subject of the picture or its background, which stays free of gaps and
/// impacts: those of a transient would hide the cycle.
struct PhaseStyle {
  bool is_subject;
  double load_width;
  double motor_width;
  double mark_size;
  std::string what;  ///< after "load" and "motor" in the legend
};

void add_fill(const PhasePlane& plane, const std::string& name, const PhaseStyle& style,
              std::vector<std::string>& layers) {
  if (!style.is_subject || plane.gaps.is_empty()) return;
  layers.push_back(fmt::format(
      "${}_gaps using 1:2 with filledcurves closed fill solid noborder "
      "linecolor rgb '{}' title '{}'",
      name, between_colour, plane.leaves_out_bounces ? "crossing the gap" : "faces apart"));
}

void add_lines(const std::string& name, const PhaseStyle& style, bool has_impacts,
               std::vector<std::string>& layers) {
  layers.push_back(
      fmt::format("${} using 1:2 with lines linewidth {} linecolor rgb '{}' title "
                  "'load{}'",
                  name, style.load_width, load_colour, style.what));
  layers.push_back(
      fmt::format("${} using 3:4 with lines linewidth {} dashtype (8,4) linecolor rgb "
                  "'{}' title 'motor{}'",
                  name, style.motor_width, motor_colour, style.what));
  if (style.is_subject && has_impacts) {
    layers.push_back(
        fmt::format("${}_impacts using 1:2 with points pointtype 7 pointsize {} "
                    "linecolor rgb 'black' title 'impact'",
                    name, style.mark_size));
  }
}

/// One period, closed: a cycle that starts after an impact ends before it.
std::vector<CurvePiece> cycle_curve(const MotionPicture& picture) {
  const Trajectory trajectory = simulate(picture.servo, picture.cycle->start,
                                         {.until = picture.cycle->period, .reference = 0.0});
  std::vector<CurvePiece> pieces = drawn_curve(picture.servo, trajectory, picture.units);
  const CurvePoint start = pieces.front().points.front();
  // By rounding, the parting that begins the cycle may come once more at its end.
  constexpr double rounding = 1e-9;
  const double end = pieces.back().points.back().time;
  if (pieces.size() > 1 && end - pieces.back().points.front().time < rounding * end) {
    pieces.pop_back();
  }
  CurvePiece& last = pieces.back();
  const double jump = std::abs(start.load_speed - last.points.back().load_speed);
  const double speed = std::abs(start.load_speed) + std::abs(last.points.back().load_speed);
  constexpr double smallest_visible_jump = 1e-3;
  if (jump > smallest_visible_jump * speed) last.ends_with_impact = true;
  pieces.push_back(
      {.separated = false, .is_bounce = false, .ends_with_impact = false, .points = {start}});
  return pieces;
}

std::string phase_axes(const MotionPicture& picture, const Span& positions, const Span& speeds) {
  const std::string& unit = picture.units.angle.name;
  const std::string per_time = picture.units.natural_frequency ? unit + "/s" : unit + " ω_n";
  return "set xlabel " + quoted("position from the reference (" + unit + ")") + "\nset ylabel " +
         quoted("speed (" + per_time + ")") + "\nset xrange " + positions.text() + "\nset yrange " +
         speeds.text() +
         "\nset xzeroaxis linetype -1 linewidth 0.7\nset yzeroaxis linetype -1 linewidth 0.7\n";
}

}  // namespace

PictureFormat picture_format(const std::string& field, const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".svg") return PictureFormat::svg;
  if (ending == ".png") return PictureFormat::png;
  if (ending == ".pdf") return PictureFormat::pdf;
  throw InvalidInput({{field, shown(path.string()), "must end in .svg, .png or .pdf", ""}});
}

std::string draw_time_response(const MotionPicture& picture, PictureFormat format) {
  require_legible(picture);
  const AngleUnit& angle = picture.units.angle;
  const double reference = angle.from_radians(picture.reference);
  const double half_gap = angle.from_radians(0.5 * picture.servo.backlash);
  const auto pieces = drawn_curve(picture.servo, picture.trajectory, picture.units);
  TimeResponse response;
  response.positions.include(reference);
  for (const CurvePiece& piece : pieces) add_piece(piece, reference, half_gap, response);
  const DataBlock impacts = impacts_over_time(pieces, reference, response);

  std::string script = preamble(picture, format);
  script += fmt::format("set xrange [{:.7g}:{:.7g}]\nset yrange {}\n", response.times.low,
                        std::max(response.times.high, response.times.low + 1e-9),
                        response.positions.text());
  script += "set xlabel " + quoted(picture.units.natural_frequency ? "time (s)" : "time (1/ω_n)") +
            "\nset ylabel " + quoted("position (" + angle.name + ")") + "\n";
  script += response.apart + response.curve.text() + impacts.text();
  script += plot_command(time_layers(response, impacts, reference, half_gap > 0.0));
  return run_gnuplot(script);
}

std::string draw_phase_plane(const MotionPicture& picture, PictureFormat format) {
  require_legible(picture);
  const bool has_cycle = picture.cycle.has_value();
  std::vector<std::vector<CurvePiece>> motions = {
      drawn_curve(picture.servo, picture.trajectory, picture.units)};
  std::vector<PhasePlane> planes = {PhasePlane("motion")};
  std::vector<std::string> names = {"motion"};
  std::vector<PhaseStyle> styles = {has_cycle ? PhaseStyle{false, 0.8, 0.8, 0.0, ", on its way"}
                                              : PhaseStyle{true, 2.0, 1.6, 0.5, ""}};
  if (has_cycle) {
    motions.push_back(cycle_curve(picture));
    planes.emplace_back("cycle");
    names.emplace_back("cycle");
    styles.push_back({true, 3.2, 2.6, 0.8, ", limit cycle"});
  }
  Span positions;
  Span speeds;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (const CurvePiece& piece : motions[i]) add_piece(piece, planes[i]);
    positions.include(planes[i].positions.low);
    positions.include(planes[i].positions.high);
    speeds.include(planes[i].speeds.low);
    speeds.include(planes[i].speeds.high);
  }
  std::string script = preamble(picture, format) + phase_axes(picture, positions, speeds);
  std::vector<std::string> fills;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const DataBlock impacts = impacts_in_plane(
        motions[i], planes[i], positions.high - positions.low, speeds.high - speeds.low);
    script += planes[i].curve.text() + planes[i].gaps.text() + impacts.text();
    add_fill(planes[i], names[i], styles[i], fills);
    add_lines(names[i], styles[i], !impacts.is_empty(), lines);
  }
  fills.insert(fills.end(), lines.begin(), lines.end());
  script += plot_command(fills);
  return run_gnuplot(script);
}

}  // namespace gearlash
