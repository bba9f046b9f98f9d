// A drive at the load's shaft, in SI units: shafts, gap, friction, sensor, controller, signals.
#pragma once

#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "base/fault.hpp"
#include "model/controller.hpp"
#include "model/signal.hpp"

namespace gearlash::drive {

/// Torque against the motion: viscous ω + coulomb sign ω. At rest it balances the applied torque,
/// up to `breakaway`. Below `stribeck_speed` the dry part is
/// breakaway − (breakaway − coulomb) |ω|/stribeck_speed.
struct ShaftFriction {
  double viscous = 0.0;         ///< N m s/rad, ≥ 0
  double coulomb = 0.0;         ///< N m, ≥ 0
  double breakaway = 0.0;       ///< N m, ≥ coulomb
  double stribeck_speed = 0.0;  ///< rad/s, ≥ 0

  bool is_dry() const { return breakaway > 0.0; }
  /// Whether friction at rest is higher than that of motion.
  bool has_stiction() const { return breakaway > coulomb; }
  /// Whether the dry part falls over a range of speeds.
  bool falls() const { return stribeck_speed > 0.0 && has_stiction(); }
};

struct Shaft {
  double inertia = 0.0;  ///< kg m², > 0
  ShaftFriction friction{};
};

/// The winding of a motor that is driven by a voltage. Its torque τ lags behind the requested one:
/// time_constant τ′ = τ_requested − back_emf ω_M − τ.
struct Winding {
  double time_constant = 0.0;  ///< s, ≥ 0. At 0, back_emf is part of the motor's viscous friction
  double back_emf = 0.0;       ///< N m s/rad, ≥ 0
  /// Of the largest current, N m, > 0: the amplifier lets |τ| rise no further.
  double torque_limit = std::numeric_limits<double>::infinity();
};

/// What a controller receives instead of its error e, by branches of an input: e, or −v.
/// On the outer branch of the sign s: outer_gain e + s offset. It begins as s · input passes
/// `begins` and ends as s · input passes `ends`. On the inner branch: inner_gain e.
struct ErrorShape {
  double begins = 0.0;  ///< ≥ |ends|
  double ends = 0.0;
  double inner_gain = 1.0;
  double outer_gain = 1.0;
  double offset = 0.0;  ///< rad
  bool is_of_speed = false;
  bool jumps = false;  ///< what it gives jumps between its branches

  /// Whether it changes the error at all.
  bool is_present() const { return inner_gain != 1.0 || outer_gain != 1.0 || offset != 0.0; }
  bool is_relay() const { return outer_gain == 0.0; }
  /// rad, what the controller receives less the error. Precondition: not a relay.
  double largest_change() const {
    return inner_gain == 0.0 ? begins : offset < 0.0 ? -offset : offset;
  }
  /// Whether it has no inner branch: a relay with two levels.
  bool is_two_level() const { return is_relay() && ends == -begins; }
};

/// What a controller adds because of its reference's speed w.
struct Feedforward {
  double torque = 0.0;        ///< N m: torque · sat(w/speed), or torque · sign w
  double speed = 0.0;         ///< rad/s, ≥ 0
  double half_gap = 0.0;      ///< rad, on the side of the reference's last motion
  double take_up_time = 0.0;  ///< s, ≥ 0: a lag of half_gap

  bool is_absent() const { return torque == 0.0 && half_gap == 0.0; }
};

/// The weight of the load, linearised: the torque −stiffness (θ_L − angle) beside the one that it
/// has at `angle`, which is part of the load torque.
struct Gravity {
  double torque = 0.0;     ///< N m, at `angle`; part of ReducedDrive::load_torque
  double stiffness = 0.0;  ///< N m/rad; negative where the load would tip over
  double angle = 0.0;      ///< rad

  bool is_absent() const { return torque == 0.0 && stiffness == 0.0; }
};

/// Rigid faces: impacts.
struct RigidContact {
  double restitution = 0.0;  ///< 0 … 1
};

/// How the damping of compliant faces acts. Neither law ever pulls.
enum class ContactDamping {
  /// Modelica's ElastoBacklash: at most the spring's own torque while the faces close, so that the
  /// torque does not jump as they meet.
  limited,
  /// Modelica's ElastoBacklash2: from the first touch on.
  full
};

/// Compliant faces: torque stiffness · δ + damping · δ̇, where δ is the compression. Without a gap
/// they are joined: stiffness · u + damping · u̇ in both directions, where u is the motor less the
/// load, by either law.
struct CompliantContact {
  double stiffness = 0.0;  ///< N m/rad, > 0
  double damping = 0.0;    ///< N m s/rad, ≥ 0
  ContactDamping law = ContactDamping::limited;
};

using Contact = std::variant<RigidContact, CompliantContact>;

/// The position that the controller receives: load_share θ_L + (1 − load_share) θ_M. Likewise the
/// speed.
struct Sensing {
  double load_share_of_position = 1.0;  ///< 0 … 1
  double load_share_of_speed = 0.0;     ///< 0 … 1
  /// Encoders read positions to whole multiples of these, halves away from 0.
  double resolution = 0.0;           ///< rad, ≥ 0
  double resolution_of_speed = 0.0;  ///< rad, ≥ 0; for the position whose differences are the speed
};

/// The input of simulation and search, made from a gearlash::Drive by reduce().
struct ReducedDrive {
  Shaft motor{};
  Shaft load{};
  double backlash = 0.0;  ///< rad, face to face; > 0, or 0 with compliant faces
  Contact contact{};
  Sensing sensing{};
  Controller controller{};
  ErrorShape error_shape{};
  Feedforward feedforward{};
  /// Of the requested torque, before the winding. N m, > 0.
  double torque_limit = std::numeric_limits<double>::infinity();
  Winding winding{};
  std::optional<Sampling> sampling{};  ///< without it the controller is continuous
  Signal reference{};                  ///< rad
  Signal load_torque{};                ///< N m, on the load, forward
  Gravity gravity{};
};

/// Whether the shafts are joined by a spring without a gap.
inline bool is_joined(const ReducedDrive& drive) {
  return drive.backlash == 0.0 && std::holds_alternative<CompliantContact>(drive.contact);
}

/// Whether dry friction acts on either shaft.
inline bool has_dry_friction(const ReducedDrive& drive) {
  return drive.motor.friction.is_dry() || drive.load.friction.is_dry();
}

/// Whether friction at rest is higher than that of motion, on either shaft.
inline bool has_stiction(const ReducedDrive& drive) {
  return drive.motor.friction.has_stiction() || drive.load.friction.has_stiction();
}

/// Whether gap and dry friction are all that is not linear in the drive, its sensors and limits
/// left aside: its controller is linear, and adds nothing by the sign of a speed.
inline bool has_linear_control(const ReducedDrive& drive) {
  return !drive.error_shape.is_present() && drive.feedforward.is_absent();
}

/// Whether a sine reference or load torque drives the oscillation, which then is not hunting.
bool is_driven(const ReducedDrive& drive);

/// Every fault in the ranges above.
std::vector<Fault> validate(const ReducedDrive& drive);

}  // namespace gearlash::drive
