// The exact answer beside which everything of 1960 is put.
#pragma once

#include <optional>

#include "gearlash/cycle/limit_cycle.hpp"

namespace gearlash::heritage {

/// Size of the largest stable limit cycle, rad; nothing where there is none.
inline std::optional<double> exact_size(const NormalizedServo& servo) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle* cycle = largest_stable(analysis);
  return cycle != nullptr ? std::optional(cycle->size) : std::nullopt;
}

}  // namespace gearlash::heritage
