#include "analysis/design/toleranced_drive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "analysis/design/drive_per_backlash.hpp"
#include "base/overloaded.hpp"
#include "base/range_check.hpp"

namespace gearlash {
namespace {

enum class Range { positive, not_negative, share };

struct Naming {
  const char* name;
  const char* unit;
  Range range;
};

/// By DriveNumber.
constexpr std::array<Naming, drive_number_count> namings = {
    {{"motor.inertia", "kg m2", Range::not_negative},
     {"motor.friction", "N m s/rad", Range::not_negative},
     {"motor.torque_constant", "N m/A", Range::positive},
     {"motor.back_emf_constant", "V s/rad", Range::not_negative},
     {"motor.resistance", "ohm", Range::positive},
     {"motor.torque_per_volt", "N m/V", Range::positive},
     {"motor.torque_per_speed", "N m s/rad", Range::not_negative},
     {"gearbox.ratio", "1", Range::positive},
     {"gearbox.backlash", "rad", Range::not_negative},
     {"load.inertia", "kg m2", Range::not_negative},
     {"load.friction", "N m s/rad", Range::not_negative},
     {"loop.error_gain", "V/rad", Range::positive},
     {"contact.restitution", "1", Range::share},
     {"servo.damping", "1", Range::not_negative},
     {"servo.inertia_ratio", "1", Range::not_negative},
     {"servo.friction_ratio", "1", Range::share},
     {"servo.backlash", "rad", Range::not_negative},
     {"servo.restitution", "1", Range::share}}};

const Naming& naming_of(DriveNumber number) { return namings[static_cast<std::size_t>(number)]; }

double* place_in(SheetMotor& motor, DriveNumber number) {
  const auto in_any = [&](auto& any) -> double* {
    if (number == DriveNumber::motor_inertia) return &any.inertia;
    if (number == DriveNumber::motor_friction) return &any.friction;
    return nullptr;
  };
  return std::visit(Overloaded{[&](ArmatureControlledMotor& armature) -> double* {
                                 if (number == DriveNumber::motor_torque_constant) {
                                   return &armature.torque_constant;
                                 }
                                 if (number == DriveNumber::motor_back_emf_constant) {
                                   return &armature.back_emf_constant;
                                 }
                                 if (number == DriveNumber::motor_resistance)
                                   return &armature.resistance;
                                 return in_any(armature);
                               },
                               [&](FieldControlledMotor& field) -> double* {
                                 if (number == DriveNumber::motor_torque_constant)
                                   return &field.torque_constant;
                                 if (number == DriveNumber::motor_resistance)
                                   return &field.resistance;
                                 return in_any(field);
                               },
                               [&](TwoPhaseMotor& two_phase) -> double* {
                                 if (number == DriveNumber::motor_torque_per_volt) {
                                   return &two_phase.torque_per_volt;
                                 }
                                 if (number == DriveNumber::motor_torque_per_speed) {
                                   return &two_phase.torque_per_speed;
                                 }
                                 return in_any(two_phase);
                               }},
                    motor);
}

double* place_in(Datasheet& datasheet, DriveNumber number) {
  switch (number) {
    case DriveNumber::gearbox_ratio:
      return &datasheet.gearbox.ratio;
    case DriveNumber::gearbox_backlash:
      return &datasheet.gearbox.backlash;
    case DriveNumber::load_inertia:
      return &datasheet.load.inertia;
    case DriveNumber::load_friction:
      return &datasheet.load.friction;
    case DriveNumber::loop_error_gain:
      return &datasheet.loop.error_gain;
    case DriveNumber::contact_restitution:
      return &datasheet.contact.restitution;
    default:
      return place_in(datasheet.motor, number);
  }
}

double* place_in(NormalizedServo& servo, DriveNumber number) {
  switch (number) {
    case DriveNumber::servo_damping:
      return &servo.damping;
    case DriveNumber::servo_inertia_ratio:
      return &servo.inertia_ratio;
    case DriveNumber::servo_friction_ratio:
      return &servo.friction_ratio;
    case DriveNumber::servo_backlash:
      return &servo.backlash;
    case DriveNumber::servo_restitution:
      return &servo.restitution;
    default:
      return nullptr;
  }
}

using Nominal = std::variant<Datasheet, NormalizedServo>;

double* place_in(Nominal& nominal, DriveNumber number) {
  return std::visit([&](auto& any) { return place_in(any, number); }, nominal);
}

DriveNumber backlash_of(const Nominal& nominal) {
  return std::holds_alternative<Datasheet>(nominal) ? DriveNumber::gearbox_backlash
                                                    : DriveNumber::servo_backlash;
}

Nominal nominal_with(const TolerancedDrive& drive, std::span<const double> values) {
  Nominal nominal = drive.nominal;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double* place = place_in(nominal, drive.varied[i].number);
    if (place == nullptr) {
      throw std::invalid_argument(std::string(name_of(drive.varied[i].number)) +
                                  " is no number of this drive");
    }
    *place = values[i];
  }
  return nominal;
}

TimedServo timed(const Nominal& nominal, double natural_frequency) {
  if (const NormalizedServo* servo = std::get_if<NormalizedServo>(&nominal)) {
    require_none(validate(*servo));
    return {*servo, natural_frequency};
  }
  const Drivetrain drivetrain = to_drivetrain(std::get<Datasheet>(nominal));
  return {normalize(drivetrain), gearlash::natural_frequency(drivetrain)};
}

std::string names_of_numbers(Nominal nominal) {
  std::string names;
  for (const DriveNumber number : all_drive_numbers) {
    if (place_in(nominal, number) == nullptr) continue;
    names += (names.empty() ? "" : ", ") + std::string(name_of(number));
  }
  return names;
}

/// What is wrong with the values that are drawn of one number, taken by itself.
void check_range(RangeCheck& check, const VariedNumber& varied) {
  const char* name = name_of(varied.number);
  const Bounds range = drawn_range_of(varied.distribution);
  const Bounds support = support_of(varied.distribution);
  const std::string text = text_of(varied.distribution);
  const Range permitted = naming_of(varied.number).range;
  if (permitted == Range::share) {
    if (range.low >= 0.0 && range.high <= 1.0) return;
    const bool needs_min = range.low < 0.0 && std::isinf(support.low);
    const bool needs_max = range.high > 1.0 && std::isinf(support.high);
    std::string mend;
    if (needs_min) mend = ": give it a min";
    if (needs_max) mend = needs_min ? ": give it a min and a max" : ": give it a max";
    check.refuse(name, text, "must stay within 0 to 1" + mend);
    return;
  }
  const double low = std::isinf(support.low) ? range.low : support.low;
  if (low > 0.0 || (low == 0.0 && permitted == Range::not_negative)) return;
  if (std::isinf(support.low)) {
    check.refuse(name, text, "must stay positive: give it a min");
  } else if (permitted == Range::positive) {
    check.refuse(name, text, "must stay positive");
  } else {
    check.refuse(name, text, "must not fall below zero");
  }
}

/// Names of a normalised servo's fields as its author wrote them.
std::vector<Fault> named_for_file(const Nominal& nominal, std::vector<Fault> faults) {
  if (std::holds_alternative<Datasheet>(nominal)) return faults;
  for (Fault& fault : faults) fault.path = "servo." + fault.path;
  return faults;
}

/// Of the numbers that are given, not of what follows from them and from stand-ins.
std::vector<Fault> validate_given(const Nominal& nominal) {
  std::vector<Fault> faults =
      named_for_file(nominal, std::visit([](const auto& any) { return validate(any); }, nominal));
  const auto is_derived = [](const Fault& fault) {
    return fault.path.find('.') == std::string::npos;
  };
  faults.erase(std::remove_if(faults.begin(), faults.end(), is_derived), faults.end());
  return faults;
}

/// A value that every number may have.
constexpr double stand_in = 0.5;

/// Corner `corner` of the box of `ranges`; bit i tells which end of number i.
std::vector<double> corner_of(std::span<const Bounds> ranges, std::size_t corner) {
  std::vector<double> values;
  for (const Bounds& range : ranges) {
    values.push_back((corner & 1U) != 0 ? range.high : range.low);
    corner >>= 1U;
  }
  return values;
}

/// What is wrong with the first corner that is no drive. Precondition: numbers are of the drive.
std::vector<Fault> validate_corners(const TolerancedDrive& drive, std::span<const Bounds> ranges) {
  for (std::size_t corner = 0; corner < std::size_t{1} << ranges.size(); ++corner) {
    std::vector<Fault> faults;
    try {
      detail::drive_per_backlash(drive, corner_of(ranges, corner));
      continue;
    } catch (const InvalidInput& error) {
      faults = named_for_file(drive.nominal, error.faults());
    }
    for (Fault& fault : faults) {
      fault.permitted += "; the tolerances permit it where";
      const std::vector<double> values = corner_of(ranges, corner);
      for (std::size_t i = 0; i < values.size(); ++i) {
        fault.permitted += (i == 0 ? " " : ", ") + std::string(name_of(drive.varied[i].number)) +
                           " = " + exact_text(values[i]);
      }
    }
    return faults;
  }
  return {};
}

/// Each varied number by itself, and those that are not varied.
std::vector<Fault> validate_one_by_one(const TolerancedDrive& drive) {
  RangeCheck check;
  Nominal nominal = drive.nominal;
  std::vector<DriveNumber> seen;
  for (const VariedNumber& varied : drive.varied) {
    const char* name = name_of(varied.number);
    double* place = place_in(nominal, varied.number);
    if (place == nullptr) {
      check.refuse(name, text_of(varied.distribution),
                   "must be a number of this drive: " + names_of_numbers(nominal));
      continue;
    }
    if (std::find(seen.begin(), seen.end(), varied.number) != seen.end()) {
      check.refuse(name, text_of(varied.distribution), "must be given once");
    }
    seen.push_back(varied.number);
    *place = stand_in;
    const std::vector<Fault> faults = validate(varied.distribution, name);
    check.include(faults);
    if (faults.empty()) check_range(check, varied);
  }
  if (std::holds_alternative<NormalizedServo>(nominal)) {
    check.positive("natural_frequency", drive.natural_frequency, "rad/s");
  }
  return check.include(validate_given(nominal)).faults();
}

}  // namespace

