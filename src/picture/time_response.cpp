// Motions over time: position, gap and torque; beside them their end, enlarged.
#include <algorithm>
#include <cmath>

#include "gearlash/units.hpp"
#include "model/reduced_drive.hpp"
#include "model/signal.hpp"
#include "picture/motion_style.hpp"
#include "picture/plot_making.hpp"
#include "picture/shown_end.hpp"

namespace gearlash {
namespace {

const Layer gap_style{
    .kind = LayerKind::area, .name = "gap, ± half the backlash", .colour = "#dcdcdc"};
const Layer apart_style{.kind = LayerKind::area, .name = "faces apart", .colour = "#fdf3dd"};
const Layer reading_style{.name = "encoder reading", .colour = "#3d7ea6", .width = 1.0};
const Layer reference_style{
    .name = "reference", .colour = "#555555", .width = 1.2, .dashes = "10,5,2,5"};
const Layer load_style{.name = "load", .colour = load_colour, .width = 2.0};
const Layer motor_style{.name = "motor", .colour = motor_colour, .width = 1.6, .dashes = "8,4"};
const Layer face_style{.name = "faces", .colour = "#909090", .width = 3.0};
const Layer gap_line_style{.width = 1.3};
const Layer limit_style{.colour = "#aa0000", .width = 1.2, .dashes = "3,3"};
const Layer torque_style{.colour = "#009e73", .width = 1.4};

Extent heights_of(const MapCurve& points) {
  Extent heights;
  for (const MapPoint& point : points) {
    if (std::isfinite(point.y)) heights.include(point.y);
  }
  return heights;
}

/// A motion, and what its panels share. Angles are in the picture's unit.
struct Response {
  const MotionPicture& picture;
  const Motion& motion;
  std::vector<DrawnPiece> pieces;
  double end_time;
  double gap;
  double torque_limit;
  double encoder_step;
  double encoder_share_of_load;  ///< 1: it measures the load, 0: the motor
  Extent positions;
  ShownEnd end;
};

/// A column of panels over one range of times.
class TimeColumn {
 public:
  TimeColumn(const Response& response, double from, double to, bool is_relative)
      : response_(response),
        from_(from),
        is_relative_(is_relative),
        x_{.name = "time",
           .unit = is_normalized(response.picture.drive) ? "1/ω_n" : "s",
           .low = from,
           .high = to} {}

  PlotColumn panels(const std::string& title) const {
    PlotColumn column = {position_panel()};
    column.front().title = title;
    if (response_.gap > 0.0) column.push_back(gap_panel());
    column.push_back(torque_panel());
    return column;
  }

 private:
  /// A value of each point over time; interrupted where the reference leaps if `breaks_at_leaps`.
  template <class Value>
  MapCurve over_time(const Value& value, bool breaks_at_leaps = false) const {
    MapCurve points;
    double reference = response_.pieces.front().points.front().reference;
    for (const DrawnPiece& piece : response_.pieces) {
      if (breaks_at_leaps && reference != piece.points.front().reference) append({}, points);
      for (const DrawnPoint& point : piece.points) {
        if (point.time >= from_) points.push_back({point.time, value(point)});
      }
      reference = piece.points.back().reference;
    }
    return points;
  }

  double origin(const DrawnPoint& point) const { return is_relative_ ? point.reference : 0.0; }

  /// A horizontal line.
  MapCurve at(double value) const { return {{x_.low, value}, {x_.high, value}}; }

  Panel panel(const std::string& name, const std::string& unit, const Bounds& range,
              double height) const {
    Panel panel{.x = x_,
                .y = {.name = name, .unit = unit, .low = range.low, .high = range.high},
                .height = height};
    panel.layers.push_back(with(apart_style, apart(range)));
    if (panel.layers.front().points.empty()) panel.layers.clear();
    return panel;
  }

