// The limit cycles of several servos, lane by lane with the algebra of half_cycle_algebra.
//
// One file for each vector unit includes this header and is compiled with that unit's instructions.
// A processor that lacks them must not call such code. So everything here is a template of the
// unit, and nothing calls an inline function on plain doubles that others share.
#pragma once

#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>

#include "closed_form/half_cycle_algebra.hpp"
#include "closed_form/lanes/cycle_kernel.hpp"
#include "closed_form/lanes/lanes.hpp"
#include "closed_form/lanes/twin_lanes.hpp"

namespace gearlash::detail {

template <class Unit>
bool none(const Mask<Unit>& mask) {
  return !any(mask);
}

/// A lane that is finished or hopeless keeps its value.
template <class Unit>
void assign_where(const Mask<Unit>& mask, Lanes<Unit>& to, const Lanes<Unit>& from) {
  to = select(mask, from, to);
}

/// exp[0, 0, −x] for x < 1, see decay_integral.hpp: even and odd terms apart.
template <class Unit>
Lanes<Unit> single_rate_series_lanes(const Lanes<Unit>& x) {
  constexpr std::size_t terms = 18;
  const Lanes<Unit> square = x * x;
  Lanes<Unit> even = inverse_factorials[terms];
  Lanes<Unit> odd = inverse_factorials[terms + 1];
  for (std::size_t k = terms - 2; k > 0; k -= 2) {
    even = inverse_factorials[k] + square * even;
    odd = inverse_factorials[k + 1] + square * odd;
  }
  return even - x * odd;
}

/// exp[0, 0, −x, −y] for x ≤ y < 1: two interleaved sums, h_{k+2} = y² h_k + x^{k+1} (x + y).
template <class Unit>
Lanes<Unit> two_rate_series_lanes(const Lanes<Unit>& x, const Lanes<Unit>& y) {
  constexpr std::size_t terms = 18;
  const Lanes<Unit> x2 = x * x;
  const Lanes<Unit> y2 = y * y;
  Lanes<Unit> even = 1.0;
  Lanes<Unit> odd = x + y;
  Lanes<Unit> even_step = x * odd;
  Lanes<Unit> odd_step = x2 * odd;
  Lanes<Unit> even_sum = 0.0;
  Lanes<Unit> odd_sum = 0.0;
  for (std::size_t k = 0; k < terms; k += 2) {
    even_sum = even_sum + even * inverse_factorials[k + 3];
    odd_sum = odd_sum + odd * inverse_factorials[k + 4];
    even = even_step + y2 * even;
    odd = odd_step + y2 * odd;
    even_step = even_step * x2;
    odd_step = odd_step * x2;
  }
  return even_sum - odd_sum;
}

template <class Unit>
BasicDecay<Lanes<Unit>> decay_lanes(const Lanes<Unit>& exponent) {
  using Real = Lanes<Unit>;
  const Mask<Unit> small = exponent < Real(series_limit);
  BasicDecay<Real> result{exponent, 0.0, 0.0, 0.0};
  if (any(small)) {
    result.double_integral = single_rate_series_lanes<Unit>(exponent);
    result.integral = 1.0 - exponent * result.double_integral;
    result.factor = 1.0 - exponent * result.integral;
  }
  if (!all(small)) {
    const Real inverse = 1.0 / exponent;
    const Real factor = exp(-exponent);
    const Real integral = (1.0 - factor) * inverse;
    assign_where<Unit>(!small, result.factor, factor);
    assign_where<Unit>(!small, result.integral, integral);
    assign_where<Unit>(!small, result.double_integral, (1.0 - integral) * inverse);
  }
  return result;
}

template <class Unit>
BasicConvolution<Lanes<Unit>> convolution_lanes(const BasicDecay<Lanes<Unit>>& x,
                                                const BasicDecay<Lanes<Unit>>& y) {
  using Real = Lanes<Unit>;
  const Mask<Unit> in_order = x.exponent <= y.exponent;
  const auto slow = [&](Real BasicDecay<Real>::*part) {
    return select(in_order, x.*part, y.*part);
  };
  const auto fast = [&](Real BasicDecay<Real>::*part) {
    return select(in_order, y.*part, x.*part);
  };
  const Real slow_exponent = slow(&BasicDecay<Real>::exponent);
  const Real slow_factor = slow(&BasicDecay<Real>::factor);
  const Real slow_integral = slow(&BasicDecay<Real>::integral);
  const Real slow_double_integral = slow(&BasicDecay<Real>::double_integral);
  const Real fast_exponent = fast(&BasicDecay<Real>::exponent);
  const Mask<Unit> small = fast_exponent < Real(series_limit);
  BasicConvolution<Real> result{0.0, 0.0, 0.0};
  if (any(small)) {
    result.double_integral = two_rate_series_lanes<Unit>(slow_exponent, fast_exponent);
    result.integral = slow_double_integral - fast_exponent * result.double_integral;
    result.value = slow_integral - fast_exponent * result.integral;
  }
  if (!all(small)) {
    const Real difference = fast_exponent - slow_exponent;
    const Mask<Unit> apart = difference > Real(0.5);
    const Real inverse = 1.0 / fast_exponent;
    Real value = (slow_factor - fast(&BasicDecay<Real>::factor)) / difference;
    if (!all(apart)) {
      const Real integral = 1.0 - difference * single_rate_series_lanes<Unit>(difference);
      assign_where<Unit>(!apart, value, slow_factor * integral);
    }
    const Real integral = (slow_integral - value) * inverse;
    assign_where<Unit>(!small, result.value, value);
    assign_where<Unit>(!small, result.integral, integral);
    assign_where<Unit>(!small, result.double_integral, (slow_double_integral - integral) * inverse);
  }
  return result;
}

/// Σ_k (−1)^k x^{2k}/(2k + parity)!: cos x, and sin x/x, by Taylor's series for |x| ≤ π/2. (xsimd's
/// own sine calls, for large arguments, an inline function of doubles.)
template <class Unit, std::size_t parity>
Lanes<Unit> alternating_series_lanes(const Lanes<Unit>& square) {
  constexpr std::size_t last = 24 + parity;
  Lanes<Unit> sum = inverse_factorials[last];
  for (std::size_t k = last; k >= 2; k -= 2) sum = inverse_factorials[k - 2] - square * sum;
  return sum;
}

template <class Unit>
class CycleLanes {
 public:
  using Real = Lanes<Unit>;

