// A drive at the load's shaft, in SI units: shafts, gap, friction, sensor, controller, signals.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <variant>
#include <vector>

#include "base/number.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/fault.hpp"
#include "model/controller.hpp"
#include "model/signal.hpp"

namespace gearlash::drive {

/// Torque against the motion: viscous ω + coulomb sign ω. At rest it balances the applied torque,
/// up to `breakaway`. Below `stribeck_speed` the dry part is
/// breakaway − (breakaway − coulomb) |ω|/stribeck_speed.
template <class Number>
struct ShaftFrictionOf {
  Number viscous = 0.0;         ///< N m s/rad, ≥ 0
  Number coulomb = 0.0;         ///< N m, ≥ 0
  Number breakaway = 0.0;       ///< N m, ≥ coulomb
  Number stribeck_speed = 0.0;  ///< rad/s, ≥ 0

  bool is_dry() const { return breakaway > 0.0; }
  /// Whether friction at rest is higher than that of motion.
  bool has_stiction() const { return breakaway > coulomb; }
  /// Whether the dry part falls over a range of speeds.
  bool falls() const { return stribeck_speed > 0.0 && has_stiction(); }

  static constexpr auto members() {
    return std::make_tuple(&ShaftFrictionOf::viscous, &ShaftFrictionOf::coulomb,
                           &ShaftFrictionOf::breakaway, &ShaftFrictionOf::stribeck_speed);
  }
};
using ShaftFriction = ShaftFrictionOf<double>;

template <class Number>
struct ShaftOf {
  Number inertia = 0.0;  ///< kg m², > 0
  ShaftFrictionOf<Number> friction{};

  static constexpr auto members() { return std::make_tuple(&ShaftOf::inertia, &ShaftOf::friction); }
};
using Shaft = ShaftOf<double>;

/// The winding of a motor that is driven by a voltage, or with its current controlled. Its torque τ
/// lags behind the requested one: time_constant τ′ = τ_requested − back_emf ω_M − τ.
template <class Number>
struct WindingOf {
  Number time_constant = 0.0;  ///< s, ≥ 0. At 0, back_emf is part of the motor's viscous friction
  Number back_emf = 0.0;       ///< N m s/rad, ≥ 0
  /// Of the largest current, N m, > 0: the amplifier lets |τ| rise no further.
  Number torque_limit = std::numeric_limits<double>::infinity();

  static constexpr auto members() {
    return std::make_tuple(&WindingOf::time_constant, &WindingOf::back_emf,
                           &WindingOf::torque_limit);
  }
};
using Winding = WindingOf<double>;

/// What a controller receives instead of its error e, by branches of an input: e, or −v.
/// On the outer branch of the sign s: outer_gain e + s offset. It begins as s · input passes
/// `begins` and ends as s · input passes `ends`. On the inner branch: inner_gain e.
template <class Number>
struct ErrorShapeOf {
  Number begins = 0.0;  ///< ≥ |ends|
  Number ends = 0.0;
  Number inner_gain = 1.0;
  Number outer_gain = 1.0;
  Number offset = 0.0;  ///< rad
  bool is_of_speed = false;
  bool jumps = false;  ///< what it gives jumps between its branches

  /// Whether it changes the error at all.
  bool is_present() const { return inner_gain != 1.0 || outer_gain != 1.0 || offset != 0.0; }
  bool is_relay() const { return inner_gain == 0.0 && outer_gain == 0.0; }
  /// Whether it keeps the error within ±offset: a limit of the speed that a cascade asks for.
  bool is_limit() const { return inner_gain != 0.0 && outer_gain == 0.0; }
  /// Whether small errors are not received as they are.
  bool changes_small_errors() const { return is_present() && !is_limit(); }
  /// rad, what the controller receives less the error. Precondition: neither a relay nor a limit.
  Number largest_change() const {
    using std::abs;
    return is_exactly(inner_gain, 0.0) ? begins : abs(offset);
  }
  /// Whether it has no inner branch: a relay with two levels.
  bool is_two_level() const { return is_relay() && ends == -begins; }

  static constexpr auto members() {
    return std::make_tuple(&ErrorShapeOf::begins, &ErrorShapeOf::ends, &ErrorShapeOf::inner_gain,
                           &ErrorShapeOf::outer_gain, &ErrorShapeOf::offset,
                           &ErrorShapeOf::is_of_speed, &ErrorShapeOf::jumps);
  }
};
using ErrorShape = ErrorShapeOf<double>;

/// What a controller adds because of its reference's speed w and acceleration.
template <class Number>
struct FeedforwardOf {
  Number torque = 0.0;        ///< N m: torque · sat(w/speed), or torque · sign w
  Number speed = 0.0;         ///< rad/s, ≥ 0
  Number half_gap = 0.0;      ///< rad, on the side of the reference's last motion
  Number take_up_time = 0.0;  ///< s, ≥ 0: a lag of half_gap
  Number lead = 0.0;          ///< s: lead · w is added to the reference
  Number inertia = 0.0;       ///< N m s²/rad: torque per acceleration

  bool is_absent() const {
    return torque == 0.0 && half_gap == 0.0 && lead == 0.0 && inertia == 0.0;
  }

