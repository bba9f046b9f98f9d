// Follows a cycle of a searched drive from one value of a parameter to another.
#pragma once

#include <optional>
#include <vector>

#include "gearlash/design.hpp"
#include "general/attractors/attractors.hpp"
#include "question/family/analysed_line.hpp"

namespace gearlash {

/// A cycle at a value, with the system that its orbit is of.
struct FollowedCycle {
  double parameter = 0.0;
  drive::FoundCycle cycle;
  drive::AttractorSearch context;  ///< with this cycle alone
};

struct FollowedWay {
  std::vector<FollowedCycle> passed;  ///< between both values, in the order of the way
  std::optional<FollowedCycle> end;  ///< at the other value; empty if the cycle was lost on the way
};

class CycleFollowing {
 public:
  CycleFollowing(const Drive& drive, const Axis& axis, Progress& progress)
      : drive_(drives_along(axis, drive)), axis_(axis), progress_(progress) {}

  FollowedCycle known(double parameter, const drive::AttractorSearch& search,
                      const drive::FoundCycle& cycle) const;

  /// By Newton's method in steps that are halved where it fails, down to 1/512 of the way. A cycle
  /// whose amplitudes differ by more than a quarter from the last one's is another. Lost where it
  /// is stopped.
  FollowedWay to(const FollowedCycle& from, double parameter) const;

 private:
  std::optional<FollowedCycle> step(const FollowedCycle& from, double parameter) const;

  DriveAlong drive_;
  const Axis& axis_;
  Progress& progress_;
};

/// Where a cycle that exists at `from` ends or changes its stability, on the way to `to`, by
/// continue_orbit(): to 1e-9 of the value, to 1e-4 where it grazes. Unnamed if it does neither, if
/// the reason is unknown, or if the drive is unsound on the way. A cycle of more than 400 events is
/// not followed. Unnamed too if it is stopped.
Border end_of_cycle(const DriveAlong& drive, const drive::FoundCycle& cycle, double from, double to,
                    Progress& progress);

/// Whether two cycles of one drive are the same to the accuracy of Newton's method.
bool is_same_cycle(const drive::FoundCycle& one, const drive::FoundCycle& other);

}  // namespace gearlash