  static void solve(CycleBlock& block, std::size_t row) {
    CycleLanes lanes(block, row);
    lanes.find_growth_at_rest();
    lanes.balance();
    lanes.write_properties(block, row);
  }

 private:
  using HalfCycle = BasicUnitHalfCycle<Real>;
  using FlightPointLanes = BasicFlightPoint<Real>;

  CycleLanes(const CycleBlock& block, std::size_t row) {
    const Real inertia_ratio = Real::load_aligned(block.inertia_ratio + row);
    const Real friction_ratio = Real::load_aligned(block.friction_ratio + row);
    const Real damping = Real::load_aligned(block.damping + row);
    const Real backlash = Real::load_aligned(block.backlash + row);
    // The range in which nothing below over- or underflows; cycle_batch.hpp names the first three.
    permitted_ = is_within(damping, 1e-4, 0.99) && is_within(inertia_ratio, 1e-4, 1e4) &&
                 is_within(friction_ratio, 1e-4, 1.0 - 1e-4) && is_within(backlash, 1e-15, 1e6);
    servo_ = dynamics_of_shafts<Real>(damping, 1.0 / (1.0 + inertia_ratio),
                                      inertia_ratio / (1.0 + inertia_ratio), friction_ratio);
    servo_.backlash = backlash;
    frequency_ = sqrt((1.0 - servo_.damping) * (1.0 + servo_.damping));
    flight_ = clean_parting<Real>(servo_, servo_.torque_free_line.position,
                                  servo_.torque_free_line.speed, 0.0);
  }

  static Mask<Unit> is_within(const Real& value, double low, double high) {
    return value >= Real(low) && value <= Real(high);
  }

  /// first_zero() of engaged_flow.hpp below critical damping; 0 where the value is.
  Real first_zero_after(const Real& value, const Real& slope) const {
    const Real cosine_part = copysign(Real(1.0), value) * -(slope + servo_.damping * value);
    return atan2(abs(value) * frequency_, cosine_part) / frequency_;
  }