  /// The intervals with separated faces; those too close to distinguish are merged.
  MapCurve apart(const Bounds& range) const {
    const double smallest = (x_.high - from_) / 2000.0;
    std::vector<Bounds> intervals;
    for (const DrawnPiece& piece : response_.pieces) {
      const double begin = std::max(from_, piece.points.front().time);
      const double end = piece.points.back().time;
      if (!piece.is_apart || end <= from_) continue;
      if (!intervals.empty() && begin <= intervals.back().high + smallest) {
        intervals.back().high = end;
      } else {
        intervals.push_back({begin, end});
      }
    }
    MapCurve points;
    for (const Bounds& interval : intervals) append(rectangle(interval, range), points);
    return points;
  }

  Panel position_panel() const {
    const auto load = [&](const DrawnPoint& point) { return point.load_position - origin(point); };
    const auto motor = [&](const DrawnPoint& point) {
      return point.motor_position - origin(point);
    };
    const auto reference = [&](const DrawnPoint& point) { return point.reference - origin(point); };
    const double half = 0.5 * response_.gap;
    MapCurve around = over_time([&](const DrawnPoint& point) { return load(point) + half; });
    MapCurve below = over_time([&](const DrawnPoint& point) { return load(point) - half; });
    around.insert(around.end(), below.rbegin(), below.rend());
    MapCurve reading = encoder_reading();
    Extent range = heights_of(reading);
    const Bounds positions = is_relative_ ? widened(response_.end.shown_errors(), 0.25)
                                          : widened(response_.positions, 0.05);
    for (const double end : {positions.low, positions.high}) range.include(end);
    Panel drawn = panel(is_relative_ ? "from the reference" : "position",
                        response_.picture.drive.angle_unit.name, range, 270.0);
    if (half > 0.0) drawn.layers.push_back(with(gap_style, std::move(around)));
    if (!reading.empty()) drawn.layers.push_back(with(reading_style, std::move(reading)));
    drawn.layers.push_back(with(reference_style, over_time(reference, true)));
    drawn.layers.push_back(with(load_style, over_time(load)));
    drawn.layers.push_back(with(motor_style, over_time(motor)));
    MapCurve impacts;
    for (const DrawnPiece& piece : response_.pieces) {
      const DrawnPoint& last = piece.points.back();
      if (piece.ends_with_impact && last.time >= from_) impacts.push_back({last.time, motor(last)});
    }
    drawn.layers.push_back(impact_marks(impacts, {from_, x_.high}, range, 0.45));
    return drawn;
  }

  /// The multiple of the step that is nearest to the measured position, an upright line wherever it
  /// changes, from the reference where the panel is. Empty without an encoder.
  MapCurve encoder_reading() const {
    const double step = response_.encoder_step;
    if (!(step > 0.0)) return {};
    constexpr int count = 3000;
    MapCurve points;
    for (int i = 0; i <= count; ++i) {
      const double time = std::lerp(from_, x_.high, static_cast<double>(i) / count);
      const MotionSample sample = response_.motion.at(time);
      const double measured = response_.picture.drive.angle_unit.from_radians(
          std::lerp(sample.shafts.motor_position, sample.shafts.load_position,
                    response_.encoder_share_of_load));
      const double origin =
          is_relative_ ? response_.picture.drive.angle_unit.from_radians(sample.reference) : 0.0;
      const double reading = std::round(measured / step) * step - origin;
      if (!points.empty() && points.back().y != reading) points.push_back({time, points.back().y});
      points.push_back({time, reading});
    }
    return points;
  }

  Panel gap_panel() const {
    const double half = 0.5 * response_.gap;
    MapCurve gap = over_time(
        [](const DrawnPoint& point) { return point.motor_position - point.load_position; });
    Extent range = heights_of(gap);
    for (const double face : {-half, half}) range.include(face);
    Panel drawn =
        panel("gap", response_.picture.drive.angle_unit.name, widened(range, 0.12), 120.0);
    drawn.layers.push_back(with(face_style, joined({at(-half), at(half)})));
    drawn.layers.push_back(with(gap_line_style, std::move(gap)));
    return drawn;
  }

