// Controllers by the names and gains that engineers use.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "gearlash/firmware.hpp"

namespace gearlash {

/// A shaft of the drive.
enum class ShaftName : std::uint8_t { load, motor };

/// Where gains act. A torque-controlled motor has torques as outputs: of the same shaft as the
/// angles, unless they are mixed. A motor driven by a voltage has volts as outputs in any case.
enum class GainShaft : std::uint8_t {
  load,  ///< gains at the joint, as robots' firmware, URDF and MuJoCo give them
  motor,
  mixed  ///< output of the motor, its torque or its voltage, per angle of the load
};

// "output" below is V for a motor that is driven by a voltage, else N m at the shaft that
// Controller::shaft names. e = r − y is the error of the measured position, v the measured speed.
// Angles are those of Controller::shaft.

/// Which terms a PID controller has.
enum class PIDTerms : std::uint8_t { P, PD, PI, PID };

/// proportional e + integral ∫e dt + derivative · s/(filter s + 1) e. Without a filter, or if the
/// derivative is of the speed, it acts on −v: − derivative · 1/(filter s + 1) v.
struct PID {
  PIDTerms terms = PIDTerms::P;  ///< the others are 0
  double proportional = 0.0;     ///< output/rad
  double integral = 0.0;         ///< output/(rad s); PI and PID
  double derivative = 0.0;       ///< output s/rad; PD and PID
  double filter = 0.0;           ///< s, ≥ 0; PD and PID
  /// While the output is at its limit the integral is drawn back, with this time constant, to the
  /// value that would ask for the limit (back-calculation; Åström & Hägglund 2006, ch. 3.5). 0: it
  /// winds up.
  double tracking_time = 0.0;        ///< s, ≥ 0; PI and PID
  bool derivative_of_speed = false;  ///< of the speed, not of the error

  bool operator==(const PID&) const = default;
};

/// A speed controller within a position controller: with the speed ṙ of the reference,
/// w = position e + speed_feedforward ṙ, at most speed_limit of either sign,
/// f = 1/(filter s + 1) v,
/// speed (w − f) + speed_integral ∫(w − f) dt + acceleration_feedforward r̈.
struct CascadeController {
  double position = 0.0;                  ///< 1/s
  double speed = 0.0;                     ///< output s/rad
  double speed_integral = 0.0;            ///< output/rad
  double tracking_time = 0.0;             ///< s, ≥ 0, as above
  double filter = 0.0;                    ///< s, ≥ 0; of the measured speed
  std::optional<double> speed_limit{};    ///< rad/s, > 0, of the speed that is asked for
  double speed_feedforward = 0.0;         ///< share of the reference's speed, 0 … 1
  double acceleration_feedforward = 0.0;  ///< output s²/rad, ≥ 0

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
  double gain = 0.0;                  ///< output/rad
  std::vector<double> numerator{};    ///< of no higher degree than the denominator
  std::vector<double> denominator{};  ///< the first one not 0
  bool is_sampled = false;            ///< of z

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

/// The input of a relay.
enum class RelayInput : std::uint8_t {
  error,  ///< e
  speed   ///< −v, with no regard to the position
};

/// ±level, or 0: see DeadBand, which has its thresholds.
struct RelayController {
  double level = 0.0;                    ///< output, > 0
  RelayInput input = RelayInput::error;  ///< what it switches on

  bool operator==(const RelayController&) const = default;
};

/// What a law receives of an error beyond the dead band.
enum class DeadBandForm : std::uint8_t {
  excess,  ///< e ∓ width, which does not jump
  whole    ///< e
};

/// Before a law: it receives 0 instead of e while |e| is small. The outer branch of either sign
/// begins as ±e passes width + hysteresis, and ends as ±e passes width − hysteresis. A relay gives
/// ±level on the outer branches and 0 between them; without a width it is the relay with
/// hysteresis, which switches at ±hysteresis.
struct DeadBand {
  double width = 0.0;  ///< rad, half of the band, ≥ 0; rad/s for a relay of the speed
  /// ≥ 0, in the unit of the width. With a law that is not a relay, only for DeadBandForm::whole.
  double hysteresis = 0.0;
  DeadBandForm form = DeadBandForm::excess;  ///< what passes beyond it

  bool operator==(const DeadBand&) const = default;
};

/// What a backlash compensation follows.
enum class CompensationInput : std::uint8_t { reference, error };

/// A controller's knowledge of friction and gap.
struct Compensation {
  /// Added to the output: friction · sat(w/friction_speed), with w the speed of the reference; or
  /// friction · sign w.
  double friction = 0.0;        ///< output
  double friction_speed = 0.0;  ///< rad/s of Controller::shaft, ≥ 0
  /// The backlash that the controller assumes, face to face. It adds ± half of it to the reference,
  /// with the sign of its last motion, or to the error, with the error's sign.
  double backlash = 0.0;                                   ///< rad at the load's shaft
  CompensationInput input = CompensationInput::reference;  ///< which sign it follows
  /// Of the reference: the time constant in which the addition changes sides; 0: at once.
  double take_up_time = 0.0;  ///< s, ≥ 0
  /// Of the error: the error at which all of the half is added; below, in proportion.
  double take_up_angle = 0.0;  ///< rad of Controller::shaft, > 0

  bool operator==(const Compensation&) const = default;
};

struct Controller {
  std::variant<PID, CascadeController, LeadLagController, TransferFunctionController,
               StateSpaceController, RelayController>
      law{};
  GainShaft shaft = GainShaft::mixed;  ///< where angles and torques are
  DeadBand dead_band{};                ///< before the law
  Compensation compensation{};         ///< beside the law
  /// If given, it replaces all of the above: the registers of a motor's firmware, which are
  /// converted to one of these laws.
  std::optional<Firmware> firmware{};
  /// ≥ 0, a tachometer: the drive's amplifier subtracts it times the motor's speed from the output
  /// of any of these. V s/rad of the motor's shaft, or N m s/rad with torque control. It is
  /// continuous and exact, whatever the sampling, and limits of the output do not act on it: like a
  /// back-EMF it is friction of the motor.
  double motor_speed_feedback = 0.0;

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
  double period = 0.0;                             ///< s, > 0
  double delay = 0.0;                              ///< s, 0 … 100 periods
  Discretization method = Discretization::tustin;  ///< of integral, derivative and filters
  /// s: of the position controller of a cascade, a whole multiple of `period`, which is then that
  /// of its speed controller. If not given they are the same.
  std::optional<double> position_period{};
  /// The measured speed is the difference of two positions divided by the period; else a
  /// tachometer's.
  bool speed_by_differences = true;

  bool operator==(const Sampling&) const = default;
};

}  // namespace gearlash