  Real parting_time(const Real& position, const Real& speed) const {
    return first_zero_after(mesh_torque(servo_, position, speed),
                            mesh_torque_rate(servo_, position, speed));
  }

  FlightPointLanes point_at(const Real& time) const {
    const BasicDecay<Real> load = decay_lanes<Unit>(flight_.load_rate * time);
    const BasicDecay<Real> motor = decay_lanes<Unit>(flight_.motor_rate * time);
    const BasicFlightDecays<Real> decays{load, motor, convolution_lanes<Unit>(load, motor)};
    return {motion_after(flight_, time, decays), displacement_after(flight_, time, decays)};
  }

  void find_growth_at_rest() {
    const Real position = -1.0;
    const Real contact_speed = 1.0 / servo_.motor_rate;
    const Real engaged_time = parting_time(position, contact_speed);
    growth_ = growth_after_contact(servo_, contact_speed, engaged_time);
    permitted_ = permitted_ && abs(growth_ - 1.0) > Real(1e-9);
    sought_ = permitted_ && growth_ > Real(1.0);
  }

  HalfCycle half_cycle(const Real& time) const {
    HalfCycle half = impact_at(servo_, flight_, time, point_at(time));
    half.engaged_time = parting_time(half.load_position, half.common_speed);
    half.log_growth = 0.5 * log1p(half.form_change / start_form(servo_, flight_)) -
                      servo_.damping * half.engaged_time;
    return half;
  }

  /// The root of ln ρ = 0, which rises. A lane that has found it keeps its time, and so its bits,
  /// while others continue.
  void balance() {
    constexpr int most_steps = 6;
    found_ = sought_ && !sought_;
    if (none<Unit>(sought_)) return;
    const Real growth = select(sought_, growth_, Real(2.0));
    const Real fastest_rate = max(Real(1.0), max(flight_.load_rate, flight_.motor_rate));
    Real time = guessed_flight_time<Real>(servo_, log(growth));
    HalfCycle half;
    BasicArrivalRates<Real> rates;
    Real step;
    Mask<Unit> searching = sought_;
    for (int count = 0;; ++count) {
      half = half_cycle(time);
      rates = arrival_rates(servo_, flight_, half);
      const auto at_time = growth_at(half, rates);
      step = newton_step(at_time);
      const Real fastest = max(fastest_rate, 1.0 / time);
      const Mask<Unit> arrived = searching && is_near_zero<Real>(at_time, short_step / fastest);
      found_ = found_ || arrived;
      searching = searching && !arrived && abs(step) < 0.5 * time;
      if (none<Unit>(searching) || count + 1 == most_steps) break;
      assign_where<Unit>(searching, time, time + step);
    }
    half_ = stepped(servo_, flight_, half, rates, gap_jerk_of_two_masses(flight_, half), step);
  }

  /// As motor_turning_position() of plastic_cycle.cpp; `certain` loses the lanes whose turn is not
  /// found.
  Real motor_turning_position(Mask<Unit>& certain) const {
    constexpr int most_steps = 4;
    const Real motor_drive = 1.0 / servo_.motor_inertia;
    const auto speed_at = [&](const Real& load_speed, const Real& gap_speed,
                              const Real& gap_acceleration) {
      return motor_speed_at(flight_, motor_drive, load_speed, gap_speed, gap_acceleration);
    };
    const auto at_start = speed_at(flight_.load_speed, 0.0, 0.0);
    const auto at_end = speed_at(half_.load_speed, half_.gap_speed, half_.gap_acceleration);
    const Mask<Unit> turns = found_ && at_end.speed.value < Real(0.0);
    const Real not_found = std::numeric_limits<double>::quiet_NaN();
    Real turning = select(turns, not_found, flight_.load_position);
    if (none<Unit>(turns)) return turning;
    const Real end = half_.flight_time;
    const Real tolerance = end * nearness_of_turn(flight_, end);
    Real near = quintic_root(at_start.speed, at_end.speed, end);
    const Mask<Unit> inside = near > Real(0.0) && near < end;
    near = select(inside, near, 0.5 * end);
    Mask<Unit> searching = turns;
    for (int count = 0; count < most_steps; ++count) {
      const FlightPointLanes point = point_at(near);
      const auto here =
          speed_at(point.motion.load_speed, point.motion.gap_speed, point.motion.gap_acceleration);
      const Real step = newton_step(here.speed);
      const Mask<Unit> arrived =
          searching && here.speed.slope < Real(0.0) && is_near_zero(here.speed, tolerance);
      assign_where<Unit>(arrived, turning, position_at_turn(point, here));
      searching = searching && !arrived && near + step > Real(0.0) && near + step < end;
      if (none<Unit>(searching)) break;
      assign_where<Unit>(searching, near, near + step);
    }
    certain = certain && !isnan(turning);
    return turning;
  }

