#include "picture/drawn_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "closed_form/phase.hpp"

namespace gearlash {
namespace {

/// Of the extent of the picture: a sixth of a line's width, at which no corner shows.
constexpr double chord_tolerance = 4e-4;
constexpr int deepest_bisection = 12;
/// A smooth piece this short, in units of 1/ω_n, cannot hide a wiggle from its middle.
constexpr double longest_first_panel = 0.5;

int panel_count(double duration) {
  return std::max(1, static_cast<int>(std::ceil(duration / longest_first_panel)));
}

class CurveTracer {
 public:
  CurveTracer(const NormalizedServo& servo, const ReportUnits& units)
      : dynamics_(servo_dynamics(servo)), units_(units) {}

  void set_extent(double position, double speed) {
    position_extent_ = position;
    speed_extent_ = speed;
  }

  CurvePoint point(const Segment& segment, double time) const {
    const GapState state = state_in_phase(dynamics_, segment.phase, time);
    const AngleUnit& angle = units_.angle;
    const auto speed = [&](double value) { return angle.from_radians(units_.speed(value)); };
    return {.time = units_.time(segment.start + time),
            .load_position = angle.from_radians(state.load_position),
            .load_speed = speed(state.load_speed),
            .motor_position = angle.from_radians(state.load_position + state.gap),
            .motor_speed = speed(state.load_speed + state.gap_speed)};
  }

  std::vector<CurvePoint> trace(const Segment& segment) const {
    const double duration = segment.end - segment.start;
    std::vector<CurvePoint> points = {point(segment, 0.0)};
    const int panels = panel_count(duration);
    for (int i = 0; i < panels; ++i) {
      const double from = duration * i / panels;
      const double to = duration * (i + 1) / panels;
      const CurvePoint start = points.back();
      refine(segment, from, start, to, point(segment, to), 0, points);
    }
    return points;
  }

 private:
  /// Adds the points after `from` up to `to`, halving where the middle is off the chord.
  void refine(const Segment& segment, double from, const CurvePoint& start, double to,
              const CurvePoint& end, int depth, std::vector<CurvePoint>& points) const {
    const double middle_time = 0.5 * (from + to);
    const CurvePoint middle = point(segment, middle_time);
    if (depth >= deepest_bisection || on_chord(start, middle, end)) {
      points.push_back(end);
      return;
    }
    refine(segment, from, start, middle_time, middle, depth + 1, points);
    refine(segment, middle_time, middle, to, end, depth + 1, points);
  }

  bool on_chord(const CurvePoint& start, const CurvePoint& middle, const CurvePoint& end) const {
    const auto departs = [&](double CurvePoint::*member, double extent) {
      const double chord = 0.5 * (start.*member + end.*member);
      return std::abs(middle.*member - chord) > chord_tolerance * extent;
    };
    return !departs(&CurvePoint::load_position, position_extent_) &&
           !departs(&CurvePoint::motor_position, position_extent_) &&
           !departs(&CurvePoint::load_speed, speed_extent_) &&
           !departs(&CurvePoint::motor_speed, speed_extent_);
  }

  ServoDynamics dynamics_;
  ReportUnits units_;
  double position_extent_ = 1.0;
  double speed_extent_ = 1.0;
};

/// Of the ends of the first panels: enough for a tolerance.
void measure_extent(const Trajectory& trajectory, CurveTracer& tracer) {
  double position = 0.0;
  double speed = 0.0;
  for (const Segment& segment : trajectory.segments()) {
    const double duration = segment.end - segment.start;
    const int panels = panel_count(duration);
    for (int i = 0; i <= panels; ++i) {
      const CurvePoint point = tracer.point(segment, duration * i / panels);
      position =
          std::max({position, std::abs(point.load_position), std::abs(point.motor_position)});
      speed = std::max({speed, std::abs(point.load_speed), std::abs(point.motor_speed)});
    }
  }
  constexpr double smallest = std::numeric_limits<double>::min();
  tracer.set_extent(std::max(position, smallest), std::max(speed, smallest));
}

/// The impact at a time, if there is one.
const Event* impact_at(const Trajectory& trajectory, double time) {
  const auto& events = trajectory.events();
  const auto event =
      std::lower_bound(events.begin(), events.end(), time,
                       [](const Event& candidate, double value) { return candidate.time < value; });
  if (event == events.end() || event->time != time) return nullptr;
  return event->kind == EventKind::impact ? &*event : nullptr;
}

/// Whether a flight goes from a rebound back to the same face.
bool is_bounce(const NormalizedServo& servo, const Segment& segment, const Event* end) {
  const GapFlight& flight = segment.phase.flight;
  return segment.phase.mode == Mode::separated && end != nullptr && flight.gap_speed != 0.0 &&
         std::abs(flight.gap) == 0.5 * servo.backlash &&
         (end->face == Face::forward) == (flight.gap > 0.0);
}

}  // namespace

std::vector<CurvePiece> drawn_curve(const NormalizedServo& servo, const Trajectory& trajectory,
                                    const ReportUnits& units) {
  CurveTracer tracer(servo, units);
  measure_extent(trajectory, tracer);
  std::vector<CurvePiece> pieces;
  for (const Segment& segment : trajectory.segments()) {
    const Event* impact = impact_at(trajectory, segment.end);
    pieces.push_back({.separated = segment.phase.mode == Mode::separated,
                      .is_bounce = is_bounce(servo, segment, impact),
                      .ends_with_impact = impact != nullptr,
                      .points = tracer.trace(segment)});
  }
  return pieces;
}

}  // namespace gearlash
