// Finds the cycle that a recurring motion is on.
#pragma once

#include <optional>
#include <vector>

#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {

class CycleClosing {
 public:
  /// Both must live as long.
  CycleClosing(const SearchSetting& setting, const AttractorOptions& options)
      : setting_(setting), options_(options), tolerances_(options.tolerances.cycle) {}

  /// The cycle at the end of a motion. The motion does not leave it again, and its amplitude
  /// agrees.
  std::optional<FoundCycle> closed_cycle(const hybrid::Trajectory& motion, double nearness) const;

  /// The shortest cycle, if an orbit goes round it several times. An orbit at rest stays as it is:
  /// it recurs after any time, however short.
  hybrid::PeriodicOrbit shortest(const hybrid::PeriodicOrbit& orbit) const;

  /// Among the known ones, a stable cycle that has the motion's last event in nearly the same
  /// state.
  std::optional<std::size_t> known_cycle_of(const hybrid::Trajectory& motion,
                                            const std::vector<FoundCycle>& known) const;

  /// Covers slightly more than the last period of a motion.
  Extent lately(const hybrid::Trajectory& motion, const Watched& watched, double period) const;

 private:
  std::optional<hybrid::PeriodicOrbit> closed(const hybrid::Trajectory& motion,
                                              double nearness) const;
  bool may_go_round(const hybrid::PeriodicOrbit& orbit, int times) const;
  bool hardly_moves(const hybrid::PeriodicOrbit& orbit) const;

  const SearchSetting& setting_;
  const AttractorOptions& options_;
  const CycleTolerances& tolerances_;
};

}  // namespace gearlash::drive
