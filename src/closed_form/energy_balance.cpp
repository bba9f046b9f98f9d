#include "closed_form/energy_balance.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdlib>

#include "base/arithmetic.hpp"
#include "base/decimal.hpp"
#include "base/interval.hpp"

namespace gearlash {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// f + (1 − f) r and 4ζ² f (1 − f)(1 + r), both divided by 1 + r, in terms of the shafts' shares of
/// inertia.
template <class Number>
struct Sides {
  Number needed;
  Number given;

  Sides(const Number& damping, const Number& motor_share, const Number& load_share,
        const Number& friction_ratio)
      : needed(friction_ratio * motor_share + (1 - friction_ratio) * load_share),
        given(4 * damping * damping * friction_ratio * (1 - friction_ratio)) {}
};

/// The shortest decimal that reads back as the number.
Rational decimal(double value) {
  using boost::multiprecision::cpp_int;
  const auto [digits, exponent] = shortest_decimal(value);
  const cpp_int scale = pow(cpp_int(10), static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? Rational(digits, scale) : Rational(digits * scale);
}

bool is_dissipative_exactly(const NormalizedServo& servo, Reading reading) {
  const auto number = [&](double value) {
    return reading == Reading::exact ? Rational(value) : decimal(value);
  };
  const bool massless_motor = std::isinf(servo.inertia_ratio);
  const Rational ratio = massless_motor ? Rational(0) : number(servo.inertia_ratio);
  const Rational motor_share = massless_motor ? Rational(0) : Rational(1 / (1 + ratio));
  const Sides<Rational> sides(number(servo.damping), motor_share, 1 - motor_share,
                              number(servo.friction_ratio));
  return sides.needed <= sides.given;
}

}  // namespace

bool is_dissipative(const NormalizedServo& servo, Reading reading) {
  const double ratio = servo.inertia_ratio;
  const double motor_share = 1.0 / (1.0 + ratio);
  const double load_share = std::isinf(ratio) ? 1.0 : ratio / (1.0 + ratio);
  const Sides<double> sides(servo.damping, motor_share, load_share, servo.friction_ratio);
  // Each term is positive and off by a few units in the last place. The exception is 1 − f, which
  // both sides share: for a decimal f it is off by at most 1e-13 of itself here.
  constexpr double clearly = 1e-12;
  const double friction_left = 1.0 - servo.friction_ratio;
  if (friction_left > 1e-3 && std::abs(sides.needed - sides.given) > clearly * sides.needed) {
    return sides.needed < sides.given;
  }
  return is_dissipative_exactly(servo, reading);
}

bool is_dissipative(const ServoBox& box) {
  if (!proves()) return false;
  const auto time_constant = [](const Bounds& rate) {
    return std::isinf(rate.low) ? Interval(0.0) : 1.0 / Interval(rate);
  };
  const Interval needed = time_constant(box.motor_rate) + time_constant(box.load_rate);
  return needed.high <= (2.0 * Interval(box.damping)).low;
}

}  // namespace gearlash
