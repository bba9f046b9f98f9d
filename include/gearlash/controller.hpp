// Controllers by the names and gains that engineers use.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

namespace gearlash {

/// A shaft of the drive.
enum class ShaftName : std::uint8_t { load, motor };

// The controller's output is a voltage. For a torque-controlled motor it is the torque at the
// motor's shaft. "output" is V or N m below. e = r − y is the error of the measured position, v the
// measured speed. Angles are those of Controller::shaft.

/// Which terms a PID controller has.
enum class PIDTerms : std::uint8_t { P, PD, PI, PID };

/// proportional e + integral ∫e dt + derivative · s/(filter s + 1) e. Without a filter, or if the
/// derivative is of the speed, it acts on −v: − derivative · 1/(filter s + 1) v.
struct PID {
  PIDTerms terms = PIDTerms::P;
  double proportional = 0.0;  ///< output/rad
  double integral = 0.0;      ///< output/(rad s); PI and PID
  double derivative = 0.0;    ///< output s/rad; PD and PID
  double filter = 0.0;        ///< s, ≥ 0; PD and PID
  /// While the output is at its limit the integral is drawn back, with this time constant, to the
  /// value that would ask for the limit (back-calculation; Åström & Hägglund 2006, ch. 3.5). 0: it
  /// winds up.
  double tracking_time = 0.0;  ///< s, ≥ 0; PI and PID
  bool derivative_of_speed = false;

  bool operator==(const PID&) const = default;
};

/// A speed controller within a position controller: w = position e,
/// speed (w − v) + speed_integral ∫(w − v) dt.
struct CascadeController {
  double position = 0.0;        ///< 1/s
  double speed = 0.0;           ///< output s/rad
  double speed_integral = 0.0;  ///< output/rad
  double tracking_time = 0.0;   ///< s, ≥ 0, as above

  bool operator==(const CascadeController&) const = default;
};

/// gain (s/zero + 1)/(s/pole + 1) e: lead where zero < pole, lag where zero > pole.
struct LeadLagController {
  double gain = 0.0;  ///< output/rad
  double zero = 0.0;  ///< rad/s, > 0
  double pole = 0.0;  ///< rad/s, > 0

  bool operator==(const LeadLagController&) const = default;
};

/// gain · numerator/denominator e, coefficients by descending powers of s, or of z from sample to
/// sample. Proper; in z, without a pole outside the unit circle.
struct TransferFunctionController {
  double gain = 0.0;  ///< output/rad
  std::vector<double> numerator{};
  std::vector<double> denominator{};
  bool is_sampled = false;  ///< of z

  bool operator==(const TransferFunctionController&) const = default;
};

/// x′ = A x + B u, gain (C x + D u). u is e if B and D have one column, else (r, y, v).
struct StateSpaceController {
  double gain = 0.0;                     ///< output/rad
  std::vector<std::vector<double>> A{};  ///< n rows of n
  std::vector<std::vector<double>> B{};  ///< n rows of 1 or 3
  std::vector<double> C{};               ///< n
  std::vector<double> D{};               ///< 1 or 3

  bool operator==(const StateSpaceController&) const = default;
};

struct Controller {
  std::variant<PID, CascadeController, LeadLagController, TransferFunctionController,
               StateSpaceController>
      law{};
  /// The gains are per angle of this shaft. The output is the motor's in either case.
  ShaftName shaft = ShaftName::load;
  /// The gains are torque at the load per angle of the load, as robots give them; `shaft` does not
  /// matter then. For torque-controlled motors only.
  bool is_at_joint = false;

  bool operator==(const Controller&) const = default;
};

/// What replaces d/dt in a sampled controller; T is the period, z undoes a delay of one period.
enum class Discretization : std::uint8_t {
  tustin,    ///< (2/T)(z − 1)/(z + 1)
  backward,  ///< (z − 1)/(T z)
  forward    ///< (z − 1)/T
};

/// How a computer runs a controller: it reads at 0, period, 2 period, … and outputs each result
/// `delay` later. It holds it until the next.
struct Sampling {
  double period = 0.0;  ///< s, > 0
  double delay = 0.0;   ///< s, 0 … 100 periods
  Discretization method = Discretization::tustin;
  /// The measured speed is the difference of two positions divided by the period; else a
  /// tachometer's.
  bool speed_by_differences = true;

  bool operator==(const Sampling&) const = default;
};

}  // namespace gearlash
