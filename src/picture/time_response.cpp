// Drawing motions over time: position, gap and torque; beside them their end, enlarged.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/reduced_drive.hpp"
#include "model/signal.hpp"
#include "output/report_units.hpp"
#include "picture/axis_scale.hpp"
#include "picture/gnuplot.hpp"
#include "picture/motion_style.hpp"
#include "picture/shown_end.hpp"

namespace gearlash {
namespace {

constexpr char reference_colour[] = "#555555";
constexpr char gap_colour[] = "#dcdcdc";
constexpr char apart_colour[] = "#fdf3dd";
constexpr char limit_colour[] = "#aa0000";
constexpr char torque_colour[] = "#009e73";
constexpr char step_colour[] = "#3d7ea6";  ///< of an encoder

constexpr char load_style[] = "linewidth 2";
constexpr char motor_style[] = "linewidth 1.6 dashtype (8,4)";
constexpr char reference_style[] = "linewidth 1 dashtype 4";

/// Lengths in pixels.
constexpr double title_line = 24.0;
constexpr double heading_line = 23.0;
constexpr double gap_between = 12.0;
constexpr double room_for_column_title = 24.0;

/// What the panels draw, as gnuplot's data.
struct Response {
  /// time, load, motor, the gap's edges around the load (2), gap; then load, motor and the gap's
  /// edges relative to the reference.
  DataBlock curve{"curve"};
  DataBlock reference{"reference"};  ///< time, reference; interrupted where it leaps
  DataBlock torque{"torque"};        ///< time, torque; interrupted where an event makes it leap
  std::string apart;                 ///< commands: rectangles behind the grid
  std::string impacts;
  double end_time = 0.0;
  double half_gap = 0.0;
  double torque_limit = infinity;
  double encoder_step = 0.0;  ///< in the picture's unit
  Extent positions;
  Extent gaps;
  Extent torques;
  ShownEnd end;
  bool is_end_enlarged = false;
};

void add_point(const DrawnPoint& point, Response& response) {
  const double load = point.load_position;
  const double half = response.half_gap;
  const double error = load - point.reference;
  response.curve.row(point.time, load, point.motor_position, load - half, load + half,
                     point.motor_position - load, error, point.motor_position - point.reference,
                     error - half, error + half);
  response.reference.row(point.time, point.reference);
  for (const double value : {load - half, load + half, point.motor_position, point.reference}) {
    response.positions.include(value);
  }
  response.gaps.include(point.motor_position - load);
}

void add_curve(const std::vector<DrawnPiece>& pieces, Response& response) {
  const DrawnPoint* last = nullptr;
  for (const DrawnPiece& piece : pieces) {
    if (last != nullptr && last->reference != piece.points.front().reference) {
      response.reference.gap();
    }
    for (const DrawnPoint& point : piece.points) add_point(point, response);
    last = &piece.points.back();
  }
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

/// A computer changes the torque many times between two points of the curve, so that the torque has
/// points of its own. Its leaps at events are not joined.
void add_torque(const Motion& motion, const std::vector<DrawnPiece>& pieces, double from, double to,
                Response& response) {
  constexpr int points = 1500;
  constexpr double visible_leap = 0.01;  // of the largest torque so far
  double last = 0.0;
  const auto add = [&](double time, double torque) {
    response.torque.row(time, torque);
    response.torques.include(torque);
    last = torque;
  };
  const double step = (to - from) / points;
  for (const DrawnPiece& piece : pieces) {
    const double begin = std::max(from, piece.points.front().time);
    const double end = std::min(to, piece.points.back().time);
    if (begin > end) continue;
    const double first = motion.at(begin).motor_torque;
    const double largest = std::max(std::abs(response.torques.low), response.torques.high);
    if (!response.torque.is_empty() && std::abs(first - last) > visible_leap * largest) {
      response.torque.gap();
    }
    add(begin, first);
    for (double time = begin + step; time < end; time += step) {
      add(time, motion.at(time).motor_torque);
    }
    add(end, motion.at(end).motor_torque);
  }
  response.torque.gap();
}

Response response_of(const MotionPicture& picture) {
  const Motion& motion = picture.motions.front().motion;
  const std::vector<DrawnPiece> pieces = legible_curve(picture, motion);
  const drive::ReducedDrive reduced = reduce(picture.drive);
  Response response;
  response.end_time = motion.end_time();
  response.half_gap = 0.5 * picture.angle.from_radians(reduced.backlash);
  response.torque_limit = reduced.torque_limit;
  response.encoder_step = picture.angle.from_radians(reduced.sensing.resolution);
  for (const double face : {-response.half_gap, response.half_gap}) response.gaps.include(face);
  add_curve(pieces, response);
  add_apart(pieces, response);
  add_torque(motion, pieces, 0.0, response.end_time, response);
  response.end = end_of(pieces, response.end_time, picture.hunting_period);
  response.is_end_enlarged = is_worth_enlarging(response.end, response.positions,
                                                2.0 * response.half_gap, response.end_time);
  if (response.is_end_enlarged) {
    add_torque(motion, pieces, response.end.from, response.end_time, response);
  }
  ImpactMarks marks("impacts", response.end_time, response.positions.width());
  for (const DrawnPiece& piece : pieces) {
    const DrawnPoint& last = piece.points.back();
    if (piece.ends_with_impact) {
      marks.add(last.time, last.motor_position, last.motor_position - last.reference);
    }
  }
  if (!marks.block().is_empty()) response.impacts = marks.block().text();
  return response;
}

// ---- panels -------------------------------------------------------------------------------------

struct Panel {
  double height;  ///< of the picture, in units of 1/900 of its width
  std::string quantity;
  std::string unit;
  Bounds range;
  std::vector<std::string> layers = {};
};

/// A column of panels over one range of times.
struct Column {
  double left;  ///< shares of the picture's width
  double right;
  double from;  ///< s
  double to;
  std::string title;
  std::vector<Panel> panels = {};
};

std::string line(int column, const char* colour, const std::string& style) {
  return fmt::format("$curve using 1:{} with lines {} linecolor rgb '{}' notitle", column, style,
                     colour);
}

constexpr char impact_layer[] =
    "$impacts using 1:{} with points pointtype 7 pointsize 0.45 linecolor rgb 'black' notitle";

Panel position_panel(const MotionPicture& picture, const Response& response) {
  Panel panel{270.0, "position", picture.angle.name, widened(response.positions, 0.05)};
  if (response.half_gap > 0.0) {
    panel.layers.push_back(
        fmt::format("$curve using 1:4:5 with filledcurves fill solid noborder linecolor rgb '{}' "
                    "notitle",
                    gap_colour));
  }
  panel.layers.push_back(
      fmt::format("$reference using 1:2 with lines {} linecolor rgb '{}' notitle", reference_style,
                  reference_colour));
  panel.layers.push_back(line(2, load_colour, load_style));
  panel.layers.push_back(line(3, motor_colour, motor_style));
  if (!response.impacts.empty()) panel.layers.push_back(fmt::format(impact_layer, 2));
  return panel;
}

/// Where the encoder's reading changes, relative to a constant reference: halfway between two
/// multiples of its step. Empty where the steps are too narrow to be seen, or slide.
std::vector<double> encoder_edges(const Response& response, const Bounds& range) {
  constexpr double most_edges = 30.0;
  const double step = response.encoder_step;
  const ShownEnd& end = response.end;
  if (!(step > 0.0) || (range.high - range.low) / step > most_edges || !end.reference) return {};
  std::vector<double> edges;
  const double first = std::ceil((range.low + *end.reference) / step - 0.5);
  for (double i = first; (i + 0.5) * step - *end.reference < range.high; ++i) {
    edges.push_back((i + 0.5) * step - *end.reference);
  }
  return edges;
}

Panel end_panel(const MotionPicture& picture, const Response& response) {
  Panel panel{270.0, "from the reference", picture.angle.name,
              widened(response.end.shown_errors(), 0.25)};
  if (response.half_gap > 0.0) {
    panel.layers.push_back(fmt::format(
        "$curve using 1:9:10 with filledcurves fill solid noborder linecolor rgb '{}' notitle",
        gap_colour));
  }
  for (const double edge : encoder_edges(response, panel.range)) {
    panel.layers.push_back(
        fmt::format("{:.7g} with lines linewidth 1 dashtype (2,3) linecolor rgb '{}' notitle", edge,
                    step_colour));
  }
  panel.layers.push_back(
      fmt::format("0 with lines {} linecolor rgb '{}' notitle", reference_style, reference_colour));
  panel.layers.push_back(line(7, load_colour, load_style));
  panel.layers.push_back(line(8, motor_colour, motor_style));
  if (!response.impacts.empty()) panel.layers.push_back(fmt::format(impact_layer, 3));
  return panel;
}

Panel gap_panel(const MotionPicture& picture, const Response& response) {
  Panel panel{120.0, "gap", picture.angle.name, widened(response.gaps, 0.12)};
  for (const double face : {-response.half_gap, response.half_gap}) {
    panel.layers.push_back(
        fmt::format("{:.7g} with lines linewidth 3 linecolor rgb '#909090' notitle", face));
  }
  panel.layers.push_back(line(6, "#000000", "linewidth 1.3"));
  return panel;
}

/// Draws the limit if the torque comes near it, else only names it.
Panel torque_panel(const Response& response, Extent torques) {
  constexpr double near = 0.4;
  const double limit = response.torque_limit;
  const double highest = std::max(std::abs(torques.low), std::abs(torques.high));
  const bool is_near = std::isfinite(limit) && highest > near * limit;
  if (is_near) {
    torques.include(limit);
    torques.include(-limit);
  }
  Panel panel{130.0, "torque", "N m", widened(torques, 0.05)};
  if (is_near) {
    for (const double value : {limit, -limit}) {
      panel.layers.push_back(
          fmt::format("{:.7g} with lines linewidth 1.2 dashtype (3,3) linecolor rgb '{}' notitle",
                      value, limit_colour));
    }
  }
  panel.layers.push_back(fmt::format(
      "$torque using 1:2 with lines linewidth 1.4 linecolor rgb '{}' notitle", torque_colour));
  return panel;
}

/// Legend entries, one for each thing that is drawn.
std::vector<std::string> legend_of(const MotionPicture& picture, const Response& response,
                                   bool has_steps) {
  const auto entry = [](const std::string& how, const std::string& title) {
    return "keyentry with " + how + " title " + quoted(title);
  };
  const auto line_entry = [&](const std::string& style, const char* colour, const char* title) {
    return entry(fmt::format("lines {} linecolor rgb '{}'", style, colour), title);
  };
  std::vector<std::string> entries;
  if (response.half_gap > 0.0) {
    entries.push_back(entry(fmt::format("boxes fill solid noborder linecolor rgb '{}'", gap_colour),
                            "gap, ± half the backlash"));
  }
  entries.push_back(line_entry(reference_style, reference_colour, "reference"));
  entries.push_back(line_entry(load_style, load_colour, "load"));
  entries.push_back(line_entry(motor_style, motor_colour, "motor"));
  if (!response.impacts.empty()) {
    entries.push_back(entry("points pointtype 7 pointsize 0.45 linecolor rgb 'black'", "impact"));
  }
  if (!response.apart.empty()) {
    entries.push_back(entry(
        fmt::format("boxes fill solid noborder linecolor rgb '{}'", apart_colour), "faces apart"));
  }
  if (response.half_gap > 0.0) {
    entries.push_back(entry("lines linewidth 3 linecolor rgb '#909090'", "faces"));
  }
  entries.push_back(
      entry(fmt::format("lines linewidth 1.4 linecolor rgb '{}'", torque_colour),
            picture.drive.gearbox.ratio == 1.0 ? "motor torque" : "motor torque, at the load"));
  if (std::isfinite(response.torque_limit)) {
    entries.push_back(
        entry(fmt::format("lines linewidth 1.2 dashtype (3,3) linecolor rgb '{}'", limit_colour),
              "its limit, ±" + significant(response.torque_limit, 4) + " N m"));
  }
  if (has_steps) {
    entries.push_back(
        entry(fmt::format("lines linewidth 1 dashtype (2,3) linecolor rgb '{}'", step_colour),
              "encoder steps"));
  }
  return entries;
}

/// "in the last third: load ±1.8 arcmin, motor ±3.4 arcmin".
std::string end_line(const MotionPicture& picture, const ShownEnd& end) {
  const auto swing = [&](const Extent& extent) {
    return "±" + significant(0.5 * extent.width(), 3) + " " + picture.angle.name;
  };
  return "in the last third: load " + swing(end.load_third) + ", motor " + swing(end.motor_third);
}

// ---- layout -------------------------------------------------------------------------------------

std::vector<std::string> heading_lines(const MotionPicture& picture, const ShownEnd& end) {
  std::vector<std::string> lines;
  for (const std::string& text :
       {picture.subtitle, end_line(picture, end), numbers_line(picture)}) {
    if (text.empty()) continue;
    for (const std::string& part : wrapped(text, page_in_small)) lines.push_back(part);
  }
  return lines;
}

std::string heading(const std::string& title, const std::vector<std::string>& lines,
                    double height) {
  const auto label = [&](std::size_t number, const std::string& text, const char* style,
                         double from_top) {
    return fmt::format("set label {} {} at screen 0.54, screen {:.4f} center\n", number,
                       quoted(text, style), 1.0 - from_top / height);
  };
  std::string labels;
  double from_top = title_line;
  std::size_t number = 1;
  for (const std::string& part : wrapped(title, page_in_bold)) {
    labels += label(number++, part, "/:Bold", from_top);
    from_top += title_line;
  }
  for (const std::string& text : lines) {
    labels += label(number++, text, "/*0.87", from_top);
    from_top += heading_line;
  }
  return labels;
}

double heading_height(const std::string& title, const std::vector<std::string>& lines) {
  return title_line * static_cast<double>(wrapped(title, page_in_bold).size()) +
         heading_line * static_cast<double>(lines.size()) + 25.0;
}

constexpr std::size_t legend_columns = 2;  // for more gnuplot lacks the width

/// The height of the legend, with the axis above it.
double legend_height(std::size_t names) {
  constexpr double axis = 72.0;
  constexpr double row = 27.0;
  return axis + row * static_cast<double>((names + legend_columns - 1) / legend_columns);
}

/// `top`: of the first panel.
std::string commands_of(const Column& column, const std::string& time_unit, double top,
                        double height) {
  std::string script = fmt::format(
      "set xrange [{:.9g}:{:.9g}]\nset lmargin at screen {}\nset rmargin at screen {}\n"
      "set format x ''\nunset xlabel\n",
      column.from, column.to, column.left, column.right);
  const Bounds times{column.from, column.to};
  const AxisScale time = axis_scale('x', "time", time_unit, times, 6);
  if (!column.title.empty()) {
    script += fmt::format("set label 99 {} at graph 0.5, graph 1 center offset 0,0.7\n",
                          quoted(column.title, "/*0.87"));
  }
  double from_top = top;
  for (const Panel& panel : column.panels) {
    const AxisScale scale =
        axis_scale('y', panel.quantity, panel.unit, panel.range, panel.height > 200.0 ? 6 : 5);
    const bool is_last = &panel == &column.panels.back();
    script += is_last
                  ? "set format x '% h'\n" + time.tics + "set xlabel " + quoted(time.label) + "\n"
                  : std::string("set xtics autofreq\n");
    script += fmt::format(
        "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\nset yrange "
        "[{:.9g}:{:.9g}]\nset ylabel {}\n{}",
        1.0 - from_top / height, 1.0 - (from_top + panel.height) / height, panel.range.low,
        panel.range.high, quoted(scale.label), scale.tics);
    script += plot_command(panel.layers);
    if (&panel == &column.panels.front()) script += "unset label\n";
    from_top += panel.height + gap_between;
  }
  return script;
}

std::vector<Column> columns_of(const MotionPicture& picture, const Response& response) {
  const double end_time = std::max(response.end_time, 1e-9);
  Column whole{.left = 0.135, .right = 0.97, .from = 0.0, .to = end_time, .title = ""};
  whole.panels.push_back(position_panel(picture, response));
  if (response.half_gap > 0.0) whole.panels.push_back(gap_panel(picture, response));
  whole.panels.push_back(torque_panel(response, response.torques));
  if (!response.is_end_enlarged) return {whole};
  whole.left = 0.1;
  whole.right = 0.49;
  Column end{.left = 0.615,
             .right = 0.98,
             .from = response.end.from,
             .to = end_time,
             .title = "the last " + significant(end_time - response.end.from, 2) +
                      (is_normalized(picture.drive) ? "/ω_n, enlarged" : " s, enlarged")};
  end.panels.push_back(end_panel(picture, response));
  if (response.half_gap > 0.0) end.panels.push_back(gap_panel(picture, response));
  end.panels.push_back(torque_panel(response, response.end.torques));
  return {whole, end};
}

}  // namespace

std::string draw_time_response(const MotionPicture& picture, PictureFormat format) {
  const Response response = response_of(picture);
  const std::vector<Column> columns = columns_of(picture, response);
  const bool has_steps = response.is_end_enlarged &&
                         !encoder_edges(response, columns.back().panels.front().range).empty();
  const std::vector<Panel>& panels = columns.front().panels;
  std::vector<std::string> legend = legend_of(picture, response, has_steps);
  const std::vector<std::string> lines = heading_lines(picture, response.end);
  const double top = heading_height(picture.title, lines) +
                     (response.is_end_enlarged ? room_for_column_title : 0.0);
  double height = top + legend_height(legend.size());
  for (const Panel& panel : panels) height += panel.height + gap_between;

  std::string script = terminal(format, height) + "set encoding utf8\n" + response.curve.text() +
                       response.reference.text() + response.torque.text() + response.impacts +
                       "set multiplot\n" + response.apart +
                       "set grid linewidth 0.5 linecolor rgb '#c4c4c4'\n"
                       "set tics nomirror out\nset border linewidth 0.8\nunset key\n" +
                       heading(picture.title, lines, height);
  const std::string time_unit = is_normalized(picture.drive) ? "1/ω_n" : "s";
  for (const Column& column : columns) script += commands_of(column, time_unit, top, height);
  legend.insert(legend.begin(), "1/0 notitle");
  script +=
      "set lmargin at screen 0.02\nset rmargin at screen 0.98\nunset border\nunset tics\n"
      "unset grid\nunset xlabel\nunset ylabel\nunset object\n"
      "set key at screen 0.54, screen 0.004 bottom center horizontal Left reverse samplen 3 "
      "spacing 1.2 maxcols " +
      std::to_string(legend_columns) + "\n" + plot_command(legend);
  return run_gnuplot(script + "unset multiplot\n", picture.title);
}

}  // namespace gearlash
