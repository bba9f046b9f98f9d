// What is asked of a drive, or acts on it, over time: references and load torques.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/violation.hpp"

namespace gearlash::drive {

// Times in s; values in rad or N m. Before the first time that a signal names it is what it is
// there.

struct StepSignal {
  double before = 0.0;
  double after = 0.0;  ///< from `time` on
  double time = 0.0;

  bool operator==(const StepSignal&) const = default;
};

/// value + rate · (t − time).
struct Ramp {
  double value = 0.0;  ///< until `time`
  double rate = 0.0;   ///< per s
  double time = 0.0;

  bool operator==(const Ramp&) const = default;
};

/// mean + amplitude sin(frequency t + phase), at all times.
struct Sine {
  double mean = 0.0;
  double amplitude = 0.0;
  double frequency = 0.0;  ///< rad/s, > 0
  double phase = 0.0;      ///< rad

  bool operator==(const Sine&) const = default;
};

/// From one position to another with limited speed and acceleration: as fast as both permit.
struct Trapezoid {
  double from = 0.0;
  double to = 0.0;
  double speed = 0.0;         ///< per s, > 0
  double acceleration = 0.0;  ///< per s², > 0
  double time = 0.0;          ///< of its start

  bool operator==(const Trapezoid&) const = default;
};

/// Straight from point to point; beyond the last one it stays.
struct Table {
  std::vector<double> times{};  ///< rising, at least one
  std::vector<double> values{};

  bool operator==(const Table&) const = default;
};

/// A number stands for what is always the same.
using Signal = std::variant<double, StepSignal, Ramp, Sine, Trapezoid, Table>;

/// Every violation of the ranges above; `field` is what the signal is called.
std::vector<Violation> validate(const Signal& signal, const std::string& field);

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
