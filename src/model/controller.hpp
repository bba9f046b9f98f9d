// Controllers as engineers name them, and their common linear form.
#pragma once

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <variant>
#include <vector>

#include "base/fault.hpp"
#include "base/interval.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash::drive {

/// z′ = state_matrix z + input_matrix (r, y, v) + anti_windup (τ − τ_asked), with the requested
/// torque
///   τ_asked = output z + direct (r, y, v);
/// r is the reference, y and v are the sensed position and speed, and τ is the delivered torque:
/// τ_asked within the motor's limit.
template <class Number>
struct LinearControllerOf {
  std::vector<std::vector<Number>> state_matrix{};  ///< n rows of n
  std::vector<std::vector<Number>> input_matrix{};  ///< n rows of 3
  std::vector<Number> output{};                     ///< n
  std::vector<Number> direct{0.0, 0.0, 0.0};        ///< 3
  std::vector<Number> anti_windup{};                ///< n, or none

  std::size_t order() const { return output.size(); }

  static constexpr auto members() {
    return std::make_tuple(&LinearControllerOf::state_matrix, &LinearControllerOf::input_matrix,
                           &LinearControllerOf::output, &LinearControllerOf::direct,
                           &LinearControllerOf::anti_windup);
  }
};
using LinearController = LinearControllerOf<double>;

/// Whether the row, of (r, y, v), knows r and y by their difference alone.
template <class Number>
bool is_of_difference(const std::vector<Number>& row) {
  return row[0] == -row[1];
}
/// Of intervals made of one number, or of two that are the same double.
inline bool is_of_difference(const std::vector<Interval>& row) {
  return row[0].low == -row[1].high && row[0].high == -row[1].low;
}

/// Whether a controller does.
template <class Number>
bool knows_error_alone(const LinearControllerOf<Number>& controller) {
  return is_of_difference(controller.direct) &&
         std::all_of(controller.input_matrix.begin(), controller.input_matrix.end(),
                     [](const std::vector<Number>& row) { return is_of_difference(row); });
}

/// τ = proportional (r − y) − derivative v.
template <class Number>
struct ProportionalDerivativeOf {
  Number proportional = 0.0;  ///< N m/rad
  Number derivative = 0.0;    ///< N m s/rad, on the sensed speed

  static constexpr auto members() {
    return std::make_tuple(&ProportionalDerivativeOf::proportional,
                           &ProportionalDerivativeOf::derivative);
  }
};
using ProportionalDerivative = ProportionalDerivativeOf<double>;

/// τ = proportional e + integral ∫e dt + derivative · s/(filter s + 1) e, e = r − y; without a
/// filter, or with one on the speed, the derivative acts on −v, the sensed speed:
///   − derivative · 1/(filter s + 1) v.
template <class Number>
struct ProportionalIntegralDerivativeOf {
  Number proportional = 0.0;  ///< N m/rad
  Number integral = 0.0;      ///< N m/(rad s)
  Number derivative = 0.0;    ///< N m s/rad
  Number filter = 0.0;        ///< s, ≥ 0
  /// While the torque is at its limit, the integral returns to the value that requests just this
  /// torque, with this time constant (back-calculation, Åström & Hägglund 2006, ch. 3.5). 0: it
  /// winds up.
  Number tracking_time = 0.0;  ///< s, ≥ 0
  bool derivative_of_speed = false;

  static constexpr auto members() {
    return std::make_tuple(
        &ProportionalIntegralDerivativeOf::proportional,
        &ProportionalIntegralDerivativeOf::integral, &ProportionalIntegralDerivativeOf::derivative,
        &ProportionalIntegralDerivativeOf::filter, &ProportionalIntegralDerivativeOf::tracking_time,
        &ProportionalIntegralDerivativeOf::derivative_of_speed);
  }
};
using ProportionalIntegralDerivative = ProportionalIntegralDerivativeOf<double>;

/// A speed controller within a position controller: w = position (r − y), f = 1/(filter s + 1) v,
///   τ = speed (w − f) + speed_integral ∫(w − f) dt.
template <class Number>
struct CascadeOf {
  Number position = 0.0;        ///< 1/s
  Number speed = 0.0;           ///< N m s/rad
  Number speed_integral = 0.0;  ///< N m/rad
  Number tracking_time = 0.0;   ///< s, as above
  Number filter = 0.0;          ///< s, ≥ 0

  static constexpr auto members() {
    return std::make_tuple(&CascadeOf::position, &CascadeOf::speed, &CascadeOf::speed_integral,
                           &CascadeOf::tracking_time, &CascadeOf::filter);
  }
};
using Cascade = CascadeOf<double>;

/// τ = gain (s/zero + 1)/(s/pole + 1) e: lead if zero < pole, lag if zero > pole.
template <class Number>
struct LeadLagOf {
  Number gain = 0.0;  ///< N m/rad
  Number zero = 0.0;  ///< rad/s, > 0
  Number pole = 0.0;  ///< rad/s, > 0

