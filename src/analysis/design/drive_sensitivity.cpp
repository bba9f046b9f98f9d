#include "analysis/design/drive_sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash {
namespace {

constexpr std::array<const char*, cycle_measure_count> quantity_names = {
    "size", "period", "frequency", "multiplier", "growth_at_rest"};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One number's share of another's change.
double chained(const DrivetrainSlopes& by, const DrivetrainSlopes& of) {
  return by.motor_inertia * of.motor_inertia + by.load_inertia * of.load_inertia +
         by.motor_friction * of.motor_friction + by.load_friction * of.load_friction +
         by.stiffness * of.stiffness + by.backlash * of.backlash + by.restitution * of.restitution;
}

DrivetrainSlopes scaled(double factor, const DrivetrainSlopes& slopes) {
  return {factor * slopes.motor_inertia,  factor * slopes.load_inertia,
          factor * slopes.motor_friction, factor * slopes.load_friction,
          factor * slopes.stiffness,      factor * slopes.backlash,
          factor * slopes.restitution};
}

DrivetrainSlopes sum(const DrivetrainSlopes& a, const DrivetrainSlopes& b) {
  return {a.motor_inertia + b.motor_inertia,   a.load_inertia + b.load_inertia,
          a.motor_friction + b.motor_friction, a.load_friction + b.load_friction,
          a.stiffness + b.stiffness,           a.backlash + b.backlash,
          a.restitution + b.restitution};
}

/// The slopes of the normalised numbers, and of ln ω_n.
class Normalization {
 public:
  Normalization(const Drivetrain& drive, const NormalizedServo& servo) {
    const double inertia = drive.motor_inertia + drive.load_inertia;
    const double friction = drive.motor_friction + drive.load_friction;
    const double by_inertia = -0.5 / inertia;
    log_frequency_ = {.motor_inertia = by_inertia,
                      .load_inertia = by_inertia,
                      .stiffness = 0.5 / drive.stiffness};
    damping_ = {.motor_inertia = servo.damping * by_inertia,
                .load_inertia = servo.damping * by_inertia,
                .motor_friction = servo.damping / friction,
                .load_friction = servo.damping / friction,
                .stiffness = -0.5 * servo.damping / drive.stiffness};
    load_share_ = {.motor_inertia = -drive.load_inertia / inertia / inertia,
                   .load_inertia = drive.motor_inertia / inertia / inertia};
    friction_ratio_ = {.motor_friction = -servo.friction_ratio / friction,
                       .load_friction = drive.motor_friction / friction / friction};
  }

  const DrivetrainSlopes& log_frequency() const { return log_frequency_; }

  DrivetrainSlopes slopes_of(const ServoGradient& gradient) const {
    DrivetrainSlopes slopes = scaled(gradient.damping, damping_);
    slopes = sum(slopes, scaled(gradient.load_share, load_share_));
    slopes = sum(slopes, scaled(gradient.friction_ratio, friction_ratio_));
    slopes.backlash = gradient.backlash;
    slopes.restitution = gradient.restitution;
    return slopes;
  }

 private:
  DrivetrainSlopes log_frequency_, damping_, load_share_, friction_ratio_;
};

const DrivetrainSlopes no_slopes = {nan, nan, nan, nan, nan, nan, nan};

DriveSensitivity empty_sensitivity(const DrivetrainSensitivity& drive) {
  return {.outcome = drive.outcome, .values = drive.values, .parameters = {}};
}

/// Adds a parameter with which the drive's numbers change so.
void add(DriveSensitivity& sensitivity, const DrivetrainSensitivity& drive, const std::string& name,
         double present, const DrivetrainSlopes& numbers) {
  ParameterSensitivity parameter{.name = name, .present = present, .of = {}};
  for (const CycleMeasure quantity : all_cycle_measures) {
    const double slope = chained(numbers, drive.slopes[quantity]);
    parameter.of[quantity] = {slope, present * slope / drive.values[quantity]};
  }
  sensitivity.parameters.push_back(parameter);
}

/// A number of the data sheet, and how the drivetrain changes with it.
struct SheetNumber {
  const char* name;
  double present;
  DrivetrainSlopes slopes;
};

/// See refer_to_load(): the numbers of one motor that others have not.
std::vector<SheetNumber> electrical_numbers(const ArmatureControlledMotor& motor,
                                            const ReferredMotor& referred, double ratio) {
  const double stiffness = referred.stiffness;
  const double friction = referred.electrical_friction;
  return {{"motor.torque_constant",
           motor.torque_constant,
           {.motor_friction = friction / motor.torque_constant,
            .stiffness = stiffness / motor.torque_constant}},
          {"motor.back_emf_constant",
           motor.back_emf_constant,
           {.motor_friction = motor.torque_constant / motor.resistance * ratio * ratio}},
          {"motor.resistance",
           motor.resistance,
           {.motor_friction = -friction / motor.resistance,
            .stiffness = -stiffness / motor.resistance}}};
}

std::vector<SheetNumber> electrical_numbers(const FieldControlledMotor& motor,
                                            const ReferredMotor& referred, double) {
  const double stiffness = referred.stiffness;
  return {{"motor.torque_constant",
           motor.torque_constant,
           {.stiffness = stiffness / motor.torque_constant}},
          {"motor.resistance", motor.resistance, {.stiffness = -stiffness / motor.resistance}}};
}

std::vector<SheetNumber> electrical_numbers(const TwoPhaseMotor& motor,
                                            const ReferredMotor& referred, double ratio) {
  return {{"motor.torque_per_volt",
           motor.torque_per_volt,
           {.stiffness = referred.stiffness / motor.torque_per_volt}},
          {"motor.torque_per_speed", motor.torque_per_speed, {.motor_friction = ratio * ratio}}};
}

std::vector<SheetNumber> numbers_of(const Datasheet& sheet) {
  const ReferredMotor referred = refer_to_load(sheet);
  const double ratio = sheet.gearbox.ratio;
  const double friction = referred.mechanical_friction + referred.electrical_friction;
  std::vector<SheetNumber> numbers;
  std::visit(
      [&](const auto& motor) {
        numbers = {{"motor.inertia", motor.inertia, {.motor_inertia = ratio * ratio}},
                   {"motor.friction", motor.friction, {.motor_friction = ratio * ratio}}};
        for (const SheetNumber& number : electrical_numbers(motor, referred, ratio)) {
          numbers.push_back(number);
        }
      },
      sheet.motor);
  numbers.push_back({"gearbox.ratio",
                     ratio,
                     {.motor_inertia = 2.0 * referred.inertia / ratio,
                      .motor_friction = 2.0 * friction / ratio,
                      .stiffness = referred.stiffness / ratio}});
  numbers.push_back({"gearbox.backlash", sheet.gearbox.backlash, {.backlash = 1.0}});
  numbers.push_back({"load.inertia", sheet.load.inertia, {.load_inertia = 1.0}});
  numbers.push_back({"load.friction", sheet.load.friction, {.load_friction = 1.0}});
  numbers.push_back({"loop.error_gain",
                     sheet.loop.error_gain,
                     {.stiffness = referred.stiffness / sheet.loop.error_gain}});
  numbers.push_back({"contact.restitution", sheet.contact.restitution, {.restitution = 1.0}});
  return numbers;
}

}  // namespace

