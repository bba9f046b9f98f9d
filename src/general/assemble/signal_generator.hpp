// Signals as numbers of a state.
#pragma once

#include <vector>

#include "hybrid/hybrid_system.hpp"
#include "model/signal.hpp"

namespace gearlash::drive {

/// s′ = flow s, the signal being output · s + offset; at the times s becomes the setting.
struct Generator {
  hybrid::Matrix flow;
  hybrid::Vector output;
  double offset = 0.0;
  hybrid::Vector start;
  std::vector<double> times;
  std::vector<hybrid::Vector> settings;

  Eigen::Index size() const { return start.size(); }
};

/// With as many derivatives as the signal has; of a sine an oscillator. Precondition: sound.
Generator generator_of(const Signal& signal);

}  // namespace gearlash::drive