  /// F_M ∫ v_M² dt over the flight.
  Real motor_friction_in_flight() const {
    const Real slight = 0.1;
    const Real time = half_.flight_time;
    const Real load_decay = flight_.load_rate * time;
    const Mask<Unit> coasting_motor = flight_.motor_rate * time <= slight;
    const Mask<Unit> coasting_load = load_decay <= slight;
    const MotorFrictionBalance<Real> balance(servo_, flight_, half_);
    Real loss = balance.of_braked_load(flight_);
    if (any(coasting_load)) {
      const BasicDecay<Real> once = decay_lanes<Unit>(load_decay);
      const BasicDecay<Real> twice = decay_lanes<Unit>(2.0 * load_decay);
      assign_where<Unit>(coasting_load, loss,
                         balance.of_coasting_load(servo_, flight_, time, once,
                                                  convolution_lanes<Unit>(once, twice)));
    }
    if (!any(found_ && coasting_motor)) return loss;
    const Mask<Unit> long_decay = coasting_motor && load_decay > Real(2.0);
    if (any(found_ && coasting_motor && !long_decay)) {
      assign_where<Unit>(coasting_motor, loss, friction_of_coasting_motor());
    }
    if (any(found_ && long_decay)) {
      assign_where<Unit>(long_decay, loss, friction_of_coasting_motor_and_braked_load(load_decay));
    }
    return loss;
  }

  /// F_M ∫ v_M² dt of a flight in which the motor almost coasts and the load almost comes to rest:
  ///   v_M = P + B e^{−Dt},  B = −v₀/(J_M D (D − c)),  Ṗ = −c P − q,  q = y∞/J_M.
  /// P is nearly straight: about the flight's middle, h from either end, with ε = c h,
  ///   P = P_m + h Ṗ_m (1 − e^{−εx})/ε,  −1 ≤ x ≤ 1,
  /// whose mean and mean square are series in ε; and by parts
  ///   (D + c) ∫ P e^{−Dt} = P(0) − P(T) e^{−DT} − (q/D)(1 − e^{−DT}).
  Real friction_of_coasting_motor_and_braked_load(const Real& load_decay) const {
    const Real time = half_.flight_time;
    const Real middle = 0.5 * time;
    const Real drive =
        (flight_.load_position + flight_.load_speed / flight_.load_rate) / servo_.motor_inertia;
    const Real fading = -flight_.load_speed / (servo_.motor_inertia * flight_.load_rate *
                                               (flight_.load_rate - flight_.motor_rate));
    const BasicDecay<Real> motor = decay_lanes<Unit>(flight_.motor_rate * middle);
    const Real step = drive * middle * motor.integral;
    const Real at_start = flight_.load_speed - fading;
    const Real at_middle = at_start * motor.factor - step;
    const Real at_end = at_middle * motor.factor - step;
    const Real rise = -middle * (flight_.motor_rate * at_middle + drive);
    const Real square = motor.exponent * motor.exponent;
    const Real mean =
        -motor.exponent *
        (inverse_factorials[3] +
         square * (inverse_factorials[5] +
                   square * (inverse_factorials[7] + square * inverse_factorials[9])));
    const Real mean_square =
        2.0 * inverse_factorials[3] +
        square * (14.0 * inverse_factorials[5] +
                  square * (62.0 * inverse_factorials[7] + square * 254.0 * inverse_factorials[9]));
    const Real straight =
        time * (at_middle * (at_middle + 2.0 * rise * mean) + rise * rise * mean_square);
    const Real left = exp(-load_decay);
    const Real mixed = (at_start - at_end * left - drive / flight_.load_rate * (1.0 - left)) /
                       (flight_.load_rate + flight_.motor_rate);
    const Real faded = fading * (1.0 - left * left) / (2.0 * flight_.load_rate);
    return servo_.motor_friction * (straight + fading * (2.0 * mixed + faded));
  }

