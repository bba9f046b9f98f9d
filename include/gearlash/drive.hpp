// A geared drive as its user has it: each number at its own shaft, in SI units.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gearlash/controller.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/signal.hpp"

namespace gearlash {

/// Direct current, fed through the armature.
struct ArmatureControl {
  double torque_constant = 0.0;    ///< K₁, N m/A, > 0
  double back_emf_constant = 0.0;  ///< K₂, V s/rad, ≥ 0
  double resistance = 0.0;         ///< Ω, > 0
  /// L, H, ≥ 0. The current follows the voltage with the time constant L/resistance; 0: at once.
  double inductance = 0.0;

  bool operator==(const ArmatureControl&) const = default;
};

/// Direct current, fed through the field, whose time constant is negligible.
struct FieldControl {
  double torque_constant = 0.0;  ///< K₁, N m per ampere of field current, > 0
  double resistance = 0.0;       ///< Ω, > 0

  bool operator==(const FieldControl&) const = default;
};

/// Two-phase induction servo motor, described by the slopes of its characteristic curves.
struct TwoPhase {
  double torque_per_volt = 0.0;   ///< K_e = ∂T/∂e, N m/V, > 0
  double torque_per_speed = 0.0;  ///< K_N = −∂T/∂n, N m s/rad, ≥ 0

  bool operator==(const TwoPhase&) const = default;
};

/// An amplifier controls the current: the controller's output is the torque.
struct TorqueControl {
  /// N m/A, > 0. It turns currents of the motor into torques.
  std::optional<double> torque_constant{};
  /// rad/s, > 0, of the closed loop of the current, whose response is a lag of the first order:
  /// 1/(s/current_bandwidth + 1). The torque follows at once if not given.
  std::optional<double> current_bandwidth{};

  bool operator==(const TorqueControl&) const = default;
};

using MotorKind = std::variant<TorqueControl, ArmatureControl, FieldControl, TwoPhase>;

/// Torque against the motion: viscous ω + coulomb sign ω. At rest, up to `breakaway`. With a
/// `stribeck_speed` the dry part falls in proportion to the speed, from breakaway at rest to
/// coulomb at this speed and beyond; without, it falls at once.
struct Friction {
  double viscous = 0.0;               ///< N m s/rad, ≥ 0
  double coulomb = 0.0;               ///< N m, ≥ 0
  std::optional<double> breakaway{};  ///< N m, ≥ coulomb; coulomb if not given
  double stribeck_speed = 0.0;        ///< rad/s, ≥ 0

  bool operator==(const Friction&) const = default;
};

struct Motor {
  MotorKind kind{};      ///< what turns the controller's output into torque
  double inertia = 0.0;  ///< kg m², ≥ 0
  Friction friction{};   ///< at its own shaft
  /// Limit of the controller's output, > 0: N m for a torque-controlled motor, else V. None: no
  /// limit.
  std::optional<double> limit{};
  /// A, ≥ 0, of a motor with direct current through its armature. It replaces friction.coulomb: see
  /// coulomb_torque().
  std::optional<double> no_load_current{};
  /// A, > 0. Of a torque-controlled motor with a torque constant it replaces `limit`: see
  /// output_limit(). Of a motor with direct current through its armature or field it stands beside
  /// the voltage's limit: the amplifier withholds the voltage that would exceed it.
  std::optional<double> current_limit{};

  bool operator==(const Motor&) const = default;
};

struct Gearbox {
  double ratio = 1.0;     ///< motor turns per load turn, > 0
  double backlash = 0.0;  ///< rad at the load's shaft, face to face, ≥ 0
  double inertia = 0.0;   ///< kg m² at the motor's shaft, ≥ 0: added to the motor's
  /// 0 … 1, as printed. Not modelled: losses in proportion to the transmitted torque are left out,
  /// which every answer notes.
  std::optional<double> efficiency{};

  bool operator==(const Gearbox&) const = default;
};

struct Load {
  double inertia = 0.0;  ///< kg m², ≥ 0
  Friction friction{};   ///< at its own shaft
  /// m g l of the load: the torque of its weight while its centre of mass is level with its axis,
  /// N m. It pulls backward, by −gravity · cos(angle above the horizontal).
  double gravity = 0.0;
  double gravity_angle = 0.0;  ///< rad above the horizontal at position 0

  bool operator==(const Load&) const = default;
};

/// Rigid faces: impacts.
struct RigidContact {
  double restitution = 0.0;  ///< 0 (plastic) … 1 (elastic)

  bool operator==(const RigidContact&) const = default;
};

/// How the damping of compliant faces acts. Neither law ever pulls.
enum class ContactDamping : std::uint8_t {
  /// Modelica's ElastoBacklash: at most the spring's own torque while the faces close, so that the
  /// torque does not jump as they meet.
  limited,
  /// Modelica's ElastoBacklash2: from the first touch on.
  full
};

/// Compliant faces: torque stiffness · δ + damping · δ̇, where δ is the compression.
struct CompliantContact {
  double stiffness = 0.0;                        ///< N m/rad at the load's shaft, > 0
  double damping = 0.0;                          ///< N m s/rad at the load's shaft, ≥ 0
  ContactDamping law = ContactDamping::limited;  ///< how the damping acts

