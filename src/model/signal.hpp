// References and load torques over time.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gearlash/fault.hpp"
#include "gearlash/signal.hpp"

namespace gearlash::drive {

using gearlash::StepSignal;
using Ramp = RampSignal;
using Sine = SineSignal;
using Trapezoid = TrapezoidSignal;
using Table = TableSignal;
using gearlash::Signal;

/// A row is a stretch of its own, which a motion passes as a tick.
inline constexpr std::size_t most_rows_of_a_table = 1'000'000;

/// What the points of a table have wrong; all other numbers are parameters, with ranges of their
/// own. `field` is the signal's name.
std::vector<Fault> faults(const Signal& signal, const std::string& field);

/// The other functions require a signal without faults.
double value_at(const Signal& signal, double time);

/// The signal's final behaviour: a sine itself; a ramp with its start moved to time 0; otherwise
/// the final value.
Signal settled(const Signal& signal);

/// The signal plus a constant.
Signal shifted(Signal signal, double by);

/// The mean of a settled signal in the end: of a sine its mean, of a ramp its value at time 0.
double middle_of(const Signal& settled_signal);

/// The time from which the signal equals settled(signal); for a ramp, but for a constant.
double settling_time(const Signal& signal);

/// A part of a signal with one second derivative.
struct SignalStretch {
  double start = 0.0;
  double value = 0.0;         ///< at its start
  double rate = 0.0;          ///< at its start, per s
  double acceleration = 0.0;  ///< per s²
};

/// All stretches from time 0 on; the last has no end. Precondition: not a sine, which has none.
std::vector<SignalStretch> stretches(const Signal& signal);

}  // namespace gearlash::drive
