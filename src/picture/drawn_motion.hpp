// A motion reduced to the few points that a picture needs.
#pragma once

#include <vector>

#include "gearlash/motion.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

/// Positions and speeds are in the picture's unit of angles; time is in s.
struct DrawnPoint {
  double time = 0.0;
  double load_position = 0.0;
  double load_speed = 0.0;
  double motor_position = 0.0;
  double motor_speed = 0.0;
  double motor_torque = 0.0;  ///< N m
  double reference = 0.0;
};

/// The motion from one event or jump of the reference to the next.
struct DrawnPiece {
  bool is_apart = false;
  bool is_bounce = false;  ///< from a face back to it after a rebound
  bool ends_with_impact = false;
  std::vector<DrawnPoint> points{};  ///< both ends included; the last is before the event
};

/// Chords between the points deviate from the motion by less than the width of a line. At least
/// twelve points lie in each `period` of the loop (s). `leaps`: rising times at which the reference
/// jumps (s).
std::vector<DrawnPiece> drawn_motion(const Motion& motion, const AngleUnit& angle, double period,
                                     const std::vector<double>& leaps);

/// Calls `visit` with each point of all pieces, from a time on (s).
template <class Visit>
void for_each_point(const std::vector<DrawnPiece>& pieces, const Visit& visit, double from = 0.0) {
  for (const DrawnPiece& piece : pieces) {
    for (const DrawnPoint& point : piece.points) {
      if (point.time >= from) visit(point);
    }
  }
}

}  // namespace gearlash
