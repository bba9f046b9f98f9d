#include "propagator.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>

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

using Matrix = std::array<std::array<Extended, 4>, 4>;

std::vector<Matrix> table(const RawServo<Digits100>& servo, Motion motion) {
  const Digits100 shortest = ldexp(Digits100(1), -shortest_step_level);
  WideMatrix growth = shortest_growth(system_matrix(servo, motion), shortest);
  std::vector<Matrix> levels(static_cast<std::size_t>(shortest_step_level - longest_step_level) +
                             1);
  for (int level = shortest_step_level; level >= longest_step_level; --level) {
    for (unsigned row = 0; row < 4; ++row) {
      for (unsigned column = 0; column < 4; ++column) {
        levels[static_cast<std::size_t>(level - longest_step_level)][row][column] =
            growth[row][column].convert_to<Extended>();
      }
    }
    growth = combination(2, growth, 1, product(growth, growth));
  }
  return levels;
}

}  // namespace

struct OdeintPropagator::Stepper {
  using Method = boost::numeric::odeint::runge_kutta_fehlberg78<ExtendedState, Extended,
                                                                ExtendedState, Extended>;
  using Controlled = boost::numeric::odeint::controlled_runge_kutta<Method>;
  /// Of static storage, because odeint copies the scratch space of a new method before using it.
  static const Method& blank_method() {
    static const Method method;
    return method;
  }
  Controlled controlled{Controlled::error_checker_type(Extended(1e-19L), Extended(1e-18L)),
                        Controlled::step_adjuster_type(), blank_method()};
};

OdeintPropagator::OdeintPropagator(const RawServo<Extended>& servo)
    : servo_(servo), stepper_(std::make_unique<Stepper>()) {}
OdeintPropagator::OdeintPropagator(OdeintPropagator&&) noexcept = default;
OdeintPropagator::~OdeintPropagator() = default;

ExtendedState OdeintPropagator::advance(Motion motion, const ExtendedState& start, int level) {
  ExtendedState z = start;
  const Extended step = std::ldexp(Extended(1), -level);
  const auto derivative = [&](const ExtendedState& at, ExtendedState& rate, Extended) {
    rate = motion == Motion::engaged ? engaged_derivative(servo_, at) : gap_derivative(servo_, at);
  };
  boost::numeric::odeint::integrate_adaptive(stepper_->controlled, derivative, z, Extended(0), step,
                                             step);
  return z;
}

ExponentialPropagator::ExponentialPropagator(const NormalizedServo& servo)
    : engaged_(table(raw_servo<Digits100>(servo), Motion::engaged)),
      gap_(table(raw_servo<Digits100>(servo), Motion::gap)) {}

}  // namespace gearlash::oracle
