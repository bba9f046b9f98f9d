// Two unrelated ways to carry a state of the raw equations forward in time: Boost.odeint in
// extended precision, and the matrix exponential by repeated squaring in a hundred digits.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "raw_equations.hpp"

namespace gearlash::oracle {

using Extended = long double;
using ExtendedState = State<Extended>;

enum class Motion { engaged, gap };

/// Steps are powers of two, 2^-level.
inline constexpr int longest_step_level = 5;     // 1/32 of 1/ω_n
inline constexpr int shortest_step_level = 120;  // about 1e-36

/// Integrates the raw equations with a Runge–Kutta–Fehlberg 7(8) of local error 1e-18. Its cost
/// grows with the fastest rate, so it suits servos that are not stiff.
class OdeintPropagator {
 public:
  explicit OdeintPropagator(const RawServo<Extended>& servo);
  OdeintPropagator(OdeintPropagator&&) noexcept;
  ~OdeintPropagator();

  ExtendedState advance(Motion motion, const ExtendedState& start, int level);

 private:
  struct Stepper;  // Boost's headers are read once
  RawServo<Extended> servo_;
  std::unique_ptr<Stepper> stepper_;
};

/// Multiplies by exp(A 2^-level), A being the matrix of the raw equations. The exponentials of all
/// levels come from one chain: the Taylor sum at a step so short that few terms suffice, then
/// exp(2Ah) − 1 = 2E + E², E = exp(Ah) − 1, in a hundred digits, of which a chain of n squarings
/// loses no more than n·log10(2). Stiffness costs nothing.
class ExponentialPropagator {
 public:
  explicit ExponentialPropagator(const NormalizedServo& servo);

  ExtendedState advance(Motion motion, const ExtendedState& start, int level) const {
    const Matrix& growth = (motion == Motion::engaged ? engaged_ : gap_)[table_index(level)];
    ExtendedState z = start;
    for (unsigned row = 0; row < 4; ++row) {
      Extended change = 0;
      for (unsigned column = 0; column < 4; ++column) {
        change += growth[row][column] * start[column];
      }
      z[row] += change;
    }
    return z;
  }

 private:
  using Matrix = std::array<std::array<Extended, 4>, 4>;  // exp(A 2^-level) − 1
  static std::size_t table_index(int level) {
    return static_cast<std::size_t>(level - longest_step_level);
  }
  std::vector<Matrix> engaged_;
  std::vector<Matrix> gap_;
};

}  // namespace gearlash::oracle
