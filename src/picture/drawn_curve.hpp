// A trajectory as the few points that a picture needs.
#pragma once

#include <vector>

#include "closed_form/trajectory.hpp"
#include "output/report_units.hpp"

namespace gearlash {

/// In the units of the picture, positions from the reference.
struct CurvePoint {
  double time;
  double load_position;
  double load_speed;
  double motor_position;
  double motor_speed;
};

/// One segment of the trajectory.
struct CurvePiece {
  bool separated;
  bool is_bounce = false;  ///< from a face back to it after a rebound
  bool ends_with_impact;
  std::vector<CurvePoint> points;  ///< both ends included; the last one is before the event
};

/// Points so dense that the chords between them depart from the motion by less than the width of a
/// line in either picture. Their number grows with the time: see longest_time_drawn.
std::vector<CurvePiece> drawn_curve(const NormalizedServo& servo, const Trajectory& trajectory,
                                    const ReportUnits& units);

}  // namespace gearlash
