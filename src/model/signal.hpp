// What is asked of a drive, or acts on it, over time: references and load torques.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/fault.hpp"
#include "gearlash/signal.hpp"

namespace gearlash::drive {

using gearlash::StepSignal;
using Ramp = RampSignal;
using Sine = SineSignal;
using Trapezoid = TrapezoidSignal;
using Table = TableSignal;
using gearlash::Signal;

/// Every fault of the ranges of gearlash/signal.hpp; `field` is what the signal is called.
std::vector<Fault> validate(const Signal& signal, const std::string& field);

/// Precondition of the rest: validate(signal) is empty.
double value_at(const Signal& signal, double time);

/// What the signal does for ever in the end: itself, for a sine; a ramp from time 0 on; else the
/// value that it stays at.
Signal settled(const Signal& signal);

/// When settled(signal) begins to be so.
double settling_time(const Signal& signal);

/// A stretch of a signal with one second derivative.
struct SignalStretch {
  double start = 0.0;
  double value = 0.0;         ///< at its start
  double rate = 0.0;          ///< at its start, per s
  double acceleration = 0.0;  ///< per s²
};

/// All from time 0 on, the last without end; not for a sine, which has none.
std::vector<SignalStretch> stretches(const Signal& signal);

}  // namespace gearlash::drive