  bool operator==(const CompliantContact&) const = default;
};

using Contact = std::variant<RigidContact, CompliantContact>;

/// An encoder: its counts per turn of its own shaft, or the angle of one count. Exact if neither is
/// given. Positions are read to the nearest count, halves away from 0.
struct Encoder {
  std::optional<double> counts_per_turn{};  ///< > 0
  std::optional<double> resolution{};       ///< rad at its own shaft, ≥ 0

  bool operator==(const Encoder&) const = default;
};

/// Which shafts are measured.
enum class SensorPlace : std::uint8_t {
  load,
  motor,
  both  ///< the load's position and the motor's speed
};

struct Sensor {
  SensorPlace position = SensorPlace::load;  ///< the shaft whose position is fed back
  std::optional<ShaftName> speed{};  ///< the position's shaft if not given; the motor with `both`
  Encoder encoder{};                 ///< of the position
  Encoder speed_encoder{};  ///< its differences are the speed; `encoder` if on the same shaft
  /// The position's place is not given but assumed: of a joint in the words of robots' simulators.
  bool is_assumed = false;

  bool operator==(const Sensor&) const = default;
};

/// What is asked of a drive. It changes no motion.
struct Specification {
  std::optional<double> error{};  ///< rad, > 0: the largest |reference − load| in the end
  std::optional<double> step{};   ///< rad, not 0: of the step response; 1° if not given
  /// rad, > 0: within which a motion has settled, about the reference after a step, about its final
  /// position at rest. If not given: `error`; else one step of the position's encoder, at the
  /// load's shaft; else 1 % of the step.
  std::optional<double> band{};

  bool operator==(const Specification&) const = default;
};

/// The servo reduced to the numbers that decide whether it hunts: proportional control of the
/// load's position. It replaces motor, gearbox, load and controller, with J_M + J_L = 1 kg m².
struct NormalForm {
  double damping = 0.0;         ///< ζ, 0 or 1e-15 … 1000
  double inertia_ratio = 1.0;   ///< J_L/J_M; 0, 1e-9 … 1e9, or infinity (a massless motor)
  double friction_ratio = 0.5;  ///< F_L/(F_M + F_L), 0 … 1
  double backlash = 0.0;        ///< rad at the load's shaft, face to face, 0 or 1e-15 … 1e6
  std::optional<double> natural_frequency{};  ///< ω_n, rad/s, > 0; 1 rad/s if not given

  bool operator==(const NormalForm&) const = default;
};

/// The author's unit of angles, which text and pictures of a drive have.
struct AngleUnit {
  std::string name = "rad";  ///< as written: "arcmin", "deg", "mrad", …
  double radians = 1.0;      ///< the unit in radians, > 0

  /// `angle` (rad) in this unit.
  double from_radians(double angle) const { return angle / radians; }

  /// Always, so that drives of equal numbers are equal: a unit changes no motion and no answer.
  bool operator==(const AngleUnit&) const { return true; }
};

/// One drive. The same type is read from files, set by path, varied, analysed and written.
struct Drive {
  std::optional<NormalForm> servo{};  ///< if given, it replaces motor, gearbox, load and controller
  Motor motor{};                      ///< drives the gearbox
  Gearbox gearbox{};                  ///< has the gap
  Load load{};                        ///< what is moved
  Contact contact{};                  ///< of the faces
  Sensor sensor{};                    ///< what the controller reads
  Controller controller{};            ///< gives the motor's torque or voltage
  std::optional<Sampling> sampling{};   ///< without it the controller is continuous
  std::optional<Signal> reference{};    ///< rad; 0 if not given
  std::optional<Signal> load_torque{};  ///< N m, on the load, forward; 0 if not given
  Specification specification{};        ///< what is asked of it
  /// Numbers of the normal form, or of a controller's lists, stand for others that they were
  /// rounded from: decimals with more digits than a double keeps, fractions without a short
  /// decimal, results of a computation. Proofs then hold for all numbers nearby. Else each stands
  /// for the shortest decimal that reads back as it. Readers set it where a drive has such numbers.
  bool is_rounded = false;
  AngleUnit angle_unit{};  ///< readers of files set it to the unit of the backlash

  bool operator==(const Drive&) const = default;
};

/// Every value outside its permitted range, and every violated rule between values. Empty for a
/// sound drive.
[[nodiscard]] std::vector<Fault> faults(const Drive& drive);

/// Whether the drive is a normal form without a natural frequency: ω_n is then 1 rad/s, and text
/// has times in units of 1/ω_n.
[[nodiscard]] bool is_normalized(const Drive& drive);

/// The servo with ω_n = 1 rad/s, K = 1 N m/rad and J_M + J_L = 1 kg m²; see NormalForm.
[[nodiscard]] Drive normal_form(double damping, double inertia_ratio, double friction_ratio,
                                double backlash = 1.0, double restitution = 0.0);

}  // namespace gearlash
