#include "gearlash/cycle/cycle_sensitivity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bouncing_sensitivity.hpp"
#include "dual_numbers.hpp"
#include "gearlash/cycle/growth_at_rest.hpp"
#include "gearlash/cycle/half_cycle_algebra.hpp"
#include "gearlash/cycle/plastic_cycle.hpp"
#include "gearlash/motion/engaged_flow.hpp"
#include "refined_flight_time.hpp"

namespace gearlash {
namespace {

/// With derivatives by damping, inertia ratio and friction ratio: the backlash is but the scale of
/// the motion.
using Dual = BasicDual<servo_numbers>;
using Gradient = Dual::DerType;
using DualDynamics = BasicServoDynamics<Dual>;
using DualFlight = BasicGapFlight<Dual>;
using DualHalfCycle = BasicUnitHalfCycle<Dual>;

// ---- the half cycle -----------------------------------------------------------------------------

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
  half.log_growth = 0.5 * dual_log1p<Dual>(half.form_change / start_form(dynamics, flight)) -
                    dynamics.damping * half.engaged_time;
  return half;
}

/// Of the balanced half cycle: one step of Newton's method in the derivatives.
Dual dual_flight_time(const DualDynamics& dynamics, const DualFlight& flight, double flight_time) {
  const Dual fixed = flight_time;
  const DualHalfCycle half = dual_half_cycle(dynamics, flight, fixed);
  return {flight_time, -half.log_growth.derivatives() / half.log_growth_slope.value()};
}

/// Below this ln μ₀ the flight time is refined: doubles know it to some epsilons over ln μ₀.
constexpr double ill_conditioned = 1.0;

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

void add_cycle(CycleSensitivity& sensitivity, const DualDynamics& dynamics, double flight_time,
               const LimitCycle& cycle, double backlash) {
  const DualFlight flight = unit_flight_of_two_masses(dynamics);
  const Dual time = dual_flight_time(dynamics, flight, flight_time);
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

// ---- with bounces -------------------------------------------------------------------------------

SensitiveValue sensitive(double value, const BouncingGradient& slope, double by_backlash) {
  return {value,
          {.damping = slope(0),
           .inertia_ratio = slope(1),
           .friction_ratio = slope(2),
           .backlash = by_backlash,
           .restitution = slope(3)}};
}

CycleSensitivity bouncing_sensitivity(const NormalizedServo& servo) {
  CycleSensitivity sensitivity;
  sensitivity.growth_at_rest = growth_sensitivity(servo);
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle* cycle = largest_stable(analysis);
  if (cycle == nullptr) {
    sensitivity.outcome = analysis.verdict == Verdict::undecided ? SensitivityOutcome::undecided
                                                                 : SensitivityOutcome::no_cycle;
    return sensitivity;
  }
  const auto slopes = bouncing_slopes(servo, *cycle);
  if (!slopes) {
    sensitivity.outcome = SensitivityOutcome::bounces;
    return sensitivity;
  }
  sensitivity.outcome = SensitivityOutcome::available;
  sensitivity.size = sensitive(cycle->size, slopes->size, cycle->size / servo.backlash);
  sensitivity.period = sensitive(cycle->period, slopes->period, 0.0);
  sensitivity.multiplier = sensitive(cycle->multiplier, slopes->multiplier, 0.0);
  return sensitivity;
}

}  // namespace

SensitiveValue growth_sensitivity(const NormalizedServo& servo) {
  require_none(validate(servo));
  const ServoDynamics dynamics = servo_dynamics(servo);
  if (dynamics.massless_motor() || dynamics.massless_load() || servo.damping == 0.0) return {};
  const double growth = growth_at_rest(dynamics);
  if (!std::isfinite(growth)) return {growth, {}};
  if (servo.restitution == 0.0) {
    if (growth == 0.0) return sensitive(growth, Gradient::Zero());  // as are its neighbours
    return sensitive(growth, growth * log_growth_gradient(dual_dynamics<Dual>(servo)));
  }
  const auto gradient = growth > 0.0 ? bouncing_log_growth_gradient(servo) : std::nullopt;
  if (!gradient) return {growth, {}};
  return sensitive(growth, BouncingGradient(growth * *gradient), 0.0);
}

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
  if (servo.restitution > 0.0) return bouncing_sensitivity(servo);

  const DualDynamics dual = dual_dynamics<Dual>(servo);
  sensitivity.growth_at_rest = growth_sensitivity(servo);
  const double growth = sensitivity.growth_at_rest.value;
  if (growth <= 1.0 || servo.backlash == 0.0) return ended(SensitivityOutcome::no_cycle);
  const auto balanced = balanced_half_cycle(dynamics, growth);
  if (!balanced) return ended(SensitivityOutcome::undecided);
  const LimitCycle cycle = plastic_cycle(dynamics, *balanced);
  if (!cycle.stable) return ended(SensitivityOutcome::undecided);
  double flight_time = balanced->flight_time;
  if (std::log(growth) < ill_conditioned) flight_time = refined_flight_time(servo, flight_time);
  add_cycle(sensitivity, dual, flight_time, cycle, servo.backlash);
  return ended(SensitivityOutcome::available);
}

}  // namespace gearlash
