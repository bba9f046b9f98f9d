// Parameters of the servo in the normal form, the motor, the gearbox, the load and the contact.
#include "model/parameter_list.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::parameter_rows {
namespace {

// ---- servo --------------------------------------------------------------------------------------

template <auto member>
constexpr Place in_servo = at<&Drive::servo, member>;

std::vector<Parameter> servo_parameters() {
  return {entry("servo.damping", in_servo<&NormalForm::damping>,
                "damping ratio (F_M + F_L)/(2 ω_n (J_M + J_L))", of_normal_form, required,
                UsualRange{0.01, 2.0}),
          entry("servo.inertia_ratio", in_servo<&NormalForm::inertia_ratio>,
                "inertia of the load over that of the motor, both at the load's shaft",
                of_normal_form, required, UsualRange{0.05, 20.0}),
          entry("servo.friction_ratio", in_servo<&NormalForm::friction_ratio>,
                "friction of the load over that of both shafts", of_normal_form, required,
                UsualRange{0.0, 1.0, false}),
          entry("servo.backlash", in_servo<&NormalForm::backlash>,
                "backlash at the load's shaft, from face to face", unit<angle>, of_normal_form,
                required, UsualRange{1e-4, 1.0}),
          entry("servo.natural_frequency", in_servo<&NormalForm::natural_frequency>,
                "undamped natural frequency √(K/(J_M + J_L)); 1 rad/s if left out",
                unit<angular_frequency>, positive, UsualRange{0.1, 1000.0})};
}

// ---- motor --------------------------------------------------------------------------------------

template <Condition condition, auto... members>
constexpr Place in_motor_if = only_if<condition, at<&Drive::motor, members...>>;
template <auto... members>
constexpr Place in_motor = in_motor_if<is_plant, members...>;
template <auto member>
constexpr Place in_motor_kind = in_motor<&Motor::kind, member>;
template <auto member>
constexpr Place in_motor_friction = in_motor<&Motor::friction, member>;

/// In the order of the words.
constexpr Place motor_kind =
    only_if<is_plant, alternative_at<std::array{1U, 2U, 3U, 0U}, &Drive::motor, &Motor::kind>>;

bool has_voltage(const Drive& drive) {
  return is_plant(drive) && !std::holds_alternative<TorqueControl>(drive.motor.kind);
}

/// Whether the motor's no-load current gives its dry friction.
bool is_given_by_current(const Drive& drive) {
  return drive.motor.no_load_current && takes_no_load_current(drive.motor);
}

bool may_have_dry_friction(const Drive& drive) {
  return is_plant(drive) && !is_given_by_current(drive);
}

bool may_have_no_load_current(const Drive& drive) {
  const bool is_free = drive.motor.friction.coulomb == 0.0 || is_given_by_current(drive);
  return is_plant(drive) && is_free && takes_no_load_current(drive.motor);
}

bool may_have_torque_limit(const Drive& drive) {
  const bool is_by_current = drive.motor.current_limit && limits_torque_by_current(drive.motor);
  return is_plant(drive) && !has_voltage(drive) && !is_by_current;
}

bool may_have_current_limit(const Drive& drive) {
  const bool is_free =
      !limits_torque_by_current(drive.motor) || !drive.motor.limit || drive.motor.current_limit;
  return is_plant(drive) && is_free && takes_current_limit(drive.motor);
}

constexpr RefusedWord not_a_kind(std::string_view word) {
  return {word,
          "must be \"torque-controlled\" where an amplifier controls the current, as servo drives "
          "do; or \"brushed-dc\" where a voltage drives it"};
}

/// Each kind of motor has constants of its own.
std::vector<Parameter> motor_parameters() {
  return {entry("motor.kind", motor_kind,
                "kind of motor: the controller outputs volts to a winding, or torque",
                Words{"armature-controlled", "field-controlled", "two-phase", "torque-controlled"},
                OtherWord{"brushed-dc", 0}, not_a_kind("bldc"), not_a_kind("BLDC"),
                not_a_kind("pmsm"), not_a_kind("PMSM"), not_a_kind("brushless"),
                not_a_kind("servo"), not_a_kind("stepper"), not_a_kind("dc"), required),
          entry("motor.inertia", in_motor<&Motor::inertia>,
                "moment of inertia of the rotor, at its own shaft", unit<inertia>, not_negative,
                required, OtherForm{"joint.armature"}, UsualRange{1e-8, 1e-1}),
          entry("motor.friction", in_motor_friction<&Friction::viscous>,
                "viscous friction of the motor, without its back-EMF", unit<torque_per_speed>,
                not_negative, required, OtherForm{"joint.damping"}, UsualRange{1e-8, 1e-1}),
          entry("motor.torque_constant",
                first_of<in_motor_kind<&ArmatureControl::torque_constant>,
                         in_motor_kind<&FieldControl::torque_constant>>,
                "torque per current, of the armature or of the field", unit<torque_per_current>,
                positive, required, UsualRange{1e-3, 10.0}),
          entry("motor.torque_constant", in_motor_kind<&TorqueControl::torque_constant>,
                "torque per current, which turns currents of the motor into torques",
                unit<torque_per_current>, positive, UsualRange{1e-3, 10.0}),
          entry("motor.current_bandwidth", in_motor_kind<&TorqueControl::current_bandwidth>,
                "bandwidth of the current's control: its lag of the first order delays the torque; "
                "none: the torque follows at once",
                unit<angular_frequency>, positive, UsualRange{100.0, 1e5}),
          entry("motor.back_emf_constant", in_motor_kind<&ArmatureControl::back_emf_constant>,
                "voltage per speed", unit<voltage_per_speed>, not_negative, required,
                OtherForm{"motor.speed_constant", Relation::reciprocal, &speed_per_voltage},
                UsualRange{1e-3, 10.0}),
          entry("motor.resistance",
                first_of<in_motor_kind<&ArmatureControl::resistance>,
                         in_motor_kind<&FieldControl::resistance>>,
                "resistance of the controlled winding", unit<resistance>, positive, required,
                UsualRange{0.01, 1000.0}),
          entry("motor.inductance", in_motor_kind<&ArmatureControl::inductance>,
                "inductance of the armature; 0: the current follows the voltage at once",
                unit<inductance>, not_negative, UsualRange{1e-6, 1.0}),
          entry("motor.torque_per_volt", in_motor_kind<&TwoPhase::torque_per_volt>,
                "slope of torque over voltage", unit<torque_per_voltage>, positive, required,
                UsualRange{1e-4, 1.0}),
          entry("motor.torque_per_speed", in_motor_kind<&TwoPhase::torque_per_speed>,
                "slope of torque over speed, taken positive", unit<torque_per_speed>, not_negative,
                required, UsualRange{1e-7, 1e-1})};
}

std::vector<Parameter> motor_frictions_and_limits() {
  return {
      entry("motor.coulomb",
            in_motor_if<may_have_dry_friction, &Motor::friction, &Friction::coulomb>,
            "dry friction of the motor while it moves", unit<torque>, not_negative,
            OtherForm{"joint.frictionloss"}, UsualRange{1e-5, 1.0}),
      entry("motor.no_load_current", in_motor_if<may_have_no_load_current, &Motor::no_load_current>,
            "current without load; times the torque constant it is the dry friction", unit<current>,
            not_negative, UsualRange{1e-3, 10.0}),
      entry("motor.breakaway", in_motor_friction<&Friction::breakaway>,
            "torque that moves the motor from rest, at least its dry friction", unit<torque>,
            not_negative, DefaultOf{"motor.coulomb"}, UsualRange{1e-5, 1.0}),
      entry("motor.stribeck_speed", in_motor_friction<&Friction::stribeck_speed>,
            "speed over which the dry friction falls from breakaway to coulomb; 0: at once",
            unit<angular_speed>, not_negative, UsualRange{1e-2, 100.0}),
      entry("motor.voltage_limit", in_motor_if<has_voltage, &Motor::limit>,
            "the largest voltage that the controller can give", unit<voltage>, positive,
            UsualRange{1.0, 1000.0}),
      entry("motor.torque_limit", in_motor_if<may_have_torque_limit, &Motor::limit>,
            "the largest torque that the motor can give, at its own shaft", unit<torque>, positive,
            OtherForm{"actuator.forcerange"}, UsualRange{1e-3, 1000.0}),
      entry("motor.current_limit", in_motor_if<may_have_current_limit, &Motor::current_limit>,
            "the largest current, of the armature or field; times the torque constant it is the "
            "torque limit",
            unit<current>, positive, UsualRange{0.1, 100.0})};
}

// ---- gearbox, load, contact ---------------------------------------------------------------------

template <auto member>
constexpr Place in_gearbox = only_if<is_plant, at<&Drive::gearbox, member>>;
template <auto... members>
constexpr Place in_load = only_if<is_plant, at<&Drive::load, members...>>;
template <auto member>
constexpr Place in_load_friction = in_load<&Load::friction, member>;
template <auto member>
constexpr Place in_contact = at<&Drive::contact, member>;

std::vector<Parameter> gearbox_and_load() {
  return {
      entry("gearbox.ratio", in_gearbox<&Gearbox::ratio>, "motor turns per load turn", positive,
            required, Wanted{"positive, motor turns per load turn"}, UsualRange{1.0, 1000.0}),
      entry("gearbox.backlash", in_gearbox<&Gearbox::backlash>,
            "backlash at the load's shaft, from face to face", unit<angle>, not_negative, required,
            OtherForm{"joint.backlash"}, UsualRange{1e-5, 0.1}),
      entry("gearbox.inertia", in_gearbox<&Gearbox::inertia>,
            "moment of inertia of the gears, at the motor's shaft", unit<inertia>, not_negative,
            UsualRange{1e-9, 1e-2}),
      entry("gearbox.efficiency", in_gearbox<&Gearbox::efficiency>,
            "efficiency as printed; not modelled, which every answer notes", share,
            Wanted{"a number from 0 to 1, or in percent"}, UsualRange{0.3, 1.0, false}),

      entry("load.inertia", in_load<&Load::inertia>, "moment of inertia of the load", unit<inertia>,
            not_negative, required, UsualRange{1e-6, 1e4}),
      entry("load.friction", in_load_friction<&Friction::viscous>, "viscous friction of the load",
            unit<torque_per_speed>, not_negative, required, UsualRange{1e-6, 1e3}),
      entry("load.coulomb", in_load_friction<&Friction::coulomb>,
            "dry friction of the load while it moves", unit<torque>, not_negative,
            UsualRange{1e-4, 100.0}),
      entry("load.breakaway", in_load_friction<&Friction::breakaway>,
            "torque that moves the load from rest, at least its dry friction", unit<torque>,
            not_negative, DefaultOf{"load.coulomb"}, UsualRange{1e-4, 100.0}),
      entry("load.stribeck_speed", in_load_friction<&Friction::stribeck_speed>,
            "speed over which the dry friction falls from breakaway to coulomb; 0: at once",
            unit<angular_speed>, not_negative, UsualRange{1e-4, 1.0}),
      entry("load.gravity", in_load<&Load::gravity>,
            "torque of the load's weight while its center of mass is level with its axis",
            unit<torque>, UsualRange{1e-3, 1e3}),
      entry("load.gravity_angle", in_load<&Load::gravity_angle>,
            "angle of the load's center of mass above the horizontal at position 0", unit<angle>,
            UsualRange{-1.5, 1.5, false})};
}

std::vector<Parameter> contact_parameters() {
  return {entry("contact.kind", alternative_at<std::array{0U, 1U}, &Drive::contact>,
                "whether the faces are rigid or compliant", Words{"rigid", "compliant"}),
          entry("contact.restitution", in_contact<&RigidContact::restitution>,
                "coefficient of restitution: 0 plastic, 1 elastic", share,
                UsualRange{0.0, 0.95, false}),
          entry("contact.stiffness", in_contact<&CompliantContact::stiffness>,
                "stiffness of the faces, at the load's shaft", unit<torque_per_angle>, positive,
                required, OtherForm{"gearbox.torsional_stiffness"}, UsualRange{1.0, 1e6}),
          entry("contact.damping", in_contact<&CompliantContact::damping>,
                "damping of the faces, at the load's shaft", unit<torque_per_speed>, not_negative,
                UsualRange{1e-3, 1e4}),
          entry("contact.law", in_contact<&CompliantContact::law>,
                "law of the damping of the faces, as in Modelica",
                Words{"ElastoBacklash", "ElastoBacklash2"})};
}

}  // namespace

std::vector<Parameter> mechanical_parameters() {
  return joined({&servo_parameters, &motor_parameters, &motor_frictions_and_limits,
                 &gearbox_and_load, &contact_parameters});
}

}  // namespace gearlash::parameter_rows
