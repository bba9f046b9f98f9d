#include "closed_form/refined_flight_time.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "closed_form/engaged_flow.hpp"
#include "closed_form/half_cycle_algebra.hpp"

namespace gearlash {
namespace {

using Extended = boost::multiprecision::cpp_bin_float_quad;

// The quotients of decay_integral.hpp, without its series: of thirty-four digits enough remain
// after the cancellation in a small difference.

BasicDecay<Extended> extended_decay(const Extended& exponent) {
  if (exponent == 0) return {exponent, 1, 1, 0.5};
  const Extended integral = -expm1(-exponent) / exponent;
  return {exponent, exp(-exponent), integral, (1 - integral) / exponent};
}

/// Precondition: not both exponents are 0.
BasicConvolution<Extended> extended_convolution(const BasicDecay<Extended>& x,
                                                const BasicDecay<Extended>& y) {
  const auto& [slow, fast] = std::minmax(
      x, y, [](const auto& one, const auto& other) { return one.exponent < other.exponent; });
  const Extended value = slow.factor * extended_decay(fast.exponent - slow.exponent).integral;
  const Extended integral = (slow.integral - value) / fast.exponent;
  return {value, integral, (slow.double_integral - integral) / fast.exponent};
}

BasicUnitHalfCycle<Extended> half_cycle(const BasicServoDynamics<Extended>& dynamics,
                                        const BasicGapFlight<Extended>& flight,
                                        const Extended& time) {
  const BasicDecay<Extended> load = extended_decay(flight.load_rate * time);
  const BasicDecay<Extended> motor = extended_decay(flight.motor_rate * time);
  const BasicFlightDecays<Extended> decays = {load, motor, extended_convolution(load, motor)};
  BasicUnitHalfCycle<Extended> half =
      impact_at(dynamics, flight, time,
                {motion_after(flight, time, decays), displacement_after(flight, time, decays)});
  half.engaged_time =
      first_zero(dynamics.damping, mesh_torque(dynamics, half.load_position, half.common_speed),
                 mesh_torque_rate(dynamics, half.load_position, half.common_speed));
  half.log_growth =
      log(half.form / start_form(dynamics, flight)) / 2 - dynamics.damping * half.engaged_time;
  return half;
}

}  // namespace

double refined_flight_time(const NormalizedServo& servo, double approximate) {
  const Extended ratio = servo.inertia_ratio;
  const BasicServoDynamics<Extended> dynamics = dynamics_of_shafts<Extended>(
      servo.damping, 1 / (1 + ratio), ratio / (1 + ratio), servo.friction_ratio);
  const BasicGapFlight<Extended> flight = unit_flight_of_two_masses(dynamics);
  constexpr double near = 1e-10;  // the square of such a step is below a double's rounding
  constexpr int step_limit = 10;
  Extended time = approximate;
  for (int i = 0; i < step_limit; ++i) {
    const BasicUnitHalfCycle<Extended> half = half_cycle(dynamics, flight, time);
    const Extended step = -half.log_growth / half.log_growth_slope;
    time += step;
    if (abs(step) <= near * time) break;
  }
  return static_cast<double>(time);
}

}  // namespace gearlash
