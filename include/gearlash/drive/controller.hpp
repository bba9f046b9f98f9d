// Controllers as engineers name them, and the linear one that each of them is.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "gearlash/cycle/transfer_function.hpp"
#include "gearlash/servo/violation.hpp"

namespace gearlash {

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
/// filter the derivative acts on −v, the speed sensed.
struct ProportionalIntegralDerivative {
  double proportional = 0.0;  ///< N m/rad
  double integral = 0.0;      ///< N m/(rad s)
  double derivative = 0.0;    ///< N m s/rad
  double filter = 0.0;        ///< s, ≥ 0
  /// While the torque is at its limit the integral is drawn back to what would ask for it, with
  /// this time constant (back-calculation, Åström & Hägglund 2006, ch. 3.5); 0: it winds up.
  double tracking_time = 0.0;  ///< s, ≥ 0
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

using Controller = std::variant<ProportionalDerivative, ProportionalIntegralDerivative, Cascade,
                                LeadLag, ErrorTransfer, LinearController>;

/// Every violation of the ranges above, of shapes that do not agree, of a transfer function that is
/// not proper. Gains may have any sign: what they do is the user's.
std::vector<Violation> validate(const Controller& controller);

/// Precondition: validate(controller) is empty.
LinearController linear_controller(const Controller& controller);

}  // namespace gearlash
