#include <limits>

#include "model/parameter_list.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

using namespace dimensions;

bool has_voltage(const Drive& drive) {
  return !drive.servo && !std::holds_alternative<TorqueControl>(drive.motor.kind);
}

const Dimension* limit_dimension(const Drive& drive) {
  return has_voltage(drive) ? &voltage : &torque;
}

/// Whether the motor's no-load current gives its dry friction.
bool is_given_by_current(const Drive& drive) {
  return drive.motor.no_load_current && takes_no_load_current(drive.motor);
}

/// A slot that a drive in the normal form does not have.
template <class Member>
Slot of_plant(Drive& drive, Member& member) {
  return drive.servo ? Slot{} : Slot{&member};
}

std::vector<Parameter> servo_parameters() {
  return {{.path = "servo.damping",
           .slot = [](Drive& d) { return slot_of(d.servo, &NormalForm::damping); },
           .meaning = "damping ratio (F_M + F_L)/(2 ω_n (J_M + J_L))",
           .permitted = Permitted::of_normal_form,
           .is_required = true,
           .usual = {0.01, 2.0}},
          {.path = "servo.inertia_ratio",
           .slot = [](Drive& d) { return slot_of(d.servo, &NormalForm::inertia_ratio); },
           .meaning = "inertia of the load over that of the motor, both at the load's shaft",
           .permitted = Permitted::of_normal_form,
           .is_required = true,
           .usual = {0.05, 20.0}},
          {.path = "servo.friction_ratio",
           .slot = [](Drive& d) { return slot_of(d.servo, &NormalForm::friction_ratio); },
           .meaning = "friction of the load over that of both shafts",
           .permitted = Permitted::of_normal_form,
           .is_required = true,
           .usual = {0.0, 1.0, false}},
          {.path = "servo.backlash",
           .slot = [](Drive& d) { return slot_of(d.servo, &NormalForm::backlash); },
           .dimension = &always<angle>,
           .meaning = "backlash at the load's shaft, from face to face",
           .permitted = Permitted::of_normal_form,
           .is_required = true,
           .usual = {1e-4, 1.0}},
          {.path = "servo.natural_frequency",
           .slot = [](Drive& d) { return slot_of(d.servo, &NormalForm::natural_frequency); },
           .dimension = &always<angular_frequency>,
           .meaning = "undamped natural frequency √(K/(J_M + J_L)); 1 rad/s if left out",
           .permitted = Permitted::positive,
           .usual = {0.1, 1000.0}}};
}

/// All kinds of motors have a friction and an inertia; each has constants of its own.
std::vector<Parameter> motor_constants() {
  return {{.path = "motor.torque_constant",
           .slot =
               [](Drive& d) {
                 if (d.servo) return Slot{};
                 const Slot armature = slot_of(d.motor.kind, &ArmatureControl::torque_constant);
                 return std::holds_alternative<std::monostate>(armature)
                            ? slot_of(d.motor.kind, &FieldControl::torque_constant)
                            : armature;
               },
           .dimension = &always<torque_per_current>,
           .meaning = "torque per current, of the armature or of the field",
           .permitted = Permitted::positive,
           .is_required = true,
           .usual = {1e-3, 10.0}},
          {.path = "motor.torque_constant",
           .slot =
               [](Drive& d) {
                 return d.servo ? Slot{} : slot_of(d.motor.kind, &TorqueControl::torque_constant);
               },
           .dimension = &always<torque_per_current>,
           .meaning = "torque per current, which turns currents of the motor into torques",
           .permitted = Permitted::positive,
           .usual = {1e-3, 10.0}},
          {.path = "motor.back_emf_constant",
           .slot =
               [](Drive& d) {
                 return d.servo ? Slot{}
                                : slot_of(d.motor.kind, &ArmatureControl::back_emf_constant);
               },
           .dimension = &always<voltage_per_speed>,
           .meaning = "voltage per speed",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .other_forms = {{"motor.speed_constant", &speed_per_voltage}},
           .usual = {1e-3, 10.0}},
          {.path = "motor.resistance",
           .slot =
               [](Drive& d) {
                 if (d.servo) return Slot{};
                 const Slot armature = slot_of(d.motor.kind, &ArmatureControl::resistance);
                 return std::holds_alternative<std::monostate>(armature)
                            ? slot_of(d.motor.kind, &FieldControl::resistance)
                            : armature;
               },
           .dimension = &always<resistance>,
           .meaning = "resistance of the controlled winding",
           .permitted = Permitted::positive,
           .is_required = true,
           .usual = {0.01, 1000.0}},
          {.path = "motor.inductance",
           .slot =
               [](Drive& d) {
                 return d.servo ? Slot{} : slot_of(d.motor.kind, &ArmatureControl::inductance);
               },
           .dimension = &always<inductance>,
           .meaning = "inductance of the armature; 0: the current follows the voltage at once",
           .permitted = Permitted::not_negative,
           .usual = {1e-6, 1.0}}};
}

