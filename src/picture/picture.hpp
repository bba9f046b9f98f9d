// Pictures of a servo's motion, drawn by gnuplot.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "closed_form/limit_cycle.hpp"
#include "closed_form/trajectory.hpp"
#include "output/report_units.hpp"

namespace gearlash {

enum class PictureFormat { svg, png, pdf };

/// By the ending of the file's name, .svg, .png or .pdf in small or capital letters. Throws
/// InvalidInput, with `field` at fault, for any other.
PictureFormat picture_format(const std::string& field, const std::filesystem::path& path);

struct MotionPicture {
  std::string title = {};  ///< one line; the servo's numbers are drawn below it
  NormalizedServo servo = {};
  Trajectory trajectory = {};
  double reference = 0.0;                          ///< rad, as simulated
  std::optional<LimitCycle> cycle = std::nullopt;  ///< drawn bold in the phase plane
  ReportUnits units = {};                          ///< of the axes: positions are in units.angle
};

/// A picture of more could not be read.
inline constexpr std::size_t most_events_drawn = 20'000;
inline constexpr double longest_time_drawn = 10'000.0;  ///< normalised

/// Position over time: load (solid) and motor (dashed), the band of ± half the backlash about the
/// load in which the motor is free to move, the intervals in which the faces are apart, impacts.
///
/// Returns the bytes of the picture; the same motion gives the same SVG. Throws InvalidInput for
/// more than most_events_drawn events or longest_time_drawn, OutputError where gnuplot is missing
/// or fails.
std::string draw_time_response(const MotionPicture& picture, PictureFormat format);

/// Speed over position from the reference: load (solid) and motor (dashed), the gap between them
/// shaded while the faces are apart, impacts, and the limit cycle in bold over the transient.
/// Otherwise like draw_time_response.
std::string draw_phase_plane(const MotionPicture& picture, PictureFormat format);

}  // namespace gearlash
