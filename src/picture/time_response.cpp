// Drawing motions over time: position, its end enlarged, gap, torque.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/reduced_drive.hpp"
#include "output/report_units.hpp"
#include "picture/gnuplot.hpp"
#include "picture/motion_style.hpp"

namespace gearlash {
namespace {

constexpr char reference_colour[] = "#555555";
constexpr char gap_colour[] = "#dcdcdc";
constexpr char apart_colour[] = "#fdf3dd";
constexpr char limit_colour[] = "#aa0000";

/// The share of the time after which the end begins.
constexpr double end_share = 2.0 / 3.0;

struct Response {
  /// time, load, motor, the gap's edges around the load (2), gap, torque, reference; then load,
  /// motor and the gap's edges relative to the reference.
  DataBlock curve{"curve"};
  std::string apart;  ///< commands: rectangles behind the grid
  std::string impacts;
  double end_time = 0.0;
  double half_gap = 0.0;
  Extent positions;
  Extent last_load;   ///< relative to the reference, at the end
  Extent last_motor;  ///< relative to the reference, at the end
  Extent gaps;
  Extent torques;
};

void add_point(const DrawnPoint& point, Response& response) {
  const double load = point.load_position;
  const double half = response.half_gap;
  const double error = load - point.reference;
  const double motor_error = point.motor_position - point.reference;
  response.curve.row(point.time, load, point.motor_position, load - half, load + half,
                     point.motor_position - load, point.motor_torque, point.reference, error,
                     motor_error, error - half, error + half);
  for (const double value : {load - half, load + half, point.motor_position, point.reference}) {
    response.positions.include(value);
  }
  response.gaps.include(point.motor_position - load);
  response.torques.include(point.motor_torque);
  if (point.time < end_share * response.end_time) return;
  response.last_load.include(error);
  response.last_motor.include(motor_error);
}

/// Adds the intervals with separated faces; intervals too close to distinguish are merged.
void add_apart(const std::vector<DrawnPiece>& pieces, Response& response) {
  const double smallest = response.end_time / 2000.0;
  double from = -1.0;
  double to = -1.0;
  const auto close = [&] {
    if (from < 0.0) return;
    response.apart += fmt::format(
        "set object rectangle from first {:.7g}, graph 0 to first {:.7g}, graph 1 behind fillcolor "
        "rgb '{}' fillstyle solid noborder\n",
        from, to, apart_colour);
  };
  for (const DrawnPiece& piece : pieces) {
    if (!piece.is_apart) continue;
    if (from < 0.0 || piece.points.front().time > to + smallest) {
      close();
      from = piece.points.front().time;
    }
    to = piece.points.back().time;
  }
  close();
}

Response response_of(const MotionPicture& picture) {
  const Motion& motion = picture.motions.front().motion;
  const std::vector<DrawnPiece> pieces = legible_curve(picture, motion);
  Response response;
  response.end_time = motion.end_time();
  response.half_gap = 0.5 * picture.angle.from_radians(reduce(picture.drive).backlash);
  for (const double face : {-response.half_gap, response.half_gap}) response.gaps.include(face);
  for (const DrawnPiece& piece : pieces) {
    for (const DrawnPoint& point : piece.points) add_point(point, response);
  }
  add_apart(pieces, response);
  ImpactMarks marks("impacts", response.end_time, response.positions.width());
  for (const DrawnPiece& piece : pieces) {
    const DrawnPoint& last = piece.points.back();
    if (piece.ends_with_impact) marks.add(last.time, last.motor_position);
  }
  if (!marks.block().is_empty()) response.impacts = marks.block().text();
  return response;
}

/// Whether the motion ends in oscillations, or an error, too small for the axis of the whole
/// motion.
bool has_small_end(const Response& response) {
  constexpr double small = 0.2;
  constexpr double nothing = 0.01;  // of the gap
  Extent last = response.last_load;
  last.include(response.last_motor.low);
  last.include(response.last_motor.high);
  last.include(0.0);
  return last.width() < small * response.positions.width() &&
         last.width() > nothing * 2.0 * response.half_gap;
}

struct Panel {
  double height;  ///< of the picture, in units of 1/900 of its width
  std::string label;
  std::string range;
  std::vector<std::string> layers;
};

std::string line(int column, const char* colour, const std::string& style, const char* title) {
  return fmt::format("$curve using 1:{} with lines {} linecolor rgb '{}' title {}", column, style,
                     colour, quoted(title));
}

constexpr char load_style[] = "linewidth 2";
constexpr char motor_style[] = "linewidth 1.6 dashtype (8,4)";
constexpr char reference_style[] = "linewidth 1 dashtype 4";

Panel position_panel(const MotionPicture& picture, const Response& response) {
  Panel panel{270.0, "position (" + picture.angle.name + ")", range_of(response.positions), {}};
  if (response.half_gap > 0.0) {
    panel.layers.push_back(
        fmt::format("$curve using 1:4:5 with filledcurves fill solid noborder linecolor rgb '{}' "
                    "title 'gap, ± half the backlash'",
                    gap_colour));
  }
  panel.layers.push_back(line(8, reference_colour, reference_style, "reference"));
  panel.layers.push_back(line(2, load_colour, load_style, "load"));
  panel.layers.push_back(line(3, motor_colour, motor_style, "motor"));
  if (!response.impacts.empty()) {
    panel.layers.emplace_back(
        "$impacts using 1:2 with points pointtype 7 pointsize 0.45 linecolor rgb 'black' title "
        "'impact'");
  }
  return panel;
}

Panel end_panel(const MotionPicture& picture, const Response& response) {
  Extent last = response.last_load;
  for (const double value : {response.last_motor.low, response.last_motor.high, 0.0}) {
    last.include(value);
  }
  Panel panel{200.0, "enlarged (" + picture.angle.name + ")", range_of(last, 0.25), {}};
  if (response.half_gap > 0.0) {
    panel.layers.push_back(fmt::format(
        "$curve using 1:11:12 with filledcurves fill solid noborder linecolor rgb '{}' notitle",
        gap_colour));
  }
  panel.layers.push_back(
      fmt::format("0 with lines {} linecolor rgb '{}' notitle", reference_style, reference_colour));
  panel.layers.push_back(line(9, load_colour, load_style, ""));
  panel.layers.push_back(line(10, motor_colour, motor_style, ""));
  return panel;
}

Panel gap_panel(const MotionPicture& picture, const Response& response) {
  Panel panel{110.0, "gap (" + picture.angle.name + ")", range_of(response.gaps, 0.12), {}};
  for (const double face : {-response.half_gap, response.half_gap}) {
    panel.layers.push_back(
        fmt::format("{:.7g} with lines linewidth 3 linecolor rgb '#909090' notitle", face));
  }
  panel.layers.push_back(line(6, "#000000", "linewidth 1.3", ""));
  return panel;
}

/// Draws the limit if the torque comes near it, else only names it.
Panel torque_panel(const MotionPicture& picture, const Response& response) {
  constexpr double near = 0.4;
  Extent torques = response.torques;
  const double limit = reduce(picture.drive).torque_limit;
  const double highest = std::max(std::abs(torques.low), std::abs(torques.high));
  const bool is_near = std::isfinite(limit) && highest > near * limit;
  if (is_near) {
    torques.include(limit);
    torques.include(-limit);
  }
  Panel panel{130.0, "torque (N m)", range_of(torques), {}};
  if (is_near) {
    for (const double value : {limit, -limit}) {
      panel.layers.push_back(
          fmt::format("{:.7g} with lines linewidth 1.2 dashtype (3,3) linecolor rgb '{}' notitle",
                      value, limit_colour));
    }
  }
  panel.layers.push_back(line(7, "#009e73", "linewidth 1.4", ""));
  return panel;
}

/// Legend entries for the curves of the panels below the first.
std::vector<std::string> more_in_legend(const MotionPicture& picture, const Response& response) {
  const auto entry = [](const std::string& how, const std::string& title) {
    return "keyentry with " + how + " title " + quoted(title);
  };
  std::vector<std::string> entries;
  if (!response.apart.empty()) {
    entries.push_back(entry(
        fmt::format("boxes fill solid noborder linecolor rgb '{}'", apart_colour), "faces apart"));
  }
  if (response.half_gap > 0.0) {
    entries.push_back(entry("lines linewidth 3 linecolor rgb '#909090'", "faces"));
  }
  entries.push_back(
      entry("lines linewidth 1.4 linecolor rgb '#009e73'", "motor torque, at the load"));
  const double limit = reduce(picture.drive).torque_limit;
  if (std::isfinite(limit)) {
    entries.push_back(
        entry(fmt::format("lines linewidth 1.2 dashtype (3,3) linecolor rgb '{}'", limit_colour),
              "its limit, ±" + significant(limit, 4) + " N m"));
  }
  return entries;
}

/// "end: load ±1.8 arcmin, motor ±3.4 arcmin".
std::string end_line(const MotionPicture& picture, const Response& response) {
  const auto swing = [&](const Extent& extent) {
    return "±" + significant(0.5 * extent.width(), 3) + " " + picture.angle.name;
  };
  return "in the last third: load " + swing(response.last_load) + ", motor " +
         swing(response.last_motor);
}

/// Lengths in pixels.
constexpr double heading_height = 118.0;
constexpr double gap_between = 12.0;

/// The height of the legend of `names` names in two columns, with the axis above it.
double legend_height(std::size_t names) {
  constexpr double axis = 72.0;
  constexpr double row = 27.0;
  return axis + row * static_cast<double>((names + 1) / 2);
}

std::string heading(const MotionPicture& picture, const Response& response, double height) {
  const auto label = [&](int number, const std::string& text, const char* style, double from_top) {
    return fmt::format("set label {} {} at screen 0.54, screen {:.4f} center\n", number,
                       quoted(text, style), 1.0 - from_top / height);
  };
  std::string labels = label(1, picture.title, "/:Bold", 24.0);
  double from_top = 48.0;
  int number = 2;
  for (const std::string& line :
       {picture.subtitle, end_line(picture, response), numbers_line(picture)}) {
    if (line.empty()) continue;
    labels += label(number++, line, "/*0.87", from_top);
    from_top += 23.0;
  }
  return labels;
}

}  // namespace

std::string draw_time_response(const MotionPicture& picture, PictureFormat format) {
  const Response response = response_of(picture);
  std::vector<Panel> panels = {position_panel(picture, response)};
  if (has_small_end(response)) panels.push_back(end_panel(picture, response));
  if (response.half_gap > 0.0) panels.push_back(gap_panel(picture, response));
  panels.push_back(torque_panel(picture, response));
  const std::vector<std::string> more = more_in_legend(picture, response);
  panels.front().layers.insert(panels.front().layers.end(), more.begin(), more.end());
  double height = heading_height + legend_height(panels.front().layers.size());
  for (const Panel& panel : panels) height += panel.height + gap_between;

  std::string script = terminal(format, height) + "set encoding utf8\n" + response.curve.text() +
                       response.impacts + "set multiplot\n" + response.apart +
                       fmt::format("set xrange [0:{:.7g}]\n", std::max(response.end_time, 1e-9)) +
                       "set lmargin screen 0.135\nset rmargin screen 0.97\n"
                       "set grid linewidth 0.5 linecolor rgb '#c4c4c4'\n"
                       "set tics nomirror out\nset border linewidth 0.8\nset format x ''\n"
                       "set key at screen 0.54, screen 0.004 bottom center horizontal maxcols 3 "
                       "Left reverse samplen 3 spacing 1.2\n" +
                       heading(picture, response, height);
  double top = heading_height;
  for (const Panel& panel : panels) {
    const bool is_last = &panel == &panels.back();
    if (is_last) {
      script += "set format x '% h'\nset xlabel " +
                quoted(is_normalized(picture.drive) ? "time (1/ω_n)" : "time (s)") + "\n";
    }
    script += fmt::format(
        "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\nset yrange {}\n"
        "set ylabel {} offset screen {}, 0\nset ytics autofreq\n",
        1.0 - top / height, 1.0 - (top + panel.height) / height, panel.range, quoted(panel.label),
        "0.0");
    script += plot_command(panel.layers);
    if (&panel == &panels.front()) script += "unset label\nunset key\n";
    top += panel.height + gap_between;
  }
  return run_gnuplot(script + "unset multiplot\n", picture.title);
}

}  // namespace gearlash
