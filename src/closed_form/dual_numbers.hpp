// Numbers with derivatives (forward automatic differentiation), and the motion's functions of them.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "closed_form/decay_derivatives.hpp"
#include "closed_form/engaged_flow.hpp"
#include "closed_form/gap_flight.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// A number with its derivatives by `count` others.
template <int count>
using BasicDual = Eigen::AutoDiffScalar<Eigen::Matrix<double, count, 1>>;

/// Places of the servo's own numbers among the derivatives; any others follow. The load's share of
/// the inertia, r/(1 + r), represents the inertia ratio.
enum ServoNumber : int { by_damping, by_load_share, by_friction_ratio, servo_numbers };

template <class Dual>
Dual chained(double value, double slope, const Dual& of) {
  return {value, slope * of.derivatives()};
}

template <class Dual>
BasicDecay<Dual> dual_decay(const Dual& exponent) {
  const Decay at = decay(exponent.value());
  const DecaySlope slope = decay_slope(at);
  return {exponent, chained(at.factor, slope.factor, exponent),
          chained(at.integral, slope.integral, exponent),
          chained(at.double_integral, slope.double_integral, exponent)};
}

template <class Dual>
Decay value_of(const BasicDecay<Dual>& decay) {
  return {decay.exponent.value(), decay.factor.value(), decay.integral.value(),
          decay.double_integral.value()};
}

template <class Dual>
BasicConvolution<Dual> dual_convolution(const BasicDecay<Dual>& x, const BasicDecay<Dual>& y) {
  const Decay at_x = value_of(x);
  const Decay at_y = value_of(y);
  const Convolution at = convolution(at_x, at_y);
  const ConvolutionSlope by_x = convolution_slope(at_x, at_y);
  const ConvolutionSlope by_y = convolution_slope(at_y, at_x);
  const auto joined = [&](double value, double slope_x, double slope_y) -> Dual {
    return {value, slope_x * x.exponent.derivatives() + slope_y * y.exponent.derivatives()};
  };
  return {joined(at.value, by_x.value, by_y.value),
          joined(at.integral, by_x.integral, by_y.integral),
          joined(at.double_integral, by_x.double_integral, by_y.double_integral)};
}

template <class Dual>
BasicFlightDecays<Dual> dual_decays(const BasicGapFlight<Dual>& flight, const Dual& time) {
  const BasicDecay<Dual> load = dual_decay<Dual>(flight.load_rate * time);
  const BasicDecay<Dual> motor = dual_decay<Dual>(flight.motor_rate * time);
  return {load, motor, dual_convolution(load, motor)};
}

template <class Dual>
Dual dual_log1p(const Dual& x) {
  return chained(std::log1p(x.value()), 1.0 / (1.0 + x.value()), x);
}

/// ∂t/∂s of t = artanh(√s q)/√s, s = ζ² − 1, where q = n/d: (q/(1 − s q²) − t)/(2s), which near
/// s = 0 is the series q³ Σ k z^{k−1}/(2k + 1), z = s q².
inline double zero_by_split(double split, double n, double d, double form, double time) {
  const double q = n / d;
  const double z = split * q * q;
  constexpr double near = 0.05;
  if (!(q > 0.0 && std::abs(z) < near)) return (n * d / form - time) / (2.0 * split);
  constexpr int terms = 14;
  double sum = 0.0;
  for (int k = terms; k > 0; --k) sum = sum * z + k / (2.0 * k + 1.0);
  return q * q * q * sum;
}

/// first_zero(), which is finite: tan(wt)/w = n/d with n = −x, d = ẋ + ζx. With
/// d² − (ζ² − 1)n² = Q(x, ẋ),  dt = (d dn − n dd)/Q + ∂t/∂s · 2ζ dζ.
template <class Dual>
Dual dual_first_zero(const Dual& damping, const Dual& value, const Dual& slope) {
  const double zeta = damping.value();
  const double time = first_zero(zeta, value.value(), slope.value());
  const Dual d = slope + damping * value;
  const double n = -value.value();
  const double form = decaying_form(zeta, value.value(), slope.value());
  const double by_split =
      zero_by_split((zeta - 1.0) * (zeta + 1.0), n, d.value(), form, time) * 2.0 * zeta;
  return {time, (-d.value() * value.derivatives() - n * d.derivatives()) / form +
                    by_split * damping.derivatives()};
}

/// The shafts of a servo of two masses, without backlash and restitution.
template <class Dual>
BasicServoDynamics<Dual> dual_dynamics(const NormalizedServo& servo) {
  using Gradient = typename Dual::DerType;
  const double ratio = servo.inertia_ratio;
  const double motor = 1.0 / (1.0 + ratio);
  const Gradient share_part = Gradient::Unit(by_load_share);
  return dynamics_of_shafts<Dual>(Dual(servo.damping, Gradient::Unit(by_damping)),
                                  Dual(motor, -share_part), Dual(ratio / (1.0 + ratio), share_part),
                                  Dual(servo.friction_ratio, Gradient::Unit(by_friction_ratio)));
}

}  // namespace gearlash