  /// F_M ∫ v_M² dt of a flight no longer than two time constants of either shaft: Taylor's series
  /// of v_M about the flight's middle (v̈ = −c v̇ − a, ȧ = −D a), squared and integrated by ten Gauss
  /// points, which miss less than rounding.
  Real friction_of_coasting_motor() const {
    constexpr int terms = 20;
    const Real middle = 0.5 * half_.flight_time;
    const FlightPointLanes point = point_at(middle);
    const BasicFlightMotion<Real>& motion = point.motion;
    const Real motor_decay = flight_.motor_rate * middle;
    const Real load_decay = flight_.load_rate * middle;
    Real coefficients[terms];
    coefficients[0] = motion.load_speed + motion.gap_speed;
    coefficients[1] = middle * (motion.gap_acceleration - flight_.load_rate * motion.load_speed);
    Real drive = middle * middle * motion.load_speed / servo_.motor_inertia;
    for (int k = 0; k + 2 < terms; ++k) {
      const double next = k + 1.0;
      coefficients[k + 2] =
          -(motor_decay * coefficients[k + 1] * next + drive) * (1.0 / (next * (next + 1.0)));
      drive = -drive * load_decay * (1.0 / next);
    }
    // Gauss and Legendre's points and weights, n = 10 (Abramowitz & Stegun, table 25.4).
    constexpr double points[] = {0.148874338981631211, 0.433395394129247191, 0.679409568299024406,
                                 0.865063366688984511, 0.973906528517171720};
    constexpr double weights[] = {0.295524224714752870, 0.269266719309996355, 0.219086362515982044,
                                  0.149451349150580593, 0.066671344308688138};
    Real sum = 0.0;
    for (int node = 0; node < 5; ++node) {
      const double square = points[node] * points[node];
      Real even = coefficients[terms - 2];
      Real odd = coefficients[terms - 1];
      for (int k = terms - 4; k >= 0; k -= 2) {
        even = coefficients[k] + square * even;
        odd = coefficients[k + 1] + square * odd;
      }
      sum = sum + weights[node] * (even * even + square * odd * odd);
    }
    return servo_.motor_friction * half_.flight_time * sum;
  }

  /// As closing_error() of plastic_cycle.cpp, with the decay over the engaged motion; `certain`
  /// loses the lanes that do not close.
  Real closing_error(const Real& decay, Mask<Unit>& certain) const {
    const Real acceptable = 1e-12;
    // The angle is in (0, π]: sine and cosine of its excess over π/2.
    const Real excess = frequency_ * half_.engaged_time - 0.5 * std::numbers::pi;
    const Real square = excess * excess;
    const Real impulse = decay * alternating_series_lanes<Unit, 0>(square) / frequency_;
    const Real even = -decay * excess * alternating_series_lanes<Unit, 1>(square);
    const Real position =
        half_.load_position * (even + servo_.damping * impulse) + half_.common_speed * impulse;
    const Real speed =
        half_.common_speed * (even - servo_.damping * impulse) - half_.load_position * impulse;
    const Real scale = max(abs(flight_.load_position), abs(flight_.load_speed));
    const Real position_error = abs(position + flight_.load_position) / scale;
    const Real speed_error = abs(speed + flight_.load_speed) / scale;
    // Compared one by one, because xsimd's max of a NaN and a number is the number.
    certain = certain && position_error <= acceptable && speed_error <= acceptable;
    return max(position_error, speed_error);
  }

