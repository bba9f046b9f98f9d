#include "propagator.hpp"

namespace gearlash::oracle {
namespace {

using Digits100 = boost::multiprecision::cpp_bin_float_100;
using WideMatrix = std::array<std::array<Digits100, 4>, 4>;

WideMatrix system_matrix(const RawServo<Digits100>& servo, Motion motion) {
  WideMatrix matrix;
  for (unsigned column = 0; column < 4; ++column) {
    State<Digits100> unit{};
    unit[column] = 1;
    const State<Digits100> rate =
        motion == Motion::engaged ? engaged_derivative(servo, unit) : gap_derivative(servo, unit);
    for (unsigned row = 0; row < 4; ++row) matrix[row][column] = rate[row];
  }
  return matrix;
}

WideMatrix product(const WideMatrix& a, const WideMatrix& b) {
  WideMatrix c;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      c[row][column] = 0;
      for (unsigned k = 0; k < 4; ++k) c[row][column] += a[row][k] * b[k][column];
    }
  }
  return c;
}

/// a·x + b·y, entry by entry.
WideMatrix combination(const Digits100& a, const WideMatrix& x, const Digits100& b,
                       const WideMatrix& y) {
  WideMatrix c;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      c[row][column] = a * x[row][column] + b * y[row][column];
    }
  }
  return c;
}

/// exp(A h) − 1 for a step so short (‖Ah‖ < 1e-26 for rates up to 1e10) that ten terms exceed a
/// hundred digits.
WideMatrix shortest_growth(const WideMatrix& matrix, const Digits100& step) {
  constexpr int terms = 10;
  const WideMatrix scaled = combination(step, matrix, 0, matrix);
  WideMatrix term = scaled;
  WideMatrix sum = scaled;
  for (int n = 2; n <= terms; ++n) {
    term = combination(Digits100(1) / n, product(term, scaled), 0, term);
    sum = combination(1, sum, 1, term);
  }
  return sum;
}

}  // namespace

std::vector<ExponentialPropagator::Matrix> ExponentialPropagator::table(
    const RawServo<Digits100>& servo, Motion motion) {
  const Digits100 shortest = ldexp(Digits100(1), -shortest_step_level);
  WideMatrix growth = shortest_growth(system_matrix(servo, motion), shortest);
  std::vector<Matrix> levels(table_index(shortest_step_level) + 1);
  for (int level = shortest_step_level; level >= longest_step_level; --level) {
    for (unsigned row = 0; row < 4; ++row) {
      for (unsigned column = 0; column < 4; ++column) {
        levels[table_index(level)][row][column] = growth[row][column].convert_to<Extended>();
      }
    }
    growth = combination(2, growth, 1, product(growth, growth));
  }
  return levels;
}

ExponentialPropagator::ExponentialPropagator(const NormalizedServo& servo)
    : engaged_(table(raw_servo<Digits100>(servo), Motion::engaged)),
      gap_(table(raw_servo<Digits100>(servo), Motion::gap)) {}

}  // namespace gearlash::oracle