std::vector<Parameter> two_phase_constants() {
  return {{.path = "motor.torque_per_volt",
           .slot =
               [](Drive& d) {
                 return d.servo ? Slot{} : slot_of(d.motor.kind, &TwoPhase::torque_per_volt);
               },
           .dimension = &always<torque_per_voltage>,
           .meaning = "slope of torque over voltage",
           .permitted = Permitted::positive,
           .is_required = true,
           .usual = {1e-4, 1.0}},
          {.path = "motor.torque_per_speed",
           .slot =
               [](Drive& d) {
                 return d.servo ? Slot{} : slot_of(d.motor.kind, &TwoPhase::torque_per_speed);
               },
           .dimension = &always<torque_per_speed>,
           .meaning = "slope of torque over speed, taken positive",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .usual = {1e-7, 1e-1}}};
}

Parameter motor_kind() {
  return {.path = "motor.kind",
          .slot =
              [](Drive& d) {
                if (d.servo) return Slot{};
                return Slot{Choice{[](const Drive& drive) {
                                     constexpr std::size_t order[] = {3, 0, 1, 2};
                                     return order[drive.motor.kind.index()];
                                   },
                                   [](Drive& drive, std::size_t choice) {
                                     MotorKind& kind = drive.motor.kind;
                                     if (choice == 0) kind = ArmatureControl{};
                                     if (choice == 1) kind = FieldControl{};
                                     if (choice == 2) kind = TwoPhase{};
                                     if (choice == 3) kind = TorqueControl{};
                                   }}};
              },
          .meaning = "kind of motor: the controller outputs volts to a winding, or torque",
          .is_required = true,
          .choices = {"armature-controlled", "field-controlled", "two-phase", "torque-controlled"},
          .other_words = {{"brushed-dc", 0}}};
}

std::vector<Parameter> rotor_parameters() {
  return {motor_kind(),
          {.path = "motor.inertia",
           .slot = [](Drive& d) { return of_plant(d, d.motor.inertia); },
           .dimension = &always<inertia>,
           .meaning = "moment of inertia of the rotor, at its own shaft",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .other_forms = {{"joint.armature"}},
           .usual = {1e-8, 1e-1}},
          {.path = "motor.friction",
           .slot = [](Drive& d) { return of_plant(d, d.motor.friction.viscous); },
           .dimension = &always<torque_per_speed>,
           .meaning = "viscous friction of the motor, without its back-EMF",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .other_forms = {{"joint.damping"}},
           .usual = {1e-8, 1e-1}}};
}

std::vector<Parameter> motor_dry_friction() {
  return {
      {.path = "motor.coulomb",
       .slot =
           [](Drive& d) {
             return is_given_by_current(d) ? Slot{} : of_plant(d, d.motor.friction.coulomb);
           },
       .dimension = &always<torque>,
       .meaning = "dry friction of the motor while it moves",
       .permitted = Permitted::not_negative,
       .other_forms = {{"joint.frictionloss"}},
       .usual = {1e-5, 1.0}},
      {.path = "motor.no_load_current",
       .slot =
           [](Drive& d) {
             const bool is_free = d.motor.friction.coulomb == 0.0 || is_given_by_current(d);
             return !d.servo && is_free && takes_no_load_current(d.motor)
                        ? Slot{&d.motor.no_load_current}
                        : Slot{};
           },
       .dimension = &always<current>,
       .meaning = "current without load; times the torque constant it is the dry friction",
       .permitted = Permitted::not_negative,
       .usual = {1e-3, 10.0}},
      {.path = "motor.breakaway",
       .slot = [](Drive& d) { return of_plant(d, d.motor.friction.breakaway); },
       .dimension = &always<torque>,
       .meaning = "torque that moves the motor from rest, at least its dry friction",
       .permitted = Permitted::not_negative,
       .otherwise = "motor.coulomb",
       .usual = {1e-5, 1.0}},
      {.path = "motor.stribeck_speed",
       .slot = [](Drive& d) { return of_plant(d, d.motor.friction.stribeck_speed); },
       .dimension = &always<angular_speed>,
       .meaning = "speed over which the dry friction falls from breakaway to coulomb; 0: at once",
       .permitted = Permitted::not_negative,
       .usual = {1e-2, 100.0}}};
}

