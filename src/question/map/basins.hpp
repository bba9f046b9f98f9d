// Where motions end that start in a plane of positions and speeds, and the borders between.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "general/attractors/attractors.hpp"
#include "question/map/region_boundary.hpp"

namespace gearlash {

/// Ends of motions, as far as a basin is named by them.
enum class BasinKind : std::uint8_t { rest, hunting, running_away, not_known };

BasinKind kind_of(drive::MotionEnd end);

/// A rectangle of starts about the reference, symmetric to it: positions up to `position` (rad) and
/// speeds up to `speed` (rad/s) to both sides.
struct StartPlane {
  double position = 0.0;
  double speed = 0.0;
  /// The motor's position and speed, which matter if the motor hunts within the gap; else the
  /// load's.
  bool is_of_motor = false;
  std::size_t columns = 21;
  std::size_t rows = 13;
};

struct Basins {
  Axis positions{};                ///< rad, from the reference
  Axis speeds{};                   ///< rad/s
  std::vector<BasinKind> kinds{};  ///< of the points, positions fastest
  std::vector<MapCurve> borders{};
  bool is_complete = true;  ///< not stopped

  bool has(BasinKind kind) const;
};

/// The start in which both shafts have the speed and stand on the face that the controller presses
/// to. `position`, of the plane's shaft, is measured from the constant reference of `drive`.
drive::ShaftStates start_on_face(const drive::ReducedDrive& drive, const StartPlane& plane,
                                 double position, double speed);

/// Watches every point of the plane (start_on_face(), the controller's own numbers at their usual
/// start), with the cycles of `known` known from the beginning; of a drive that is its own mirror
/// image, half of them. The borders are then traced by watching single starts: a place on each edge
/// of the grid whose ends differ, by 5 bisections, and as many on long chords. Basins narrower than
/// the grid may be missed. Precondition: the reference is constant.
Basins basins_of(const drive::ReducedDrive& drive, const drive::AttractorSearch& known,
                 const StartPlane& plane, Progress& progress = no_progress());

}  // namespace gearlash
