// A drive as the fixed-step simulator takes it: plain SI numbers at the load's shaft.
#pragma once

#include <limits>

#include "gearlash/drive.hpp"

namespace gearlash::oracle {

struct PlainShaft {
  double inertia = 1.0;    ///< kg m², > 0
  double viscous = 0.0;    ///< N m s/rad
  double coulomb = 0.0;    ///< N m
  double breakaway = 0.0;  ///< N m, ≥ coulomb
  /// rad/s: up to here the dry torque of a moving shaft falls from breakaway to coulomb, in
  /// proportion.
  double stribeck_speed = 0.0;
};

enum class PlainContact { rigid, spring_damping_limited, spring_damping_full };

/// What the controller computes, with e = r − y of the position read and v the speed read:
///   PID:     proportional e + integral ∫e dt − derivative v, or, if `filters`, with the derivative
///            passed through 1/(filter s + 1): of the speed, or of the error;
///   cascade: speed_gain (w − v) + integral ∫(w − v) dt with w = position e.
struct PlainController {
  bool is_cascade = false;
  double position = 0.0;       ///< 1/s, cascade
  double proportional = 0.0;   ///< N m/rad; of a cascade the speed gain, N m s/rad
  double integral = 0.0;       ///< N m/(rad s); of a cascade N m/rad
  double derivative = 0.0;     ///< N m s/rad
  double filter = 0.0;         ///< s
  double tracking_time = 0.0;  ///< s; 0: the integral winds up
  bool derivative_of_speed = false;
};

struct PlainDrive {
  PlainShaft motor{};
  PlainShaft load{};
  double backlash = 0.0;  ///< rad, face to face
  PlainContact contact = PlainContact::rigid;
  double restitution = 0.0;
  double stiffness = 0.0;       ///< N m/rad, of compliant faces
  double damping = 0.0;         ///< N m s/rad, of compliant faces
  bool reads_load = true;       ///< position; else the motor's
  bool speed_of_load = true;    ///< else the motor's
  double step = 0.0;            ///< rad, of the position's encoder; 0: exact
  double speed_step = 0.0;      ///< rad, of the encoder whose differences are the speed
  bool has_tachometer = false;  ///< the speed is exact, no difference of positions
  PlainController controller{};
  double limit = std::numeric_limits<double>::infinity();  ///< N m, of the motor's torque
  /// s; 0: a continuous controller. One with states is sampled as fast as the simulator steps.
  double period = 0.0;
  double delay = 0.0;  ///< s, 0 … period
  double blend = 0.5;  ///< share of the new value in an integration step: 1/2 trapezoidal (Tustin),
                       ///< 1 backward, 0 forward
  double reference = 0.0;          ///< rad, constant
  double load_torque = 0.0;        ///< N m, constant, forward
  double gravity_stiffness = 0.0;  ///< N m/rad, of the load about the reference

  /// Whether the controller has numbers of its own.
  [[nodiscard]] bool has_states() const {
    return controller.is_cascade || controller.integral != 0.0 || controller.filter > 0.0;
  }
  /// rad: the smallest of backlash and encoder steps.
  [[nodiscard]] double small_length() const;
};

/// Referred to the load's shaft by formulas of its own. Throws std::invalid_argument for what the
/// simulator does not know: a motor that is not torque-controlled, other controllers than PID and
/// cascade, delays beyond one period, signals that are not constant, and a continuous controller
/// that reads an encoder.
[[nodiscard]] PlainDrive plain_drive(const Drive& drive);

}  // namespace gearlash::oracle