  /// As largest_mesh_torque() of contact_law.hpp, for a unit amplitude. At the turn N² is the form
  /// Q(N, Ṅ), written as a sum of squares, that the engaged flow multiplies by e^{−2ζt}.
  Real largest_mesh_torque() const {
    const Real at_impact = mesh_torque(servo_, half_.load_position, half_.common_speed);
    const Real rate = mesh_torque_rate(servo_, half_.load_position, half_.common_speed);
    const Real rising = rate + servo_.damping * at_impact;
    const Real swing = frequency_ * at_impact;
    const Real turn = first_zero_after(rate, -2.0 * servo_.damping * rate - at_impact);
    const Real turned = sqrt(rising * rising + swing * swing) * exp(-servo_.damping * turn);
    return max(abs(at_impact), select(turn < half_.engaged_time, turned, abs(at_impact)));
  }

  void write_properties(CycleBlock& block, std::size_t row) const {
    growth_.store_aligned(block.growth_at_rest + row);
    const Real failed =
        select(permitted_ && !sought_, Real(CycleBlock::cannot_hunt), Real(CycleBlock::uncertain));
    if (none<Unit>(found_)) {
      failed.store_aligned(block.outcome + row);
      const Real nothing = std::numeric_limits<double>::quiet_NaN();
      for (CycleBlock::Column& column : block.properties) nothing.store_aligned(column + row);
      return;
    }
    Mask<Unit> certain = found_;
    const Real gap = -half_.gap_displacement;
    const Real amplitude = servo_.backlash / gap;
    const Real square = amplitude * amplitude;
    const Real half_gap = 0.5 * gap;
    const Real start = flight_.load_position;

    const Real turning_time = first_zero_after(
        half_.common_speed, -2.0 * servo_.damping * half_.common_speed - half_.load_position);
    const Real turned =
        copysign(sqrt(half_.form) * exp(-servo_.damping * turning_time), half_.common_speed);
    const Real turning = select(turning_time < half_.engaged_time, turned, half_.load_position);
    const Real motor_turning = motor_turning_position(certain);
    const Real unit_amplitude = max(abs(start), max(abs(half_.load_position), abs(turning)));
    const Real unit_motor_amplitude =
        max(max(abs(start + half_gap), abs(motor_turning + half_gap)),
            max(abs(half_.load_position - half_gap), abs(turning - half_gap)));

    const BasicCycleLosses<Real> losses =
        cycle_losses(servo_, flight_, half_, motor_friction_in_flight());
    const Real slope = half_map_slope(half_);
    const Real residual = closing_error(exp(-servo_.damping * half_.engaged_time), certain);
    certain = certain && half_.engaged_time > Real(0.0);

    select(certain, Real(CycleBlock::hunts), failed).store_aligned(block.outcome + row);
    const Real period = 2.0 * half_.engaged_time + 2.0 * half_.flight_time;
    const Real values[] = {amplitude * unit_amplitude,
                           amplitude * unit_motor_amplitude,
                           period,
                           1.0 / period,
                           slope * slope,
                           -amplitude * half_.gap_speed,
                           amplitude * largest_mesh_torque(),
                           2.0 * half_.engaged_time,
                           2.0 * half_.flight_time,
                           square * losses.motor_friction,
                           square * losses.load_friction,
                           square * losses.impacts,
                           residual};
    static_assert(std::size(values) == CycleBlock::property_count);
    const Real nothing = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < CycleBlock::property_count; ++i) {
      select(certain, values[i], nothing).store_aligned(block.properties[i] + row);
    }
  }

  BasicServoDynamics<Real> servo_;
  BasicGapFlight<Real> flight_;
  Real frequency_;
  Mask<Unit> permitted_;  ///< within the kernel's ranges, and growth at rest not 1
  Mask<Unit> sought_;     ///< permitted, and has a cycle
  Mask<Unit> found_;      ///< sought, and the half cycle balances
  Real growth_;
  HalfCycle half_{};
};

template <class Unit>
void solve_block(CycleBlock& block, std::size_t rows) {
  static_assert(CycleBlock::rows % CycleBlock::most_lanes == 0);
  static_assert(CycleBlock::most_lanes % Lanes<Unit>::size == 0);
  for (std::size_t row = 0; row < rows; row += Lanes<Unit>::size) {
    CycleLanes<Unit>::solve(block, row);
  }
}

}  // namespace gearlash::detail
