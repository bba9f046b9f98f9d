// Which torques a sampled controller holds over one period.
#pragma once

#include <cstddef>
#include <vector>

#include "base/interval.hpp"
#include "model/controller.hpp"

namespace gearlash {

template <class Number>
struct HeldTorqueOf {
  Number from = 0.0;    ///< s after a tick
  Number until = 0.0;   ///< s after the same tick
  std::size_t age = 0;  ///< ticks since the readings of which it was worked out

  static constexpr auto members() {
    return std::make_tuple(&HeldTorqueOf::from, &HeldTorqueOf::until, &HeldTorqueOf::age);
  }
};
using HeldTorque = HeldTorqueOf<double>;

/// In order, from one tick to the next. Precondition: a sound sampling.
std::vector<HeldTorque> held_torques(const Sampling& sampling);

/// Contains those of every sampling with such a period and delay, s, of which `form` is one.
///
/// A delay of whole periods by split_delay() may be a little shorter or longer. The torque before
/// it and the one after it then are held too, over a time from 0 to that little. Not so where the
/// form's delay is the rounded product of its period, or their shortest decimals are a multiple:
/// that is what was written.
std::vector<HeldTorqueOf<Interval>> held_torques(const Interval& period, const Interval& delay,
                                                 const Sampling& form);

}  // namespace gearlash
