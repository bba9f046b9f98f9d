// Exact quotients of polynomials in s, rounded only when converted to numbers.
#pragma once

#include <boost/math/tools/polynomial.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "model/controller.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash::drive {

using Rational = boost::multiprecision::cpp_rational;
using Polynomial = boost::math::tools::polynomial<Rational>;

/// Without common factors, and with a leading coefficient 1 in the denominator: two equal functions
/// have the same representation. Every double is a rational number.
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

/// e^{−s delay} to its eighth order in s: p(−s)/p(s), of modulus 1 on the imaginary axis. The phase
/// is off by 7.9e-8 (ω delay)⁹ if that is small (Padé).
RationalFunction delay_approximation(double delay);

/// Each coefficient is rounded once.
TransferFunction rounded(const RationalFunction& function, double delay = 0.0);

/// The requested torque as a function of the reference, the measured position and speed, and the
/// delivered torque. Exact.
struct ExactControllerTransfer {
  RationalFunction reference;
  RationalFunction position;
  RationalFunction speed;
  RationalFunction given;  ///< through the anti-windup
};

enum class TorqueGiven {
  as_asked,  ///< the motor delivers the requested torque, `given` is 0
  limited    ///< the motor may deliver another torque, which the anti-windup knows
};

ExactControllerTransfer exact_transfer(const LinearController& controller, TorqueGiven torque);

}  // namespace gearlash::drive