std::vector<Parameter> motor_limits() {
  return {
      {.path = "motor.voltage_limit",
       .slot = [](Drive& d) { return has_voltage(d) ? Slot{&d.motor.limit} : Slot{}; },
       .dimension = &limit_dimension,
       .meaning = "the largest voltage that the controller can give",
       .permitted = Permitted::positive,
       .usual = {1.0, 1000.0}},
      {.path = "motor.torque_limit",
       .slot =
           [](Drive& d) {
             const bool is_by_current = d.motor.current_limit && limits_torque_by_current(d.motor);
             return d.servo || has_voltage(d) || is_by_current ? Slot{} : Slot{&d.motor.limit};
           },
       .dimension = &limit_dimension,
       .meaning = "the largest torque that the motor can give, at its own shaft",
       .permitted = Permitted::positive,
       .other_forms = {{"actuator.forcerange"}},
       .usual = {1e-3, 1000.0}},
      {.path = "motor.current_limit",
       .slot =
           [](Drive& d) {
             const bool is_free =
                 !limits_torque_by_current(d.motor) || !d.motor.limit || d.motor.current_limit;
             return !d.servo && is_free && takes_current_limit(d.motor)
                        ? Slot{&d.motor.current_limit}
                        : Slot{};
           },
       .dimension = &always<current>,
       .meaning = "the largest current, of the armature or field; times the torque constant it is "
                  "the torque limit",
       .permitted = Permitted::positive,
       .usual = {0.1, 100.0}}};
}

std::vector<Parameter> gearbox_parameters() {
  return {{.path = "gearbox.ratio",
           .slot = [](Drive& d) { return of_plant(d, d.gearbox.ratio); },
           .meaning = "motor turns per load turn",
           .permitted = Permitted::positive,
           .is_required = true,
           .wanted = "positive, motor turns per load turn",
           .usual = {1.0, 1000.0}},
          {.path = "gearbox.backlash",
           .slot = [](Drive& d) { return of_plant(d, d.gearbox.backlash); },
           .dimension = &always<angle>,
           .meaning = "backlash at the load's shaft, from face to face",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .other_forms = {{"joint.backlash"}},
           .usual = {1e-5, 0.1}},
          {.path = "gearbox.inertia",
           .slot = [](Drive& d) { return of_plant(d, d.gearbox.inertia); },
           .dimension = &always<inertia>,
           .meaning = "moment of inertia of the gears, at the motor's shaft",
           .permitted = Permitted::not_negative,
           .usual = {1e-9, 1e-2}},
          {.path = "gearbox.efficiency",
           .slot = [](Drive& d) { return of_plant(d, d.gearbox.efficiency); },
           .meaning = "efficiency as printed; not modelled, which every answer notes",
           .permitted = Permitted::share,
           .wanted = "a number from 0 to 1, or in percent",
           .usual = {0.3, 1.0, false}}};
}