const char* name_of(CycleMeasure quantity) {
  return quantity_names[static_cast<std::size_t>(quantity)];
}

DrivetrainGrowth drivetrain_growth(const Drivetrain& drive) {
  const NormalizedServo servo = normalize(drive);
  const SensitiveValue growth = growth_sensitivity(servo);
  return {growth.value, Normalization(drive, servo).slopes_of(growth.slope)};
}

DrivetrainSensitivity drivetrain_sensitivity(const Drivetrain& drive) {
  const NormalizedServo servo = normalize(drive);
  const CycleSensitivity cycle = cycle_sensitivity(servo);
  DrivetrainSensitivity sensitivity{.outcome = cycle.outcome, .values = {}, .slopes = {}};
  sensitivity.values.values.fill(nan);
  sensitivity.slopes.values.fill(no_slopes);
  const Normalization normalization(drive, servo);
  const auto set = [&](CycleMeasure quantity, const SensitiveValue& value) {
    if (std::isnan(value.value)) return;
    sensitivity.values[quantity] = value.value;
    sensitivity.slopes[quantity] = normalization.slopes_of(value.slope);
  };
  set(CycleMeasure::growth_at_rest, cycle.growth_at_rest);
  set(CycleMeasure::size, cycle.size);
  set(CycleMeasure::multiplier, cycle.multiplier);
  set(CycleMeasure::period, cycle.period);
  if (!cycle.available()) return sensitivity;
  // In seconds: T = T′/ω_n, dT = (dT′ − T′ d ln ω_n)/ω_n; and f = 1/T.
  const double unit = 1.0 / natural_frequency(drive);
  double& period = sensitivity.values[CycleMeasure::period];
  DrivetrainSlopes& slopes = sensitivity.slopes[CycleMeasure::period];
  slopes = scaled(unit, sum(slopes, scaled(-period, normalization.log_frequency())));
  period *= unit;
  sensitivity.values[CycleMeasure::frequency] = 1.0 / period;
  sensitivity.slopes[CycleMeasure::frequency] = scaled(-1.0 / (period * period), slopes);
  return sensitivity;
}

const ParameterSensitivity* DriveSensitivity::find(const std::string& name) const {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(),
                   [&](const ParameterSensitivity& parameter) { return parameter.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

DriveSensitivity drive_sensitivity(const ChangeableDrive& drive) {
  const DrivetrainSensitivity of_numbers = drivetrain_sensitivity(drive.drivetrain());
  DriveSensitivity sensitivity = empty_sensitivity(of_numbers);
  for (const DesignParameter parameter : all_parameters) {
    add(sensitivity, of_numbers, name_of(parameter), drive.present_value(parameter),
        drive.slopes(parameter));
  }
  return sensitivity;
}

DriveSensitivity datasheet_sensitivity(const Datasheet& datasheet) {
  const DrivetrainSensitivity of_numbers = drivetrain_sensitivity(to_drivetrain(datasheet));
  DriveSensitivity sensitivity = empty_sensitivity(of_numbers);
  for (const SheetNumber& number : numbers_of(datasheet)) {
    add(sensitivity, of_numbers, number.name, number.present, number.slopes);
  }
  return sensitivity;
}

}  // namespace gearlash