  static constexpr auto members() {
    return std::make_tuple(&LeadLagOf::gain, &LeadLagOf::zero, &LeadLagOf::pole);
  }
};
using LeadLag = LeadLagOf<double>;

/// τ = G(s) e; proper, without delay.
template <class Number>
struct ErrorTransferOf {
  TransferFunctionOf<Number> function{};

  static constexpr auto members() { return std::make_tuple(&ErrorTransferOf::function); }
};
using ErrorTransfer = ErrorTransferOf<double>;

/// τ = G(z) e, where z advances by one sampling period: for sampled drives only. Coefficients by
/// descending powers; proper, and no pole beyond the unit circle.
template <class Number>
struct SampledTransferOf {
  std::vector<Number> numerator{};
  std::vector<Number> denominator{};

  static constexpr auto members() {
    return std::make_tuple(&SampledTransferOf::numerator, &SampledTransferOf::denominator);
  }
};
using SampledTransfer = SampledTransferOf<double>;

template <class Number>
using ControllerOf =
    std::variant<ProportionalDerivativeOf<Number>, ProportionalIntegralDerivativeOf<Number>,
                 CascadeOf<Number>, LeadLagOf<Number>, ErrorTransferOf<Number>,
                 LinearControllerOf<Number>, SampledTransferOf<Number>>;
using Controller = ControllerOf<double>;

/// Every fault in the ranges above, in shapes that do not agree, and of a transfer function that is
/// not proper. Gains may have any sign; the user decides what they do.
std::vector<Fault> faults(const Controller& controller);

/// Precondition: faults(controller) is empty. A SampledTransfer is one from sample to sample,
/// sampled_controller().
LinearController linear_controller(const Controller& controller);
/// Contains that of every controller within. Its order may be higher than that of one of them: it
/// has a state wherever one of them may have one.
LinearControllerOf<Interval> linear_controller(const ControllerOf<Interval>& controller);

/// The substitute for d/dt, with T the period and z an advance by T.
enum class Discretization {
  tustin,    ///< (2/T)(z − 1)/(z + 1)
  backward,  ///< (z − 1)/(T z)
  forward    ///< (z − 1)/T
};

/// A state advances by T ((1 − share) ẋ(t) + share ẋ(t + T)): ½, 1, 0.
double share_of_end(Discretization method);

/// Timing of a sampled controller: it reads at 0, period, 2 period, …, and outputs each result
/// `delay` later. The output is held until the next one.
template <class Number>
struct SamplingOf {
  Number period = 0.0;  ///< s, > 0
  Number delay = 0.0;   ///< s, 0 … most_periods_of_delay periods
  Discretization method = Discretization::tustin;
  /// The sensed speed is the difference of two position readings over the period; otherwise it
  /// comes from a tachometer.
  bool speed_by_differences = true;

  bool operator==(const SamplingOf&) const = default;

  static constexpr auto members() {
    return std::make_tuple(&SamplingOf::period, &SamplingOf::delay, &SamplingOf::method,
                           &SamplingOf::speed_by_differences);
  }
};
using Sampling = SamplingOf<double>;

/// Each period that a result waits for its output is a number of the state.
inline constexpr int most_periods_of_delay = 100;

/// A computational delay as whole periods, in which other samples are read, and a rest.
struct SplitDelay {
  int whole_periods = 0;
  double rest = 0.0;  ///< s, above 0 and at most the period; 0 if there is no delay
};

/// Precondition: a sound sampling. A delay within rounding of a multiple of the period counts as
/// that multiple.
SplitDelay split_delay(const Sampling& sampling);

/// The controller from sample to sample,
///   z⁺ = state_matrix z + input_matrix (r, y, v) + anti_windup (τ − τ_asked),
/// outputs as above. Precondition: both are sound.
LinearController sampled_controller(const Controller& controller, const Sampling& sampling);
/// Contains that of every controller and sampling within.
LinearControllerOf<Interval> sampled_controller(const ControllerOf<Interval>& controller,
                                                const SamplingOf<Interval>& sampling);

/// Of (r, y, v) ↦ x: what x receives of a reference and of a position at it. 0 where it knows their
/// difference alone.
template <class Number>
Number of_both(const std::vector<Number>& row) {
  return is_of_difference(row) ? Number(0.0) : row[0] + row[1];
}

/// Whether a position that stands beside the reference leaves no state of the controller standing,
/// within the torque limit: 0 = state_matrix z + input_matrix (0, y, 0) has no solution for y ≠ 0.
/// Sampling by any method keeps that. Precondition: faults(controller) is empty.
bool integrates(const Controller& controller);

/// The largest modulus of an eigenvalue of the state matrix; 0 without states.
double spectral_radius(const LinearController& controller);

}  // namespace gearlash::drive