  /// A computer changes the torque many times between two points of the curve, so that the torque
  /// has points of its own. Its leaps at events are not joined.
  MapCurve torque_over_time() const {
    constexpr int count = 1500;
    constexpr double visible_leap = 0.01;  // of the largest torque so far
    MapCurve points;
    double largest = 0.0;
    const auto add = [&](double time) {
      const double torque = response_.motion.at(time).motor_torque;
      points.push_back({time, torque});
      largest = std::max(largest, std::abs(torque));
    };
    const double step = (x_.high - from_) / count;
    for (const DrawnPiece& piece : response_.pieces) {
      const double begin = std::max(from_, piece.points.front().time);
      const double end = piece.points.back().time;
      if (begin > end) continue;
      const double before = points.empty() ? 0.0 : points.back().y;
      const double first = response_.motion.at(begin).motor_torque;
      if (std::abs(first - before) > visible_leap * largest) append({}, points);
      for (double time = begin; time < end; time += step) add(time);
      add(end);
    }
    return points;
  }

  /// Draws the limit if the torque comes near it, else only names it.
  Panel torque_panel() const {
    constexpr double near = 0.4;
    const double limit = response_.torque_limit;
    MapCurve torque = torque_over_time();
    Extent range = heights_of(torque);
    const bool is_near =
        std::isfinite(limit) && std::max(std::abs(range.low), range.high) > near * limit;
    if (is_near) {
      range.include(limit);
      range.include(-limit);
    }
    Panel drawn = panel("torque", "N m", widened(range, 0.05), 130.0);
    Layer line = with(torque_style, std::move(torque));
    line.name =
        response_.picture.drive.gearbox.ratio == 1.0 ? "motor torque" : "motor torque, at the load";
    Layer limits = with(limit_style, is_near ? joined({at(limit), at(-limit)}) : MapCurve{});
    if (std::isfinite(limit)) limits.name = "its limit, ±" + significant(limit, 4) + " N m";
    drawn.layers.push_back(std::move(limits));
    drawn.layers.push_back(std::move(line));
    return drawn;
  }

  const Response& response_;
  double from_;
  bool is_relative_;
  PlotAxis x_;
};

/// "in the last third: load ±1.8 arcmin, motor ±3.4 arcmin".
std::string end_line(const MotionPicture& picture, const ShownEnd& end) {
  const auto swing = [&](const Extent& extent) {
    return "±" + significant(0.5 * extent.width(), 3) + " " + picture.drive.angle_unit.name;
  };
  return "in the last third: load " + swing(end.load_third) + ", motor " + swing(end.motor_third);
}

Response response_of(const MotionPicture& picture) {
  const Motion& motion = picture.motions.front().motion;
  const drive::ReducedDrive reduced = reduce(picture.drive);
  Response response{
      .picture = picture,
      .motion = motion,
      .pieces = legible_curve(picture, motion),
      .end_time = std::max(motion.end_time(), 1e-9),
      .gap = picture.drive.angle_unit.from_radians(reduced.backlash),
      .torque_limit = reduced.torque_limit,
      .encoder_step = picture.drive.angle_unit.from_radians(reduced.sensing.resolution),
      .encoder_share_of_load = reduced.sensing.load_share_of_position,
      .positions = {},
      .end = {}};
  for_each_point(response.pieces, [&](const DrawnPoint& point) {
    for (const double value :
         {point.load_position - 0.5 * response.gap, point.load_position + 0.5 * response.gap,
          point.motor_position, point.reference}) {
      response.positions.include(value);
    }
  });
  response.end = end_of(response.pieces, motion.end_time(), picture.hunting_period);
  return response;
}

}  // namespace

Plot time_plot(const MotionPicture& picture) {
  const Response response = response_of(picture);
  const double end_time = response.end_time;
  Plot plot{.title = picture.title};
  for (const std::string& line :
       {picture.subtitle, end_line(picture, response.end), numbers_line(picture)}) {
    if (!line.empty()) plot.subtitles.push_back(line);
  }
  plot.columns.push_back(TimeColumn(response, 0.0, end_time, false).panels(""));
  if (is_worth_enlarging(response.end, response.positions, response.gap, end_time)) {
    const double from = response.end.from;
    plot.columns.push_back(
        TimeColumn(response, from, end_time, true)
            .panels("the last " + significant(end_time - from, 2) +
                    (is_normalized(picture.drive) ? "/ω_n, enlarged" : " s, enlarged")));
  }
  return finished(std::move(plot));
}

}  // namespace gearlash
