// A motion as the few points that a picture needs.
#pragma once

#include <vector>

#include "gearlash/motion.hpp"
#include "input/units.hpp"

namespace gearlash {

/// In the units of the picture.
struct DrawnPoint {
  double time = 0.0;
  double load_position = 0.0;
  double load_speed = 0.0;
  double motor_position = 0.0;
  double motor_speed = 0.0;
  double motor_torque = 0.0;  ///< N m
  double reference = 0.0;
};

/// From one event, or leap of the reference, to the next.
struct DrawnPiece {
  bool is_apart = false;
  bool is_bounce = false;  ///< from a face back to it after a rebound
  bool ends_with_impact = false;
  std::vector<DrawnPoint> points{};  ///< both ends included; the last one is before what ends it
};

/// Points so dense that the chords between them depart from the motion by less than the width of a
/// line, at least twelve in a period of the loop (s). `leaps`: times at which the reference leaps,
/// rising.
std::vector<DrawnPiece> drawn_motion(const Motion& motion, const AngleUnit& angle, double period,
                                     const std::vector<double>& leaps);

}  // namespace gearlash
