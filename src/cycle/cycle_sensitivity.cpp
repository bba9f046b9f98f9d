#include "gearlash/cycle/cycle_sensitivity.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "gearlash/cycle/growth_at_rest.hpp"
#include "gearlash/cycle/half_cycle_algebra.hpp"
#include "gearlash/cycle/plastic_cycle.hpp"
#include "gearlash/motion/decay_slopes.hpp"
#include "gearlash/motion/engaged_flow.hpp"

namespace gearlash {
namespace {

/// A number with its derivatives by damping, inertia ratio and friction ratio. The backlash is but
/// the scale of the motion.
using Gradient = Eigen::Vector3d;
using Dual = Eigen::AutoDiffScalar<Gradient>;
using DualDynamics = BasicServoDynamics<Dual>;
using DualFlight = BasicGapFlight<Dual>;
using DualHalfCycle = BasicUnitHalfCycle<Dual>;

Dual chained(double value, double slope, const Dual& of) {
  return {value, slope * of.derivatives()};
}

// ---- the functions that are not algebra ---------------------------------------------------------

BasicDecay<Dual> dual_decay(const Dual& exponent) {
  const Decay at = decay(exponent.value());
  const DecaySlope slope = decay_slope(at);
  return {exponent, chained(at.factor, slope.factor, exponent),
          chained(at.integral, slope.integral, exponent),
          chained(at.double_integral, slope.double_integral, exponent)};
}

Decay value_of(const BasicDecay<Dual>& decay) {
  return {decay.exponent.value(), decay.factor.value(), decay.integral.value(),
          decay.double_integral.value()};
}

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

BasicFlightDecays<Dual> dual_decays(const DualFlight& flight, const Dual& time) {
  const BasicDecay<Dual> load = dual_decay(flight.load_rate * time);
  const BasicDecay<Dual> motor = dual_decay(flight.motor_rate * time);
  return {load, motor, dual_convolution(load, motor)};
}

Dual dual_log1p(const Dual& x) {
  return chained(std::log1p(x.value()), 1.0 / (1.0 + x.value()), x);
}

/// ∂t/∂s of t = artanh(√s q)/√s, s = ζ² − 1, where q = n/d: (q/(1 − s q²) − t)/(2s), which near
/// s = 0 is the series q³ Σ k z^{k−1}/(2k + 1), z = s q².
double zero_by_split(double split, double n, double d, double form, double time) {
  const double q = n / d;
  const double z = split * q * q;
  constexpr double near = 0.05;
  if (!(q > 0.0 && std::abs(z) < near)) return (n * d / form - time) / (2.0 * split);
  constexpr int terms = 14;
  double sum = 0.0;
  for (int k = terms; k > 0; --k) sum = sum * z + k / (2.0 * k + 1.0);
  return q * q * q * sum;
}

/// first_zero(), which is finite: tan(wt)/w = n/d with n = −x, d = ẋ + ζx, hence, with
/// d² − (ζ² − 1)n² = Q(x, ẋ),  dt = (d dn − n dd)/Q + ∂t/∂s · 2ζ dζ.
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

// ---- the half cycle -----------------------------------------------------------------------------

DualDynamics dual_dynamics(const NormalizedServo& servo) {
  const double ratio = servo.inertia_ratio;
  const double motor = 1.0 / (1.0 + ratio);
  const Gradient by_ratio = motor * motor * Gradient::UnitY();
  return dynamics_of_shafts<Dual>(Dual(servo.damping, 3, 0), Dual(motor, -by_ratio),
                                  Dual(ratio / (1.0 + ratio), by_ratio),
                                  Dual(servo.friction_ratio, 3, 2));
}

DualFlight dual_flight(const DualDynamics& dynamics) {
  const Dual gap = 0.0;
  return clean_parting<Dual>(dynamics, dynamics.torque_free_line.position,
                             dynamics.torque_free_line.speed, gap);
}

/// J_M y + F_M P, which dies away as the motor comes to creep, without cancellation:
///   q = y + cP,  q e^{ct} = q₀ + (1 + c J_L(c − D)) v₀ t φ₁((c − D)t),  q₀ = (D J_M + c J_L) v₀.
Dual drive_at_impact(const DualDynamics& dynamics, const DualFlight& flight, const Dual& time,
                     const BasicFlightDecays<Dual>& decays) {
  const Dual& c = dynamics.motor_rate;
  const Dual& d = dynamics.load_rate;
  const Dual start = d * dynamics.motor_inertia + c * dynamics.load_inertia;
  const Dual growing = 1.0 + c * dynamics.load_inertia * (c - d);
  return dynamics.motor_inertia * flight.load_speed *
         (start * decays.motor.factor + growing * time * decays.coupled.value);
}

DualHalfCycle dual_half_cycle(const DualDynamics& dynamics, const DualFlight& flight,
                              const Dual& time) {
  const BasicFlightDecays<Dual> decays = dual_decays(flight, time);
  const BasicFlightPoint<Dual> point = {motion_after(flight, time, decays),
                                        displacement_after(flight, time, decays)};
  DualHalfCycle half = impact_at(dynamics, flight, time, point);
  half.log_growth_slope =
      -half.gap_speed * drive_at_impact(dynamics, flight, time, decays) / half.form;
  half.engaged_time = dual_first_zero(
      dynamics.damping, mesh_torque(dynamics, half.load_position, half.common_speed),
      mesh_torque_rate(dynamics, half.load_position, half.common_speed));
  half.log_growth = 0.5 * dual_log1p(half.form_change / start_form(dynamics, flight)) -
                    dynamics.damping * half.engaged_time;
  return half;
}

/// Of the balanced half cycle: one step of Newton's method in the derivatives.
Dual dual_flight_time(const DualDynamics& dynamics, const DualFlight& flight, double flight_time) {
  const Dual fixed = flight_time;
  const DualHalfCycle half = dual_half_cycle(dynamics, flight, fixed);
  return {flight_time, -half.log_growth.derivatives() / half.log_growth_slope.value()};
}

// ---- what is asked ------------------------------------------------------------------------------

/// d ln μ₀ = ½ d ln g(c) + ½ d ln g(D) − d ln cD − d(ζt₁), g(x) = x² − 2ζx + 1.
Gradient log_growth_gradient(const DualDynamics& dynamics) {
  const Dual& zeta = dynamics.damping;
  const auto quadratic = [&](const Dual& rate) -> Dual {
    const Dual offset = rate - zeta;
    return offset * offset + (1.0 - zeta) * (1.0 + zeta);
  };
  const auto log_gradient = [](const Dual& x) -> Gradient { return x.derivatives() / x.value(); };
  const Dual position = -1.0;
  const Dual contact_speed = dynamics.motor_inertia / dynamics.motor_friction;
  const Dual time = dual_first_zero(zeta, mesh_torque(dynamics, position, contact_speed),
                                    mesh_torque_rate(dynamics, position, contact_speed));
  const Dual& c = dynamics.motor_rate;
  const Dual& d = dynamics.load_rate;
  const Dual exponent = zeta * time;
  return 0.5 * (log_gradient(quadratic(c)) + log_gradient(quadratic(d))) - log_gradient(c) -
         log_gradient(d) - exponent.derivatives();
}

/// Of the load, for a unit amplitude: see sizes() of plastic_cycle.cpp.
Dual dual_unit_size(const DualDynamics& dynamics, const DualFlight& flight,
                    const DualHalfCycle& half) {
  using std::abs;
  Dual turning = half.load_position;
  const Dual& zeta = dynamics.damping;
  const Dual slope = -2.0 * zeta * half.common_speed - half.load_position;
  if (first_zero(zeta.value(), half.common_speed.value(), slope.value()) <
      half.engaged_time.value()) {
    const Dual time = dual_first_zero(zeta, half.common_speed, slope);
    turning = sqrt(half.form) * exp(-zeta * time);
  }
  Dual largest = abs(flight.load_position);
  for (const Dual& extreme : {half.load_position, turning}) {
    const Dual here = abs(extreme);
    if (here.value() > largest.value()) largest = here;
  }
  return largest;
}

SensitiveValue sensitive(double value, const Gradient& slope, double by_backlash = 0.0) {
  return {value,
          {.damping = slope(0),
           .inertia_ratio = slope(1),
           .friction_ratio = slope(2),
           .backlash = by_backlash,
           .restitution = 0.0}};
}

SensitiveValue sensitive_growth(const DualDynamics& dynamics, double growth) {
  if (std::isinf(growth)) return {growth, {}};
  if (growth == 0.0) return sensitive(growth, Gradient::Zero());  // as are its neighbours
  return sensitive(growth, growth * log_growth_gradient(dynamics));
}

void add_cycle(CycleSensitivity& sensitivity, const DualDynamics& dynamics,
               const UnitHalfCycle& balanced, const LimitCycle& cycle, double backlash) {
  const DualFlight flight = dual_flight(dynamics);
  const Dual time = dual_flight_time(dynamics, flight, balanced.flight_time);
  const DualHalfCycle half = dual_half_cycle(dynamics, flight, time);
  const Dual gap = -half.gap_displacement;
  const Dual size = backlash * dual_unit_size(dynamics, flight, half) / gap;
  const Dual period = 2.0 * (half.engaged_time + time);
  const Dual slope = half_map_slope(half);
  const Dual multiplier = slope * slope;
  sensitivity.size = sensitive(cycle.size, size.derivatives(), cycle.size / backlash);
  sensitivity.period = sensitive(cycle.period, period.derivatives());
  sensitivity.multiplier = sensitive(cycle.multiplier, multiplier.derivatives());
}

}  // namespace

CycleSensitivity cycle_sensitivity(const NormalizedServo& servo) {
  require_none(validate(servo));
  const ServoDynamics dynamics = servo_dynamics(servo);
  CycleSensitivity sensitivity;
  const auto ended = [&](SensitivityOutcome outcome) {
    sensitivity.outcome = outcome;
    return sensitivity;
  };
  if (dynamics.massless_motor() || dynamics.massless_load()) {
    return ended(SensitivityOutcome::massless);
  }
  if (servo.damping == 0.0) return ended(SensitivityOutcome::undamped);
  if (servo.restitution > 0.0) return ended(SensitivityOutcome::bounces);

  const DualDynamics dual = dual_dynamics(servo);
  const double growth = growth_at_rest(dynamics);
  sensitivity.growth_at_rest = sensitive_growth(dual, growth);
  if (growth <= 1.0 || servo.backlash == 0.0) return ended(SensitivityOutcome::no_cycle);
  const auto balanced = balanced_half_cycle(dynamics, growth);
  if (!balanced) return ended(SensitivityOutcome::undecided);
  const LimitCycle cycle = plastic_cycle(dynamics, *balanced);
  if (!cycle.stable) return ended(SensitivityOutcome::undecided);
  add_cycle(sensitivity, dual, *balanced, cycle, servo.backlash);
  return ended(SensitivityOutcome::available);
}

}  // namespace gearlash
