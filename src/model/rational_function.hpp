// Quotients of polynomials in s that are not rounded before they are asked for as numbers.
#pragma once

#include <boost/math/tools/polynomial.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "model/controller.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash::drive {

using Rational = boost::multiprecision::cpp_rational;
using Polynomial = boost::math::tools::polynomial<Rational>;

/// Without common factors, the denominator's leading coefficient 1: two equal functions are the
/// same. Every double is a rational number.
class RationalFunction {
 public:
  RationalFunction(const Rational& constant = 0);  // NOLINT(google-explicit-constructor)
  RationalFunction(double constant) : RationalFunction(Rational(constant)) {}  // NOLINT
  /// Precondition: the denominator is not 0.
  RationalFunction(Polynomial numerator, Polynomial denominator);

  const Polynomial& numerator() const { return numerator_; }
  const Polynomial& denominator() const { return denominator_; }
  bool is_zero() const { return numerator_.is_zero(); }

 private:
  Polynomial numerator_;
  Polynomial denominator_;
};

RationalFunction operator+(const RationalFunction& a, const RationalFunction& b);
RationalFunction operator-(const RationalFunction& a, const RationalFunction& b);
RationalFunction operator*(const RationalFunction& a, const RationalFunction& b);
/// Precondition: b is not 0.
RationalFunction operator/(const RationalFunction& a, const RationalFunction& b);

/// s itself.
RationalFunction variable();

/// function(argument(s)). Precondition: the denominator does not become 0.
RationalFunction composed(const RationalFunction& function, const RationalFunction& argument);

/// e^{−s delay} to its eighth order in s: p(−s)/p(s), of modulus 1 on the imaginary axis, the phase
/// off by 7.9e-8 (ω delay)⁹ where that is small (Padé).
RationalFunction delay_approximation(double delay);

/// Each coefficient is rounded once.
TransferFunction rounded(const RationalFunction& function, double delay = 0.0);

/// What the torque asked for is, by the reference, by the position and speed sensed, and by the
/// torque given: exact.
struct ExactControllerTransfer {
  RationalFunction reference;
  RationalFunction position;
  RationalFunction speed;
  RationalFunction given;  ///< through the anti-windup
};

enum class TorqueGiven {
  as_asked,  ///< the motor gives what is asked for, `given` is 0
  limited    ///< it may give something else, of which the anti-windup knows
};

ExactControllerTransfer exact_transfer(const LinearController& controller, TorqueGiven torque);

}  // namespace gearlash::drive
