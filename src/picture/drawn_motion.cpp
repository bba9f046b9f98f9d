#include "picture/drawn_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lists.hpp"

namespace gearlash {
namespace {

/// Relative to the picture's extent: a sixth of a line's width, which shows no corners.
constexpr double chord_tolerance = 4e-4;
constexpr int deepest_bisection = 12;
constexpr double panels_in_a_period = 12.0;

class CurveTracer {
 public:
  CurveTracer(const Motion& motion, const AngleUnit& angle, double period)
      : motion_(motion), angle_(angle), longest_panel_(period / panels_in_a_period) {}

  DrawnPoint point(double time) const {
    const MotionSample sample = motion_.at(time);
    const Shafts& shafts = sample.shafts;
    return {.time = time,
            .load_position = angle_.from_radians(shafts.load_position),
            .load_speed = angle_.from_radians(shafts.load_speed),
            .motor_position = angle_.from_radians(shafts.motor_position),
            .motor_speed = angle_.from_radians(shafts.motor_speed),
            .motor_torque = sample.motor_torque,
            .reference = angle_.from_radians(sample.reference)};
  }

  void include(const DrawnPoint& point) {
    position_ = std::max({position_, std::abs(point.load_position - point.reference),
                          std::abs(point.motor_position - point.reference)});
    speed_ = std::max({speed_, std::abs(point.load_speed), std::abs(point.motor_speed)});
  }

  /// The ends of the initial panels of a piece; the last lies just before the event that ends it.
  std::vector<double> panels(double from, double to) const {
    const double last = std::max(from, std::nextafter(to, from));
    const int count = std::max(1, static_cast<int>(std::ceil((to - from) / longest_panel_)));
    std::vector<double> ends;
    for (int i = 0; i < count; ++i) ends.push_back(from + (last - from) * i / count);
    ends.push_back(last);
    return ends;
  }

  std::vector<DrawnPoint> trace(const std::vector<double>& ends) const {
    std::vector<DrawnPoint> points = {point(ends.front())};
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const DrawnPoint start = points.back();
      refine(start, point(ends[i]), 0, points);
    }
    return points;
  }

 private:
  /// Adds the points after `start` up to `end`. An interval is halved if its middle is off the
  /// chord.
  void refine(const DrawnPoint& start, const DrawnPoint& end, int depth,
              std::vector<DrawnPoint>& points) const {
    const DrawnPoint middle = point(0.5 * (start.time + end.time));
    if (depth >= deepest_bisection || is_on_chord(start, middle, end)) {
      points.push_back(end);
      return;
    }
    refine(start, middle, depth + 1, points);
    refine(middle, end, depth + 1, points);
  }

  bool is_on_chord(const DrawnPoint& start, const DrawnPoint& middle, const DrawnPoint& end) const {
    const auto departs = [&](double DrawnPoint::*member, double extent) {
      const double chord = 0.5 * (start.*member + end.*member);
      return std::abs(middle.*member - chord) > chord_tolerance * extent;
    };
    return !departs(&DrawnPoint::load_position, position_) &&
           !departs(&DrawnPoint::motor_position, position_) &&
           !departs(&DrawnPoint::load_speed, speed_) && !departs(&DrawnPoint::motor_speed, speed_);
  }

  const Motion& motion_;
  const AngleUnit& angle_;
  double longest_panel_;
  double position_ = std::numeric_limits<double>::min();
  double speed_ = std::numeric_limits<double>::min();
};

/// Rigid faces have impacts; compliant ones meet.
bool is_impact(const MotionEvent& event) {
  return event.what.starts_with("impact") || event.what.starts_with("faces meet");
}

/// The kind of event, without the remark that it was the last of infinitely many.
std::string_view kind_of(const MotionEvent& event) {
  return event.what.substr(0, event.what.find(" ("));
}

/// An interruption of the curve.
struct Break {
  double time;
  const MotionEvent* event;  ///< nullptr: a jump of the reference, or the end
};

std::vector<Break> breaks_of(const Motion& motion, const std::vector<double>& leaps) {
  std::vector<Break> breaks;
  for (const MotionEvent& event : motion.events()) breaks.push_back({event.time, &event});
  for (const double leap : leaps) {
    if (leap > 0.0 && leap < motion.end_time()) breaks.push_back({leap, nullptr});
  }
  sort_by(breaks, &Break::time);
  breaks.push_back({motion.end_time(), nullptr});
  return breaks;
}

}  // namespace

std::vector<DrawnPiece> drawn_motion(const Motion& motion, const AngleUnit& angle, double period,
                                     const std::vector<double>& leaps) {
  const std::vector<Break> breaks = breaks_of(motion, leaps);
  CurveTracer tracer(motion, angle, period);
  std::vector<std::vector<double>> panels;
  double from = 0.0;
  for (const Break& end : breaks) {
    panels.push_back(tracer.panels(from, end.time));
    for (const double time : panels.back()) tracer.include(tracer.point(time));
    from = end.time;
  }
  std::vector<DrawnPiece> pieces;
  const MotionEvent* begin = nullptr;
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const MotionEvent* end = breaks[i].event;
    DrawnPiece piece;
    piece.is_apart = motion.at(panels[i].front()).is_apart;
    piece.ends_with_impact = end != nullptr && is_impact(*end);
    piece.is_bounce = piece.is_apart && piece.ends_with_impact && begin != nullptr &&
                      is_impact(*begin) && kind_of(*begin) == kind_of(*end);
    piece.points = tracer.trace(panels[i]);
    pieces.push_back(std::move(piece));
    begin = end;
  }
  return pieces;
}

}  // namespace gearlash
