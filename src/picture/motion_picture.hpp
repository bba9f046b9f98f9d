// Pictures of the motion of a drive, drawn by gnuplot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/motion.hpp"
#include "gearlash/plot.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

/// How the line of a motion differs from others.
enum class MotionRole : std::uint8_t {
  subject,     ///< load, motor, gap and impacts
  background,  ///< load and motor, thin
  unstable,    ///< like a subject, but thin, with dots, and without the gap
  to_rest,     ///< from here on: one shaft alone, thin, one legend entry for all of a kind
  to_hunting,
  running_away,
  not_known
};

/// A mark where a start was watched, by what it leads to.
struct DrawnStart {
  double position = 0.0;  ///< from the reference, in the picture's unit
  double speed = 0.0;
  MotionRole leads = MotionRole::to_rest;
};

struct DrawnMotion {
  Motion motion{};
  std::string name{};  ///< follows "load" and "motor" in the legend: "stable cycle ±0.5 deg"
  std::string name_of_motor{};  ///< follows "motor" instead, unless empty
  bool is_cycle = false;        ///< one period, drawn closed
  double from = 0.0;            ///< s, where a phase plane begins
  MotionRole role = MotionRole::subject;
};

/// What a phase plane shows, in the picture's unit, with the starts in it.
struct PhaseWindow {
  Bounds positions{};  ///< from the reference
  Bounds speeds{};
  bool is_of_motor = false;  ///< roles of one shaft are of the motor's, else of the load's
  std::vector<DrawnStart> starts{};
  /// The borders between starts that lead to different ends.
  std::vector<MapCurve> borders{};
};

struct MotionPicture {
  std::string title{};     ///< one line
  std::string subtitle{};  ///< a headline, or empty
  Drive drive{};           ///< below the title are its numbers; axes have its unit of angles
  std::vector<DrawnMotion> motions{};
  double period = 1.0;  ///< s, of the loop: see drawn_motion()
  /// s, of the hunting, if it is known: the last three periods are enlarged. 0: measured.
  double hunting_period = 0.0;
  std::optional<PhaseWindow> window{};  ///< default: all of the motions
};

/// A picture with more than these numbers would be unreadable.
inline constexpr std::size_t most_events_drawn = 20'000;
inline constexpr double most_periods_drawn = 1'600.0;

/// The first motion over time: the positions of load and motor with the reference, the gap around
/// the load and what an encoder reads, the gap between its faces, and the motor's torque with its
/// limit. If the motion ends in an oscillation, or at an error, that is small or fast beside the
/// whole, a second column shows the end alone, relative to the reference, with the encoder's steps
/// where they are visible. Throws InvalidInput for more than most_events_drawn events or
/// most_periods_drawn periods.
Plot time_plot(const MotionPicture& picture);

/// Speed over position relative to the reference: load (solid), motor (dashed), the gap between
/// them (shaded while the faces are apart, without a window) and impacts, at which speeds leap
/// along dotted lines; marks of starts and the borders between them. Throws like time_plot().
Plot phase_plot(const MotionPicture& picture);

}  // namespace gearlash
