// Controllers as engineers name them, and the linear one that each of them is.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "base/fault.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash::drive {

/// z′ = state_matrix z + input_matrix (r, y, v) + anti_windup (τ − τ_asked), and the torque asked
/// for
///   τ_asked = output z + direct (r, y, v);
/// r is the reference, y and v are the position and speed sensed, τ is the torque given: τ_asked
/// within the motor's limit.
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
  double derivative = 0.0;    ///< N m s/rad, on the speed sensed
};

/// τ = proportional e + integral ∫e dt + derivative · s/(filter s + 1) e,  e = r − y; without a
/// filter, or where it is the speed's, the derivative acts on −v, the speed sensed:
///   − derivative · 1/(filter s + 1) v.
struct ProportionalIntegralDerivative {
  double proportional = 0.0;  ///< N m/rad
  double integral = 0.0;      ///< N m/(rad s)
  double derivative = 0.0;    ///< N m s/rad
  double filter = 0.0;        ///< s, ≥ 0
  /// While the torque is at its limit the integral is drawn back to what would ask for it, with
  /// this time constant (back-calculation, Åström & Hägglund 2006, ch. 3.5); 0: it winds up.
  double tracking_time = 0.0;  ///< s, ≥ 0
  bool derivative_of_speed = false;
};

/// A speed controller within a position controller: w = position (r − y),
///   τ = speed (w − v) + speed_integral ∫(w − v) dt.
struct Cascade {
  double position = 0.0;        ///< 1/s
  double speed = 0.0;           ///< N m s/rad
  double speed_integral = 0.0;  ///< N m/rad
  double tracking_time = 0.0;   ///< s, as above
};

/// τ = gain (s/zero + 1)/(s/pole + 1) e: lead where zero < pole, lag where zero > pole.
struct LeadLag {
  double gain = 0.0;  ///< N m/rad
  double zero = 0.0;  ///< rad/s, > 0
  double pole = 0.0;  ///< rad/s, > 0
};

/// τ = G(s) e; proper, without delay.
struct ErrorTransfer {
  TransferFunction function{};
};

/// τ = G(z) e, z a delay by one sampling period undone: for sampled drives only. Coefficients by
/// descending powers; proper, and no pole beyond the unit circle.
struct SampledTransfer {
  std::vector<double> numerator{};
  std::vector<double> denominator{};
};

using Controller = std::variant<ProportionalDerivative, ProportionalIntegralDerivative, Cascade,
                                LeadLag, ErrorTransfer, LinearController, SampledTransfer>;

/// Every fault of the ranges above, of shapes that do not agree, of a transfer function that is
/// not proper. Gains may have any sign: what they do is the user's.
std::vector<Fault> validate(const Controller& controller);

/// Precondition: validate(controller) is empty. A SampledTransfer is one from sample to sample,
/// sampled_controller().
LinearController linear_controller(const Controller& controller);

/// What stands for d/dt, with T the period and z the delay undone.
enum class Discretization {
  tustin,    ///< (2/T)(z − 1)/(z + 1)
  backward,  ///< (z − 1)/(T z)
  forward    ///< (z − 1)/T
};

/// How a computer runs a controller: it reads at 0, period, 2 period, …, and gives out what it has
/// worked out `delay` later, to be held until the next is given out.
struct Sampling {
  double period = 0.0;  ///< s, > 0
  double delay = 0.0;   ///< s, 0 … most_periods_of_delay periods
  Discretization method = Discretization::tustin;
  /// The speed sensed is the difference of two readings of the position by the period; else it is a
  /// tachometer's.
  bool speed_by_differences = true;

  bool operator==(const Sampling&) const = default;
};

/// What was worked out waits for its turn; each period that it waits is a number of the state.
inline constexpr int most_periods_of_delay = 100;

/// A delay as a computer has it: whole periods, in which other samples are read, and a rest.
struct SplitDelay {
  int whole_periods = 0;
  double rest = 0.0;  ///< s, above 0 to the period; 0 of no delay
};

/// Precondition: a sound sampling. A delay that is a multiple of the period but for rounding counts
/// as one.
SplitDelay split_delay(const Sampling& sampling);

/// The controller from sample to sample,
///   z⁺ = state_matrix z + input_matrix (r, y, v) + anti_windup (τ − τ_asked),
/// outputs as above. Precondition: both are sound.
LinearController sampled_controller(const Controller& controller, const Sampling& sampling);

/// The largest modulus of an eigenvalue of the state matrix; 0 without states.
double spectral_radius(const LinearController& controller);

}  // namespace gearlash::drive
