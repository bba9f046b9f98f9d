// Follows a cycle of a searched drive from one value of a parameter to another.
#pragma once

#include <optional>
#include <vector>

#include "analysis/grid/axis.hpp"
#include "general/attractors/attractors.hpp"

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
  CycleFollowing(const Drive& drive, const Axis& axis) : drive_(drive), axis_(axis) {}

  FollowedCycle known(double parameter, const drive::AttractorSearch& search,
                      const drive::FoundCycle& cycle) const;

  /// By Newton's method in steps that are halved where it fails, down to 1/512 of the way. A cycle
  /// whose amplitudes differ by more than a quarter from the last one's is another.
  FollowedWay to(const FollowedCycle& from, double parameter) const;

  /// Of two neighbours that differ in stability: the cycle between them at which it changes.
  FollowedCycle stability_change(const FollowedCycle& one, const FollowedCycle& other) const;

 private:
  std::optional<FollowedCycle> step(const FollowedCycle& from, double parameter) const;

  const Drive& drive_;
  const Axis& axis_;
};

/// Whether two cycles of one drive are the same to the accuracy of Newton's method.
bool is_same_cycle(const drive::FoundCycle& one, const drive::FoundCycle& other);

}  // namespace gearlash
