// Which torques a sampled controller holds over one period.
#pragma once

#include <cstddef>
#include <vector>

#include "model/controller.hpp"

namespace gearlash {

struct HeldTorque {
  double from = 0.0;    ///< s after a tick
  double until = 0.0;   ///< s after the same tick
  std::size_t age = 0;  ///< ticks since the readings of which it was worked out
};

/// In order, from one tick to the next. Precondition: a sound sampling.
inline std::vector<HeldTorque> held_torques(const drive::Sampling& sampling) {
  const drive::SplitDelay delay = drive::split_delay(sampling);
  if (delay.rest == 0.0) return {{0.0, sampling.period, 0}};
  const auto newest = static_cast<std::size_t>(delay.whole_periods);
  if (delay.rest >= sampling.period) return {{0.0, sampling.period, newest + 1}};
  return {{0.0, delay.rest, newest + 1}, {delay.rest, sampling.period, newest}};
}

}  // namespace gearlash
