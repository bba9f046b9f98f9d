// Pictures of the motion of a drive, drawn by gnuplot.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gearlash/drive.hpp"
#include "gearlash/motion.hpp"
#include "input/units.hpp"
#include "picture/picture.hpp"

namespace gearlash {

struct DrawnMotion {
  Motion motion{};
  std::string name{};  ///< follows "load" and "motor" in the legend: "stable cycle ±0.5 deg"
  std::string name_of_motor{};  ///< follows "motor" instead, unless empty
  bool is_cycle = false;        ///< one period, drawn closed
  bool is_background = false;   ///< thin; gaps and impacts would hide the others
};

struct MotionPicture {
  std::string title{};     ///< one line
  std::string subtitle{};  ///< a headline, or empty
  Drive drive{};           ///< its numbers are shown below the title
  std::vector<DrawnMotion> motions{};
  AngleUnit angle{};    ///< of the axes
  double period = 1.0;  ///< s, of the loop: see drawn_motion()
  /// s, of the hunting, if it is known: the last three periods are enlarged. 0: measured.
  double hunting_period = 0.0;
};

/// A picture with more than these numbers would be unreadable.
inline constexpr std::size_t most_events_drawn = 20'000;
inline constexpr double most_periods_drawn = 1'600.0;

/// Draws the first motion over time: the positions of load and motor with the reference and the gap
/// around the load, the gap between its faces, and the motor's torque with its limit. If the motion
/// ends in an oscillation, or at an error, that is small or fast beside the whole, a second column
/// shows the end alone, relative to the reference, with the encoder's steps where they are visible.
///
/// Returns the bytes of the picture; the same motion gives the same SVG. Throws InvalidInput for
/// more than most_events_drawn events or most_periods_drawn periods, and OutputError if gnuplot is
/// missing or fails.
std::string draw_time_response(const MotionPicture& picture, PictureFormat format);

/// Draws speed over position relative to the reference: load (solid), motor (dashed), the gap
/// between them (shaded while the faces are apart) and impacts. Otherwise like
/// draw_time_response().
std::string draw_phase_plane(const MotionPicture& picture, PictureFormat format);

}  // namespace gearlash
