// Where and how long attractors of a drive are looked for: coordinates, time scale, starts.
#pragma once

#include "general/assemble/moving_frame.hpp"
#include "general/attractors/attractors.hpp"
#include "general/attractors/motion_measures.hpp"

namespace gearlash::drive {

struct SearchSetting {
  ReducedDrive drive;  ///< of settled signals
  DriveSystem built;
  Coordinates coordinates = Coordinates::fixed;
  MovingFrame frame;
  hybrid::PreparedSystem system;      ///< in the frame
  hybrid::PreparedSystem with_turns;  ///< with events where the load turns, for motion without any
  Watched load;                       ///< position from the reference, rad, of the frame's numbers
  Watched motor;
  Eigen::Index own = 0;        ///< numbers before those of the signals
  double swing_time = 0.0;     ///< s
  double settling_time = 0.0;  ///< s
  double small_length = 0.0;   ///< rad: of backlash and encoder steps the smallest
  double large_length = 0.0;   ///< rad: of all that has a length the largest

  hybrid::State start(const ShaftStates& shafts) const;
  /// A time at or after a given one, when no clock ticks.
  double between_ticks(double time) const;
};

/// Throws InvalidInput.
SearchSetting search_setting(const ReducedDrive& drive, const StartTolerances& starts = {});

/// With scales such that all numbers of a motion are about 1.
SearchSetting scaled(const SearchSetting& setting, const hybrid::Trajectory& motion);

/// Neighbours in the list are neighbours as starts.
std::vector<ShaftStates> usual_starts(const SearchSetting& setting,
                                      const StartTolerances& tolerances = {});

}  // namespace gearlash::drive