std::vector<Parameter> load_parameters() {
  return {
      {.path = "load.inertia",
       .slot = [](Drive& d) { return of_plant(d, d.load.inertia); },
       .dimension = &always<inertia>,
       .meaning = "moment of inertia of the load",
       .permitted = Permitted::not_negative,
       .is_required = true,
       .usual = {1e-6, 1e4}},
      {.path = "load.friction",
       .slot = [](Drive& d) { return of_plant(d, d.load.friction.viscous); },
       .dimension = &always<torque_per_speed>,
       .meaning = "viscous friction of the load",
       .permitted = Permitted::not_negative,
       .is_required = true,
       .usual = {1e-6, 1e3}},
      {.path = "load.coulomb",
       .slot = [](Drive& d) { return of_plant(d, d.load.friction.coulomb); },
       .dimension = &always<torque>,
       .meaning = "dry friction of the load while it moves",
       .permitted = Permitted::not_negative,
       .usual = {1e-4, 100.0}},
      {.path = "load.breakaway",
       .slot = [](Drive& d) { return of_plant(d, d.load.friction.breakaway); },
       .dimension = &always<torque>,
       .meaning = "torque that moves the load from rest, at least its dry friction",
       .permitted = Permitted::not_negative,
       .otherwise = "load.coulomb",
       .usual = {1e-4, 100.0}},
      {.path = "load.stribeck_speed",
       .slot = [](Drive& d) { return of_plant(d, d.load.friction.stribeck_speed); },
       .dimension = &always<angular_speed>,
       .meaning = "speed over which the dry friction falls from breakaway to coulomb; 0: at once",
       .permitted = Permitted::not_negative,
       .usual = {1e-4, 1.0}},
      {.path = "load.gravity",
       .slot = [](Drive& d) { return of_plant(d, d.load.gravity); },
       .dimension = &always<torque>,
       .meaning = "torque of the load's weight while its center of mass is level with its axis",
       .usual = {1e-3, 1e3}},
      {.path = "load.gravity_angle",
       .slot = [](Drive& d) { return of_plant(d, d.load.gravity_angle); },
       .dimension = &always<angle>,
       .meaning = "angle of the load's center of mass above the horizontal at position 0",
       .usual = {-1.5, 1.5, false}}};
}

std::vector<Parameter> contact_parameters() {
  return {{.path = "contact.kind",
           .slot =
               [](Drive&) {
                 return Slot{Choice{[](const Drive& drive) { return drive.contact.index(); },
                                    [](Drive& drive, std::size_t choice) {
                                      if (choice == 0) drive.contact = RigidContact{};
                                      if (choice == 1) drive.contact = CompliantContact{};
                                    }}};
               },
           .meaning = "whether the faces are rigid or compliant",
           .choices = {"rigid", "compliant"}},
          {.path = "contact.restitution",
           .slot = [](Drive& d) { return slot_of(d.contact, &RigidContact::restitution); },
           .meaning = "coefficient of restitution: 0 plastic, 1 elastic",
           .permitted = Permitted::share,
           .usual = {0.0, 0.95, false}},
          {.path = "contact.stiffness",
           .slot = [](Drive& d) { return slot_of(d.contact, &CompliantContact::stiffness); },
           .dimension = &always<torque_per_angle>,
           .meaning = "stiffness of the faces, at the load's shaft",
           .permitted = Permitted::positive,
           .is_required = true,
           .usual = {1.0, 1e6}},
          {.path = "contact.damping",
           .slot = [](Drive& d) { return slot_of(d.contact, &CompliantContact::damping); },
           .dimension = &always<torque_per_speed>,
           .meaning = "damping of the faces, at the load's shaft",
           .permitted = Permitted::not_negative,
           .usual = {1e-3, 1e4}},
          {.path = "contact.law",
           .slot =
               [](Drive& d) {
                 if (!std::holds_alternative<CompliantContact>(d.contact)) return Slot{};
                 return Slot{Choice{[](const Drive& drive) {
                                      const auto& faces = std::get<CompliantContact>(drive.contact);
                                      return static_cast<std::size_t>(faces.law);
                                    },
                                    [](Drive& drive, std::size_t choice) {
                                      std::get<CompliantContact>(drive.contact).law =
                                          choice == 0 ? ContactDamping::limited
                                                      : ContactDamping::full;
                                    }}};
               },
           .meaning = "law of the damping of the faces, as in Modelica",
           .choices = {"ElastoBacklash", "ElastoBacklash2"}}};
}

}  // namespace

std::vector<Parameter> mechanical_parameters() {
  std::vector<Parameter> list = servo_parameters();
  for (auto* part : {&rotor_parameters, &motor_constants, &two_phase_constants, &motor_dry_friction,
                     &motor_limits, &gearbox_parameters, &load_parameters, &contact_parameters}) {
    for (Parameter& parameter : (*part)()) list.push_back(std::move(parameter));
  }
  return list;
}

}  // namespace gearlash
