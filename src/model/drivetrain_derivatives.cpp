#include "model/drivetrain_derivatives.hpp"

#include <cmath>

#include "gearlash/parameter.hpp"
#include "model/parameters.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

using Slopes = std::optional<DrivetrainSlopes>;

Slopes slopes_of_normal_form(const NormalForm& form, std::string_view path) {
  const double frequency = form.natural_frequency.value_or(1.0);
  const double share = form.friction_ratio;
  const double critical = 2.0 * frequency;
  if (path == "servo.damping") {
    return {{.motor_friction = critical * (1.0 - share), .load_friction = critical * share}};
  }
  if (path == "servo.friction_ratio") {
    const double friction = critical * form.damping;
    return {{.motor_friction = -friction, .load_friction = friction}};
  }
  if (path == "servo.inertia_ratio") {
    const double motor = 1.0 / (1.0 + form.inertia_ratio);
    return {{.motor_inertia = -motor * motor, .load_inertia = motor * motor}};
  }
  if (path == "servo.natural_frequency") {
    const double by_frequency = 2.0 * form.damping;
    return {{.motor_friction = by_frequency * (1.0 - share),
             .load_friction = by_frequency * share,
             .stiffness = critical}};
  }
  if (path == "servo.backlash") return {{.backlash = 1.0}};
  return std::nullopt;
}

/// The terms of the formulas.
struct Parts {
  explicit Parts(const Drive& of) : drive(of) { feedback = -reduce(of).controller.direct[2]; }

  const Drive& drive;
  double ratio = drive.gearbox.ratio;
  ReferredOutput output = refer_output(drive);
  double per_output = gain_scale(drive);  ///< S
  Drivetrain drivetrain = referred_drivetrain(drive);
  double feedback = 0.0;  ///< S d
};

Slopes slopes_of_motor(const Parts& parts, std::string_view path) {
  const double square = parts.ratio * parts.ratio;
  const double stiffness = parts.drivetrain.stiffness;
  const double electrical = parts.output.friction + parts.feedback;
  if (path == "motor.inertia") return {{.motor_inertia = square}};
  if (path == "motor.friction" || path == "motor.torque_per_speed") {
    return {{.motor_friction = square}};
  }
  if (std::holds_alternative<TorqueControl>(parts.drive.motor.kind)) return std::nullopt;
  const double value = get(parts.drive, path);
  if (path == "motor.torque_constant") {
    return {{.motor_friction = electrical / value, .stiffness = stiffness / value}};
  }
  if (path == "motor.resistance") {
    return {{.motor_friction = -electrical / value, .stiffness = -stiffness / value}};
  }
  if (path == "motor.back_emf_constant") {
    return {{.motor_friction = parts.output.torque * parts.ratio}};
  }
  if (path == "motor.torque_per_volt") {
    const double of_tachometer =
        parts.output.torque * parts.ratio * parts.drive.controller.motor_speed_feedback;
    return {{.motor_friction = (of_tachometer + parts.feedback) / value,
             .stiffness = stiffness / value}};
  }
  return std::nullopt;
}

Slopes slopes_of_controller(const Parts& parts, std::string_view path) {
  const double stiffness = parts.drivetrain.stiffness;
  if (path == "controller.proportional") return {{.stiffness = parts.per_output}};
  if (path == "controller.derivative") return {{.motor_friction = parts.per_output}};
  if (path == "controller.motor_speed_feedback") {
    return {{.motor_friction = parts.output.torque * parts.ratio}};
  }
  if (!path.starts_with("controller.")) return std::nullopt;
  const double value = get(parts.drive, path);
  if (path == "controller.position") return {{.stiffness = stiffness / value}};
  if (path == "controller.speed" || path == "controller.gain") {
    return {{.motor_friction = parts.feedback / value, .stiffness = stiffness / value}};
  }
  return std::nullopt;
}

Slopes slopes_of_plant(const Drive& drive, std::string_view path) {
  const Parts parts(drive);
  if (path == "gearbox.ratio") {
    const Controller& controller = drive.controller;
    const bool has_torque = std::holds_alternative<TorqueControl>(drive.motor.kind);
    const bool is_at_joint = has_torque && controller.shaft == GainShaft::load;
    const double power = is_at_joint ? 0.0 : controller.shaft == GainShaft::motor ? 2.0 : 1.0;
    return {{.motor_inertia = 2.0 * parts.drivetrain.motor_inertia / parts.ratio,
             .motor_friction = (2.0 * (parts.drivetrain.motor_friction - parts.feedback) +
                                power * parts.feedback) /
                               parts.ratio,
             .stiffness = power * parts.drivetrain.stiffness / parts.ratio}};
  }
  if (path == "gearbox.backlash") return {{.backlash = 1.0}};
  if (path == "gearbox.inertia" && drive.gearbox.inertia != 0.0) {
    return {{.motor_inertia = parts.ratio * parts.ratio}};
  }
  if (path == "load.inertia") return {{.load_inertia = 1.0}};
  if (path == "load.friction") return {{.load_friction = 1.0}};
  return path.starts_with("motor.") ? slopes_of_motor(parts, path)
                                    : slopes_of_controller(parts, path);
}

/// Whether the drive keeps its closed form if the number changes.
bool keeps_closed_form(Drive drive, const Parameter& parameter) {
  const Slot slot = parameter.slot(drive);
  double* place = std::get_if<double*>(&slot) ? std::get<double*>(slot) : nullptr;
  if (auto* const* given = std::get_if<std::optional<double>*>(&slot); given && **given) {
    place = &***given;
  }
  if (place == nullptr) return false;
  *place = *place == 0.0 ? 0.5 : 0.75 * *place;
  return drive::proportional_drivetrain(reduce(drive)).has_value();
}

}  // namespace

std::optional<DrivetrainSlopes> drivetrain_slopes(const Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  if (parameter == nullptr && drive.servo) return drivetrain_slopes(physical_form(drive), path);
  if (parameter == nullptr || !exists(*parameter, drive)) return std::nullopt;
  if (!keeps_closed_form(drive, *parameter)) return std::nullopt;
  if (parameter->path == "contact.restitution") return DrivetrainSlopes{.restitution = 1.0};
  return drive.servo ? slopes_of_normal_form(*drive.servo, parameter->path)
                     : slopes_of_plant(drive, parameter->path);
}

}  // namespace gearlash
