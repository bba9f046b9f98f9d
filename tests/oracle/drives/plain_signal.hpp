// References and load torques of the fixed-step simulator: a constant and a course beside it.
#pragma once

#include <vector>

#include "gearlash/signal.hpp"

namespace gearlash::oracle {

/// What a signal adds to its constant: pieces with one second derivative each, or a sine.
struct PlainCourse {
  struct Piece {
    double start = 0.0;  ///< s; the first piece's value also holds before it
    double value = 0.0;
    double rate = 0.0;          ///< per s, at the start
    double acceleration = 0.0;  ///< per s²
  };
  std::vector<Piece> pieces{};  ///< by rising starts
  double amplitude = 0.0;       ///< of amplitude sin(frequency t + phase)
  double frequency = 0.0;       ///< rad/s
  double phase = 0.0;           ///< rad

  [[nodiscard]] bool moves() const { return amplitude != 0.0 || !pieces.empty(); }
  [[nodiscard]] double at(double time) const;
  [[nodiscard]] double rate_at(double time) const;          ///< per s; at a corner that after it
  [[nodiscard]] double acceleration_at(double time) const;  ///< per s²; likewise
  [[nodiscard]] double fastest() const;                     ///< per s, the largest |rate|
  /// Its largest size; of a ramp where that starts.
  [[nodiscard]] double size() const;
  /// Per s, of a ramp; else 0.
  [[nodiscard]] double last_rate() const { return pieces.empty() ? 0.0 : pieces.back().rate; }
  /// Whether it never becomes constant: a sine and a ramp.
  [[nodiscard]] bool goes_on() const { return amplitude != 0.0 || last_rate() != 0.0; }
  /// s, from which on it has its final course.
  [[nodiscard]] double settling_time() const { return pieces.empty() ? 0.0 : pieces.back().start; }
  /// s, of a sine; else 0.
  [[nodiscard]] double period() const;
  /// Its course in the end: nothing, the sine, or the ramp from time 0 on.
  [[nodiscard]] PlainCourse settled() const;

 private:
  [[nodiscard]] const Piece& piece_at(double time) const;
};

/// The final value, the mean of a sine, or the value at which a ramp starts; and the course.
struct PlainSignal {
  double constant = 0.0;
  PlainCourse course{};
};

[[nodiscard]] PlainSignal plain_signal(const Signal& signal);

}  // namespace gearlash::oracle