  static constexpr auto members() {
    return std::make_tuple(&FeedforwardOf::torque, &FeedforwardOf::speed, &FeedforwardOf::half_gap,
                           &FeedforwardOf::take_up_time, &FeedforwardOf::lead,
                           &FeedforwardOf::inertia);
  }
};
using Feedforward = FeedforwardOf<double>;

/// The weight of the load, linearised: the torque −stiffness (θ_L − angle) beside the one that it
/// has at `angle`, which is part of the load torque.
template <class Number>
struct GravityOf {
  Number torque = 0.0;     ///< N m, at `angle`; part of ReducedDrive::load_torque
  Number stiffness = 0.0;  ///< N m/rad; negative where the load would tip over
  Number angle = 0.0;      ///< rad

  bool is_absent() const { return torque == 0.0 && stiffness == 0.0; }

  static constexpr auto members() {
    return std::make_tuple(&GravityOf::torque, &GravityOf::stiffness, &GravityOf::angle);
  }
};
using Gravity = GravityOf<double>;

/// Rigid faces: impacts.
template <class Number>
struct RigidContactOf {
  Number restitution = 0.0;  ///< 0 … 1

  static constexpr auto members() { return std::make_tuple(&RigidContactOf::restitution); }
};
using RigidContact = RigidContactOf<double>;

/// Compliant faces: torque stiffness · δ + damping · δ̇, where δ is the compression. Without a gap
/// they are joined: stiffness · u + damping · u̇ in both directions, where u is the motor less the
/// load, by either law.
template <class Number>
struct CompliantContactOf {
  Number stiffness = 0.0;  ///< N m/rad, > 0
  Number damping = 0.0;    ///< N m s/rad, ≥ 0
  ContactDamping law = ContactDamping::limited;

  static constexpr auto members() {
    return std::make_tuple(&CompliantContactOf::stiffness, &CompliantContactOf::damping,
                           &CompliantContactOf::law);
  }
};
using CompliantContact = CompliantContactOf<double>;

template <class Number>
using ContactOf = std::variant<RigidContactOf<Number>, CompliantContactOf<Number>>;
using Contact = ContactOf<double>;

/// The position that the controller receives: load_share θ_L + (1 − load_share) θ_M. Likewise the
/// speed.
template <class Number>
struct SensingOf {
  double load_share_of_position = 1.0;  ///< 0 … 1
  double load_share_of_speed = 0.0;     ///< 0 … 1
  /// Encoders read positions to whole multiples of these, halves away from 0.
  Number resolution = 0.0;           ///< rad, ≥ 0
  Number resolution_of_speed = 0.0;  ///< rad, ≥ 0; for the position whose differences are the speed

  bool reads_steps() const { return resolution > 0.0 || resolution_of_speed > 0.0; }

  static constexpr auto members() {
    return std::make_tuple(&SensingOf::load_share_of_position, &SensingOf::load_share_of_speed,
                           &SensingOf::resolution, &SensingOf::resolution_of_speed);
  }
};
using Sensing = SensingOf<double>;

/// The input of simulation and search, made from a gearlash::Drive by reduce().
template <class Number>
struct ReducedDriveOf {
  ShaftOf<Number> motor{};
  ShaftOf<Number> load{};
  Number backlash = 0.0;  ///< rad, face to face; > 0, or 0 with compliant faces
  ContactOf<Number> contact{};
  SensingOf<Number> sensing{};
  LinearControllerOf<Number> controller{};
  ErrorShapeOf<Number> error_shape{};
  FeedforwardOf<Number> feedforward{};
  /// Of the requested torque, before the winding. N m, > 0.
  Number torque_limit = std::numeric_limits<double>::infinity();
  WindingOf<Number> winding{};
  std::optional<Sampling> sampling{};  ///< without it the controller is continuous
  Signal reference{};                  ///< rad
  Signal load_torque{};                ///< N m, on the load, forward
  GravityOf<Number> gravity{};
  /// Numbers in the controller's lists stand for others: see gearlash::Drive::is_rounded. That two
  /// of them are equal is then not known; 0 is exact.
  bool has_rounded_lists = false;

  static constexpr auto members() {
    return std::make_tuple(
        &ReducedDriveOf::motor, &ReducedDriveOf::load, &ReducedDriveOf::backlash,
        &ReducedDriveOf::contact, &ReducedDriveOf::sensing, &ReducedDriveOf::controller,
        &ReducedDriveOf::error_shape, &ReducedDriveOf::feedforward, &ReducedDriveOf::torque_limit,
        &ReducedDriveOf::winding, &ReducedDriveOf::sampling, &ReducedDriveOf::reference,
        &ReducedDriveOf::load_torque, &ReducedDriveOf::gravity, &ReducedDriveOf::has_rounded_lists);
  }
};
using ReducedDrive = ReducedDriveOf<double>;

/// The controller as it runs: that of a sampled drive from sample to sample. Precondition: sound.
inline LinearController running_controller(const ReducedDrive& drive) {
  return drive.sampling ? sampled_controller(drive.controller, *drive.sampling) : drive.controller;
}

/// Whether the controller works with an error that it has read before, at a tick of its own.
inline bool keeps_error(const ReducedDrive& drive) {
  return drive.sampling && (drive.error_shape.is_present() || position_ticks(*drive.sampling) > 1);
}

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
/// left aside: its controller is linear, and adds nothing because of its reference's motion.
inline bool has_linear_control(const ReducedDrive& drive) {
  return !drive.error_shape.is_present() && drive.feedforward.is_absent();
}

/// Whether a sine reference or load torque drives the oscillation, which then is not hunting.
bool is_driven(const ReducedDrive& drive);

/// What forbids to simulate the drive that a sound gearlash::Drive was reduced to. Its single
/// numbers are in the ranges above by those of that drive.
std::vector<Fault> faults(const ReducedDrive& drive);

}  // namespace gearlash::drive
