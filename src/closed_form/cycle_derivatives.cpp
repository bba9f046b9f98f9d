#include "closed_form/cycle_derivatives.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "closed_form/bouncing_derivatives.hpp"
#include "closed_form/dual_numbers.hpp"
#include "closed_form/engaged_flow.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/half_cycle_algebra.hpp"
#include "closed_form/plastic_cycle.hpp"
#include "closed_form/refined_flight_time.hpp"

namespace gearlash {
namespace {

/// Derivatives by damping, inertia ratio and friction ratio. The backlash only scales the motion.
using Dual = BasicDual<servo_numbers>;
using Gradient = Dual::DerType;
using DualDynamics = BasicServoDynamics<Dual>;
using DualFlight = BasicGapFlight<Dual>;
using DualHalfCycle = BasicUnitHalfCycle<Dual>;

// ---- the half cycle -----------------------------------------------------------------------------

/// J_M y + F_M P without cancellation. It decays as the motor begins to creep:
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

/// The flight time of the balanced half cycle with its derivatives, by one step of Newton's method
/// in the derivatives.
Dual dual_flight_time(const DualDynamics& dynamics, const DualFlight& flight, double flight_time) {
  const Dual fixed = flight_time;
  const DualHalfCycle half = dual_half_cycle(dynamics, flight, fixed);
  return {flight_time, -half.log_growth.derivatives() / half.log_growth_slope.value()};
}

/// Below this ln μ₀ the flight time is refined: doubles give it only to a few epsilons over ln μ₀.
constexpr double ill_conditioned = 1.0;

// ---- the derivatives ----------------------------------------------------------------------------

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

/// The load's amplitude for a unit half cycle; see amplitudes_of() in plastic_cycle.cpp.
Dual dual_unit_amplitude(const DualDynamics& dynamics, const DualFlight& flight,
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

/// The derivative by the restitution, if there is one, follows those by the servo's own numbers.
template <int count>
SensitiveValue sensitive(const NormalizedServo& servo, double value,
                         const Eigen::Matrix<double, count, 1>& slope, double by_backlash = 0.0) {
  const double motor_share = 1.0 / (1.0 + servo.inertia_ratio);
  return {value,
          {.damping = slope(by_damping),
           .inertia_ratio = slope(by_load_share) * motor_share * motor_share,
           .load_share = slope(by_load_share),
           .friction_ratio = slope(by_friction_ratio),
           .backlash = by_backlash,
           .restitution = count > servo_numbers ? slope(count - 1) : 0.0}};
}

void add_slopes(CycleSensitivity& sensitivity, const NormalizedServo& servo, double flight_time) {
  const DualDynamics dynamics = dual_dynamics<Dual>(servo);
  const DualFlight flight = unit_flight_of_two_masses(dynamics);
  const Dual time = dual_flight_time(dynamics, flight, flight_time);
  const DualHalfCycle half = dual_half_cycle(dynamics, flight, time);
  const Dual gap = -half.gap_displacement;
  const Dual amplitude = servo.backlash * dual_unit_amplitude(dynamics, flight, half) / gap;
  const Dual period = 2.0 * (half.engaged_time + time);
  const Dual slope = half_map_slope(half);
  const Dual multiplier = slope * slope;
  const auto add = [&](SensitiveValue& of, const Dual& found, double by_backlash) {
    of = sensitive<servo_numbers>(servo, of.value, found.derivatives(), by_backlash);
  };
  add(sensitivity.amplitude, amplitude, sensitivity.amplitude.value / servo.backlash);
  add(sensitivity.period, period, 0.0);
  add(sensitivity.multiplier, multiplier, 0.0);
}

// ---- a massless side ----------------------------------------------------------------------------

bool has_massless_side(const NormalizedServo& servo) {
  return servo.inertia_ratio == 0.0 || std::isinf(servo.inertia_ratio);
}

constexpr std::size_t light_count = 6;
using LightSides = std::array<NormalizedServo, light_count>;

/// Servos whose light side has J/F = τ, 2τ, … 6τ.
LightSides light_sides(const NormalizedServo& servo, double growth) {
  constexpr double short_time = 1e-3;
  constexpr double least_ratio = 1e-9;  // of a sound servo
  const bool is_motor = std::isinf(servo.inertia_ratio);
  const double friction_share = is_motor ? 1.0 - servo.friction_ratio : servo.friction_ratio;
  const double closeness = growth > 1.0 ? std::min(1.0, std::log(growth)) : 1.0;
  const double friction = 2.0 * servo.damping;
  const double time = short_time * closeness / (1.0 + friction);
  const double least = std::max(friction * friction_share * time, least_ratio);
  LightSides light;
  light.fill(servo);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double ratio = least * static_cast<double>(i + 1);
    light[i].inertia_ratio = is_motor ? 1.0 / ratio : ratio;
    light[i].restitution = 0.0;
  }
  return light;
}

/// Lagrange's polynomial through the values of light sides, at 0.
constexpr std::array<double, light_count> weights_at_nought = {6.0, -15.0, 20.0, -15.0, 6.0, -1.0};

SensitiveValue limit_of(const NormalizedServo& servo, double value,
                        const std::array<ServoGradient, light_count>& slopes) {
  const auto limit = [&](double ServoGradient::*slope) {
    double sum = 0.0;
    for (std::size_t i = 0; i < light_count; ++i) sum += weights_at_nought[i] * (slopes[i].*slope);
    return sum;
  };
  return sensitive<servo_numbers>(
      servo, value,
      {limit(&ServoGradient::damping), limit(&ServoGradient::load_share),
       limit(&ServoGradient::friction_ratio)});
}

/// False if a light side does not hunt, or is too near the boundary of hunting.
bool add_limits_of_slopes(CycleSensitivity& sensitivity, const NormalizedServo& servo) {
  std::array<CycleSensitivity, light_count> light;
  const LightSides servos = light_sides(servo, sensitivity.growth_at_rest.value);
  std::transform(servos.begin(), servos.end(), light.begin(), cycle_sensitivity);
  if (!std::all_of(light.begin(), light.end(), [](const auto& one) { return one.available(); })) {
    return false;
  }
  const auto add = [&](SensitiveValue CycleSensitivity::*quantity) {
    std::array<ServoGradient, light_count> slopes;
    std::transform(light.begin(), light.end(), slopes.begin(),
                   [&](const CycleSensitivity& one) { return (one.*quantity).slope; });
    SensitiveValue& of = sensitivity.*quantity;
    of = limit_of(servo, of.value, slopes);
  };
  add(&CycleSensitivity::amplitude);
  add(&CycleSensitivity::period);
  add(&CycleSensitivity::multiplier);
  sensitivity.amplitude.slope.backlash = sensitivity.amplitude.value / servo.backlash;
  return true;
}

// ---- plastic contact, and bounces ---------------------------------------------------------------

CycleSensitivity plastic_sensitivity(const NormalizedServo& servo) {
  CycleSensitivity sensitivity;
  const auto ended = [&](SensitivityOutcome outcome) {
    sensitivity.outcome = outcome;
    return sensitivity;
  };
  sensitivity.growth_at_rest = growth_sensitivity(servo);
  const double growth = sensitivity.growth_at_rest.value;
  if (growth <= 1.0 || servo.backlash == 0.0) return ended(SensitivityOutcome::no_cycle);
  const ServoDynamics dynamics = servo_dynamics(servo);
  const auto balanced = balanced_half_cycle(dynamics, growth);
  if (!balanced) return ended(SensitivityOutcome::undecided);
  const LimitCycle cycle = plastic_cycle(dynamics, *balanced);
  if (!cycle.stable) return ended(SensitivityOutcome::undecided);
  CycleSensitivity with_cycle = sensitivity;
  with_cycle.amplitude.value = cycle.amplitude;
  with_cycle.period.value = cycle.period;
  with_cycle.multiplier.value = cycle.multiplier;
  if (has_massless_side(servo)) {
    if (!add_limits_of_slopes(with_cycle, servo)) return ended(SensitivityOutcome::undecided);
  } else {
    const bool is_ill_conditioned = std::log(growth) < ill_conditioned;
    add_slopes(with_cycle, servo,
               is_ill_conditioned ? refined_flight_time(servo, balanced->flight_time)
                                  : balanced->flight_time);
  }
  with_cycle.outcome = SensitivityOutcome::available;
  return with_cycle;
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
  sensitivity.amplitude =
      sensitive(servo, cycle->amplitude, slopes->amplitude, cycle->amplitude / servo.backlash);
  sensitivity.period = sensitive(servo, cycle->period, slopes->period);
  sensitivity.multiplier = sensitive(servo, cycle->multiplier, slopes->multiplier);
  return sensitivity;
}

}  // namespace

SensitiveValue growth_sensitivity(const NormalizedServo& servo) {
  require_none(faults(servo));
  if (servo.damping == 0.0) return {};
  const ServoDynamics dynamics = servo_dynamics(servo);
  const double growth = growth_at_rest(dynamics);
  if (!std::isfinite(growth)) return {growth, {}};
  if (dynamics.plastic_contact()) {
    if (growth == 0.0) return sensitive<servo_numbers>(servo, growth, Gradient::Zero());
    if (has_massless_side(servo)) {
      std::array<ServoGradient, light_count> slopes;
      const LightSides light = light_sides(servo, growth);
      std::transform(light.begin(), light.end(), slopes.begin(),
                     [](const NormalizedServo& one) { return growth_sensitivity(one).slope; });
      return limit_of(servo, growth, slopes);
    }
    const Gradient gradient = growth * log_growth_gradient(dual_dynamics<Dual>(servo));
    return sensitive<servo_numbers>(servo, growth, gradient);
  }
  const auto gradient = growth > 0.0 ? bouncing_log_growth_gradient(servo) : std::nullopt;
  if (!gradient) return {growth, {}};
  const BouncingGradient slope = growth * *gradient;
  return sensitive(servo, growth, slope);
}

CycleSensitivity cycle_sensitivity(const NormalizedServo& servo) {
  require_none(faults(servo));
  if (servo.damping == 0.0) {
    CycleSensitivity undamped;
    undamped.outcome = SensitivityOutcome::undamped;
    return undamped;
  }
  return servo_dynamics(servo).plastic_contact() ? plastic_sensitivity(servo)
                                                 : bouncing_sensitivity(servo);
}

}  // namespace gearlash
