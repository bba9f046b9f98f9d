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
  std::string name{};          ///< after "load" and "motor" in the legend: "stable cycle ±0.5 deg"
  bool is_cycle = false;       ///< one period, drawn closed
  bool is_background = false;  ///< thin, without gaps and impacts: those would hide the others
};

struct MotionPicture {
  std::string title{};     ///< one line
  std::string subtitle{};  ///< what is known of it: a headline, or nothing
  Drive drive{};           ///< its numbers stand below the title
  std::vector<DrawnMotion> motions{};
  AngleUnit angle{};    ///< of the axes
  double period = 1.0;  ///< s, of the loop: see drawn_motion()
};

/// A picture of more could not be read.
inline constexpr std::size_t most_events_drawn = 20'000;
inline constexpr double most_periods_drawn = 1'600.0;

/// Over time, one above the other: position of load and motor with the reference and the gap about
/// the load; the same enlarged about the reference where the motion ends in swings that are small
/// beside it; the gap between its faces; the motor's torque with its limit. Of the first motion.
///
/// Returns the bytes of the picture; the same motion gives the same SVG. Throws InvalidInput for
/// more than most_events_drawn events or most_periods_drawn, OutputError where gnuplot is missing
/// or fails.
std::string draw_time_response(const MotionPicture& picture, PictureFormat format);

/// Speed over position from the reference: load (solid) and motor (dashed), the gap between them
/// shaded while the faces are apart, impacts. Otherwise like draw_time_response.
std::string draw_phase_plane(const MotionPicture& picture, PictureFormat format);

}  // namespace gearlash