const char* name_of(DriveNumber number) { return naming_of(number).name; }
const char* unit_of(DriveNumber number) { return naming_of(number).unit; }

std::optional<DriveNumber> drive_number_named(std::string_view name) {
  for (const DriveNumber number : all_drive_numbers) {
    if (name == name_of(number)) return number;
  }
  return std::nullopt;
}

std::vector<Fault> validate(const TolerancedDrive& drive) {
  RangeCheck check;
  check.include(validate_one_by_one(drive));
  if (!check.faults().empty()) return check.faults();
  std::vector<Bounds> drawn;
  std::vector<Bounds> possible;
  for (const VariedNumber& varied : drive.varied) {
    drawn.push_back(drawn_range_of(varied.distribution));
    possible.push_back(three_sigma_range_of(varied.distribution));
  }
  check.include(validate_corners(drive, drawn));
  if (check.faults().empty()) check.include(validate_corners(drive, possible));
  return check.faults();
}

std::optional<std::size_t> place_of_backlash(const TolerancedDrive& drive) {
  const DriveNumber backlash = backlash_of(drive.nominal);
  for (std::size_t i = 0; i < drive.varied.size(); ++i) {
    if (drive.varied[i].number == backlash) return i;
  }
  return std::nullopt;
}

double nominal_backlash_of(const TolerancedDrive& drive) {
  Nominal nominal = drive.nominal;
  return *place_in(nominal, backlash_of(nominal));
}

