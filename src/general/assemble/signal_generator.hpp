// Signals as part of a hybrid system's state.
#pragma once

#include <vector>

#include "hybrid/hybrid_system.hpp"
#include "model/signal.hpp"

namespace gearlash::drive {

/// s′ = flow s, with the signal output · s + offset. At the listed times s is set to the next
/// setting.
struct Generator {
  hybrid::Matrix flow;
  hybrid::Vector output;
  double offset = 0.0;
  hybrid::Vector start;
  std::vector<double> times;
  std::vector<hybrid::Vector> settings;

  Eigen::Index size() const { return start.size(); }
};

/// s holds the signal and its nonzero derivatives, or an oscillator for a sine. Precondition:
/// sound.
Generator generator_of(const Signal& signal);

}  // namespace gearlash::drive
