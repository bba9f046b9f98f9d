// Controllers as engineers name them, and their common linear form.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "base/fault.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash::drive {

/// z′ = state_matrix z + input_matrix (r, y, v) + anti_windup (τ − τ_asked), with the requested
/// torque
///   τ_asked = output z + direct (r, y, v);
/// r is the reference, y and v are the sensed position and speed, and τ is the delivered torque:
/// τ_asked within the motor's limit.
struct LinearController {
  std::vector<std::vector<double>> state_matrix{};  ///< n rows of n
  std::vector<std::vector<double>> input_matrix{};  ///< n rows of 3
  std::vector<double> output{};                     ///< n
  std::vector<double> direct{0.0, 0.0, 0.0};        ///< 3
  std::vector<double> anti_windup{};                ///< n, or none

  std::size_t order() const { return output.size(); }
};

/// τ = proportional (r − y) − derivative v.
struct ProportionalDerivative {
  double proportional = 0.0;  ///< N m/rad
  double derivative = 0.0;    ///< N m s/rad, on the sensed speed
};

/// τ = proportional e + integral ∫e dt + derivative · s/(filter s + 1) e, e = r − y; without a
/// filter, or with one on the speed, the derivative acts on −v, the sensed speed:
///   − derivative · 1/(filter s + 1) v.
struct ProportionalIntegralDerivative {
  double proportional = 0.0;  ///< N m/rad
  double integral = 0.0;      ///< N m/(rad s)
  double derivative = 0.0;    ///< N m s/rad
  double filter = 0.0;        ///< s, ≥ 0
  /// While the torque is at its limit, the integral returns to the value that requests just this
  /// torque, with this time constant (back-calculation, Åström & Hägglund 2006, ch. 3.5). 0: it
  /// winds up.
  double tracking_time = 0.0;  ///< s, ≥ 0
  bool derivative_of_speed = false;
};

/// A speed controller within a position controller: w = position (r − y), f = 1/(filter s + 1) v,
///   τ = speed (w − f) + speed_integral ∫(w − f) dt.
struct Cascade {
  double position = 0.0;        ///< 1/s
  double speed = 0.0;           ///< N m s/rad
  double speed_integral = 0.0;  ///< N m/rad
  double tracking_time = 0.0;   ///< s, as above
  double filter = 0.0;          ///< s, ≥ 0
};

/// τ = gain (s/zero + 1)/(s/pole + 1) e: lead if zero < pole, lag if zero > pole.
struct LeadLag {
  double gain = 0.0;  ///< N m/rad
  double zero = 0.0;  ///< rad/s, > 0
  double pole = 0.0;  ///< rad/s, > 0
};

/// τ = G(s) e; proper, without delay.
struct ErrorTransfer {
  TransferFunction function{};
};

/// τ = G(z) e, where z advances by one sampling period: for sampled drives only. Coefficients by
/// descending powers; proper, and no pole beyond the unit circle.
struct SampledTransfer {
  std::vector<double> numerator{};
  std::vector<double> denominator{};
};

using Controller = std::variant<ProportionalDerivative, ProportionalIntegralDerivative, Cascade,
                                LeadLag, ErrorTransfer, LinearController, SampledTransfer>;

/// Every fault in the ranges above, in shapes that do not agree, and of a transfer function that is
/// not proper. Gains may have any sign; the user decides what they do.
std::vector<Fault> validate(const Controller& controller);

/// Precondition: validate(controller) is empty. A SampledTransfer is one from sample to sample,
/// sampled_controller().
LinearController linear_controller(const Controller& controller);

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
struct Sampling {
  double period = 0.0;  ///< s, > 0
  double delay = 0.0;   ///< s, 0 … most_periods_of_delay periods
  Discretization method = Discretization::tustin;
  /// The sensed speed is the difference of two position readings over the period; otherwise it
  /// comes from a tachometer.
  bool speed_by_differences = true;

  bool operator==(const Sampling&) const = default;
};

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

/// Whether a position that stands beside the reference leaves no state of the controller standing,
/// within the torque limit: 0 = state_matrix z + input_matrix (0, y, 0) has no solution for y ≠ 0.
/// Sampling by any method keeps that. Precondition: validate(controller) is empty.
bool integrates(const Controller& controller);

/// The largest modulus of an eigenvalue of the state matrix; 0 without states.
double spectral_radius(const LinearController& controller);

}  // namespace gearlash::drive
