#include "analysis/design/changeable_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/overloaded.hpp"

namespace gearlash {
namespace {

struct Naming {
  const char* name;
  const char* description;
  const char* unit;  ///< of a data sheet's
};

/// By DesignParameter.
constexpr std::array<Naming, parameter_count> namings = {
    {{"backlash", "backlash, face to face at the load", "rad"},
     {"gear_ratio", "gear ratio, motor turns per load turn", "1"},
     {"error_gain", "gain of the position loop", "V/rad"},
     {"load_friction", "friction of the load", "N m s/rad"},
     {"motor_friction", "friction of the motor", "N m s/rad"},
     {"tachometer", "added tachometer feedback", "V s/rad"},
     {"load_inertia", "inertia of the load", "kg m2"},
     {"motor_inertia", "inertia of the motor", "kg m2"},
     {"restitution", "coefficient of restitution", "1"}}};

const Naming& naming_of(DesignParameter parameter) {
  return namings[static_cast<std::size_t>(parameter)];
}

double torque_per_volt(const SheetMotor& motor) {
  return std::visit(Overloaded{[](const TwoPhaseMotor& of) { return of.torque_per_volt; },
                               [](const auto& of) { return of.torque_constant / of.resistance; }},
                    motor);
}

double friction_of(const SheetMotor& motor) {
  return std::visit([](const auto& any) { return any.friction; }, motor);
}

double inertia_of(const SheetMotor& motor) {
  return std::visit([](const auto& any) { return any.inertia; }, motor);
}

/// J_M + J_L = 1 kg m².
Drivetrain drivetrain_of(const NormalizedServo& servo, double natural_frequency) {
  require_none(validate(servo));
  const double ratio = servo.inertia_ratio;
  const double friction = 2.0 * servo.damping * natural_frequency;
  return {.motor_inertia = 1.0 / (1.0 + ratio),
          .load_inertia = std::isinf(ratio) ? 1.0 : ratio / (1.0 + ratio),
          .motor_friction = friction * (1.0 - servo.friction_ratio),
          .load_friction = friction * servo.friction_ratio,
          .stiffness = natural_frequency * natural_frequency,
          .backlash = servo.backlash,
          .restitution = servo.restitution,
          .sensor = servo.sensor};
}

/// When a parameter is changed among others: feedback adds to the motor's friction as it then is,
/// and gears carry all of it to the load.
int turn_of(DesignParameter parameter) {
  if (parameter == DesignParameter::gear_ratio) return 2;
  return parameter == DesignParameter::tachometer ? 1 : 0;
}

}  // namespace

const char* name_of(DesignParameter parameter) { return naming_of(parameter).name; }
const char* description_of(DesignParameter parameter) { return naming_of(parameter).description; }

std::optional<DesignParameter> parameter_named(std::string_view name) {
  for (const DesignParameter parameter : all_parameters) {
    if (name == name_of(parameter)) return parameter;
  }
  return std::nullopt;
}

ChangeableDrive::ChangeableDrive(const Datasheet& datasheet)
    : drivetrain_(to_drivetrain(datasheet)) {
  const double ratio = datasheet.gearbox.ratio;
  motor_friction_unit_ = ratio * ratio;
  tachometer_unit_ = ratio * ratio * torque_per_volt(datasheet.motor);
  motor_inertia_unit_ = ratio * ratio;
  electrical_friction_ = refer_to_load(datasheet).electrical_friction;
  present_values_ = {
      datasheet.gearbox.backlash,   ratio, datasheet.loop.error_gain, datasheet.load.friction,
      friction_of(datasheet.motor), 0.0,   datasheet.load.inertia,    inertia_of(datasheet.motor),
      datasheet.contact.restitution};
}

ChangeableDrive::ChangeableDrive(const NormalizedServo& servo, double natural_frequency)
    : drivetrain_(drivetrain_of(servo, natural_frequency)), is_normalized_(true) {
  load_friction_unit_ = 2.0 * natural_frequency;
  motor_friction_unit_ = load_friction_unit_;
  tachometer_unit_ = load_friction_unit_;
  present_values_ = {servo.backlash,
                     1.0,
                     1.0,
                     servo.damping * servo.friction_ratio,
                     servo.damping * (1.0 - servo.friction_ratio),
                     0.0,
                     drivetrain_.load_inertia,
                     drivetrain_.motor_inertia,
                     servo.restitution};
  // 1 − f, of a decimal f.
  if (servo.friction_ratio < 1.0) {
    data_error_.motor_friction +=
        std::numeric_limits<double>::epsilon() / (1.0 - servo.friction_ratio);
  }
}

const char* ChangeableDrive::unit_of(DesignParameter parameter) const {
  return is_normalized_ && parameter != DesignParameter::backlash ? "1" : naming_of(parameter).unit;
}

Drivetrain ChangeableDrive::with(DesignParameter parameter, double value) const {
  Drivetrain drive = drivetrain_;
  change(drive, parameter, value);
  return drive;
}

Drivetrain ChangeableDrive::with(DesignParameter parameter, double value, DesignParameter other,
                                 double other_value) const {
  Drivetrain drive = drivetrain_;
  const bool comes_first = turn_of(parameter) <= turn_of(other);
  if (comes_first) change(drive, parameter, value);
  change(drive, other, other_value);
  if (!comes_first) change(drive, parameter, value);
  return drive;
}

void ChangeableDrive::change(Drivetrain& drive, DesignParameter parameter, double value) const {
  const double factor = value / present_value(parameter);
  switch (parameter) {
    case DesignParameter::backlash:
      drive.backlash = value;
      break;
    case DesignParameter::gear_ratio:
      drive.motor_inertia *= factor * factor;
      drive.motor_friction *= factor * factor;
      drive.stiffness *= factor;
      break;
    case DesignParameter::error_gain:
      drive.stiffness *= factor;
      break;
    case DesignParameter::load_friction:
      drive.load_friction = load_friction_unit_ * value;
      break;
    case DesignParameter::motor_friction:
      drive.motor_friction = motor_friction_unit_ * value + electrical_friction_;
      break;
    case DesignParameter::tachometer:
      drive.motor_friction += tachometer_unit_ * value;
      break;
    case DesignParameter::load_inertia:
      drive.load_inertia = value;
      break;
    case DesignParameter::motor_inertia:
      drive.motor_inertia = motor_inertia_unit_ * value;
      break;
    case DesignParameter::restitution:
      drive.restitution = value;
      break;
  }
}

DrivetrainSlopes ChangeableDrive::slopes(DesignParameter parameter) const {
  const double present = present_value(parameter);
  switch (parameter) {
    case DesignParameter::backlash:
      return {.backlash = 1.0};
    case DesignParameter::gear_ratio:
      return {.motor_inertia = 2.0 * drivetrain_.motor_inertia / present,
              .motor_friction = 2.0 * drivetrain_.motor_friction / present,
              .stiffness = drivetrain_.stiffness / present};
    case DesignParameter::error_gain:
      return {.stiffness = drivetrain_.stiffness / present};
    case DesignParameter::load_friction:
      return {.load_friction = load_friction_unit_};
    case DesignParameter::motor_friction:
      return {.motor_friction = motor_friction_unit_};
    case DesignParameter::tachometer:
      return {.motor_friction = tachometer_unit_};
    case DesignParameter::load_inertia:
      return {.load_inertia = 1.0};
    case DesignParameter::motor_inertia:
      return {.motor_inertia = motor_inertia_unit_};
    case DesignParameter::restitution:
      return {.restitution = 1.0};
  }
  return {};
}

Bounds ChangeableDrive::range(DesignParameter parameter) const {
  constexpr double factor = 1e3;
  constexpr double times_critical = 10.0;
  const double critical = 2.0 * std::sqrt(drivetrain_.stiffness) *
                          std::sqrt(drivetrain_.motor_inertia + drivetrain_.load_inertia);
  const double present = present_value(parameter);
  const auto is_sound = [&](double value) { return validate(with(parameter, value)).empty(); };
  // From a value that is sound as far towards the other as is permitted.
  const auto reach = [&](double sound, double wanted) {
    constexpr int halvings = 200;
    for (int i = 0; i < halvings && !is_sound(wanted); ++i) wanted = 0.5 * (sound + wanted);
    return wanted;
  };
  switch (parameter) {
    case DesignParameter::restitution:
      return {0.0, 1.0};
    case DesignParameter::load_friction:
      return {reach(present, 0.0), reach(present, times_critical * critical / load_friction_unit_)};
    case DesignParameter::motor_friction:
      return {reach(present, 0.0),
              reach(present, times_critical * critical / motor_friction_unit_)};
    case DesignParameter::tachometer:
      return {0.0, reach(present, times_critical * critical / tachometer_unit_)};
    case DesignParameter::backlash:
    case DesignParameter::gear_ratio:
    case DesignParameter::error_gain:
    case DesignParameter::load_inertia:
    case DesignParameter::motor_inertia:
      break;
  }
  if (present == 0.0) return {0.0, 0.0};  // nothing to be a multiple of
  return {reach(present, present / factor), reach(present, present * factor)};
}

DriveBox ChangeableDrive::box(DesignParameter parameter, const Bounds& values) const {
  return box_between(with(parameter, values.low), with(parameter, values.high), data_error_);
}

}  // namespace gearlash