TimedServo drive_with(const TolerancedDrive& drive, std::span<const double> values) {
  if (values.size() != drive.varied.size()) {
    throw std::invalid_argument(std::to_string(values.size()) + " values; must be " +
                                std::to_string(drive.varied.size()) +
                                ", as many as there are varied numbers");
  }
  return timed(nominal_with(drive, values), drive.natural_frequency);
}

namespace detail {
namespace {

/// A backlash of 1 rad for that of the drive, which is returned.
double take_backlash(Nominal& nominal) {
  constexpr double most_backlash = 1e6;  // rad: more is refused
  double& place = *place_in(nominal, backlash_of(nominal));
  const double backlash = place;
  if (backlash > 0.0 && backlash <= most_backlash) place = 1.0;
  return backlash;
}

TimedServo timed_sound(const Nominal& nominal, double natural_frequency) {
  if (const NormalizedServo* servo = std::get_if<NormalizedServo>(&nominal)) {
    return {*servo, natural_frequency};
  }
  const Drivetrain drivetrain = to_drivetrain_sound(std::get<Datasheet>(nominal));
  return {normalize_sound(drivetrain), gearlash::natural_frequency(drivetrain)};
}

}  // namespace

DrivePerBacklash drive_per_backlash(const TolerancedDrive& drive, std::span<const double> values) {
  Nominal nominal = nominal_with(drive, values);
  const double backlash = take_backlash(nominal);
  return {timed(nominal, drive.natural_frequency), backlash};
}

std::optional<DrivePerBacklash> sound_drive_per_backlash(const TolerancedDrive& drive,
                                                         std::span<const double> values) {
  Nominal nominal = nominal_with(drive, values);
  const double backlash = take_backlash(nominal);
  const TimedServo timed = timed_sound(nominal, drive.natural_frequency);
  if (!validate(timed.servo).empty()) return std::nullopt;
  return DrivePerBacklash{timed, backlash};
}

}  // namespace detail
}  // namespace gearlash
