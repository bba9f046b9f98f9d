// References and load torques over time.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace gearlash {

// Times in s; values in rad (a reference) or N m (a load torque). Before its first named time a
// signal is constant.

struct StepSignal {
  double before = 0.0;  ///< until `time`
  double after = 0.0;   ///< from `time` on
  double time = 0.0;    ///< s

  bool operator==(const StepSignal&) const = default;
};

/// value + rate · (t − time).
struct RampSignal {
  double value = 0.0;  ///< until `time`
  double rate = 0.0;   ///< per s
  double time = 0.0;   ///< s

  bool operator==(const RampSignal&) const = default;
};

/// mean + amplitude sin(frequency t + phase), at all times.
struct SineSignal {
  double mean = 0.0;       ///< rad or N m
  double amplitude = 0.0;  ///< rad or N m
  double frequency = 0.0;  ///< rad/s, > 0
  double phase = 0.0;      ///< rad

  bool operator==(const SineSignal&) const = default;
};

/// From one position to another at limited speed and acceleration, as fast as both permit.
struct TrapezoidSignal {
  double from = 0.0;          ///< rad or N m
  double to = 0.0;            ///< rad or N m
  double speed = 0.0;         ///< per s, > 0
  double acceleration = 0.0;  ///< per s², > 0
  double time = 0.0;          ///< of the start

  bool operator==(const TrapezoidSignal&) const = default;
};

/// Straight lines from point to point; constant after the last.
struct TableSignal {
  std::vector<double> times{};   ///< rising, at least one
  std::vector<double> values{};  ///< rad or N m, as many
  std::string file{};  ///< the CSV file of the points, as its author named it; empty without one

  bool operator==(const TableSignal&) const = default;
};

/// A plain number is a constant signal.
using Signal =
    std::variant<double, StepSignal, RampSignal, SineSignal, TrapezoidSignal, TableSignal>;

}  // namespace gearlash
