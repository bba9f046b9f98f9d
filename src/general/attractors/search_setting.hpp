// The setting of a search for attractors: coordinates, time scales, starts.
#pragma once

#include "general/assemble/moving_frame.hpp"
#include "general/attractors/attractors.hpp"
#include "general/attractors/motion_measures.hpp"

namespace gearlash::drive {

struct SearchSetting {
  ReducedDrive drive;  ///< with settled signals
  DriveSystem built;
  Coordinates coordinates = Coordinates::fixed;
  MovingFrame frame;
  hybrid::PreparedSystem system;  ///< in the frame
  hybrid::PreparedSystem
      with_turns;  ///< with events where the load turns, for motion that has no events
  Watched load;    ///< position from the reference, rad, of the frame's numbers
  Watched motor;
  /// rad, reference − load, where a sine moves the reference; else it is −load.
  std::optional<Watched> error;
  Eigen::Index own = 0;        ///< numbers before those of the signals
  double swing_time = 0.0;     ///< s
  double settling_time = 0.0;  ///< s
  double longest_sine = 0.0;   ///< s, the longest period of the sines that drive it; 0: none
  double common_sine = 0.0;    ///< s, the period of all these; 0: none, or different ones
  double small_length = 0.0;   ///< rad: the smallest of backlash and encoder steps
  double large_length = 0.0;   ///< rad: the largest of all lengths of the drive
  /// rad: the same, with lengths of torques however many backlashes they are. Infinite where a
  /// limited torque has none, because it does not grow with the position at once.
  double farthest_length = 0.0;
  /// rad: J T/d², over which the highest torque T brings the inertia J of both shafts to the speed
  /// at which their viscous friction d takes all of it. Swings under a limit end below it; 0
  /// without a limit or viscous friction.
  double braked_length = 0.0;

  hybrid::State start(const ShaftStates& shafts) const;
  /// A time, not before the given one, at which no clock ticks.
  double between_ticks(double time) const;
};

/// Throws InvalidInput.
SearchSetting search_setting(const ReducedDrive& drive, const StartTolerances& starts = {});

/// With scales that make all numbers of a motion about 1.
SearchSetting scaled(const SearchSetting& setting, const hybrid::Trajectory& motion);

/// rad: the error at which the controller's direct gain alone overcomes the dry friction of both
/// shafts. 0 without friction, or without such a gain.
double held_length(const ReducedDrive& drive);

/// rad: the largest error of a load that stands, and is not measured, while its motor moves within
/// the gap. Any place that the motor does not reach will do. 0 of a load that is measured.
double error_beside(const Extent& motor, const ReducedDrive& drive);

/// Whether motion to one side is the mirror image of motion to the other.
bool is_mirrored(const ReducedDrive& drive);
/// Whether its encoders read the mirror image of a position about the reference as the mirror image
/// of what they read of the position.
bool reads_mirrored(const ReducedDrive& drive);
/// Both.
bool is_own_image(const ReducedDrive& drive);

/// Neighbours in the list are neighbouring starts.
std::vector<ShaftStates> usual_starts(const SearchSetting& setting,
                                      const StartTolerances& tolerances = {});

}  // namespace gearlash::drive
