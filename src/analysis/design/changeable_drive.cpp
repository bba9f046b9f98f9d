#include "analysis/design/changeable_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/final_servo.hpp"
#include "base/range_check.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

struct Name {
  std::string_view path;
  std::string_view older;  ///< in 0.1
};

/// What a designer considers first, if the drive has it.
constexpr Name before_feedback[] = {{"servo.backlash", "backlash"},
                                    {"gearbox.backlash", "backlash"},
                                    {"gearbox.ratio", "gear_ratio"},
                                    {"controller.proportional", "error_gain"},
                                    {"controller.position", ""},
                                    {"controller.speed", ""},
                                    {"controller.gain", ""},
                                    {"load.friction", "load_friction"},
                                    {"motor.friction", "motor_friction"}};
constexpr Name after_feedback[] = {{"load.inertia", "load_inertia"},
                                   {"motor.inertia", "motor_inertia"},
                                   {"contact.restitution", "restitution"}};

std::string_view older_name_of(std::string_view path) {
  for (const Name& name : before_feedback) {
    if (name.path == path) return name.older;
  }
  for (const Name& name : after_feedback) {
    if (name.path == path) return name.older;
  }
  return "";
}

/// The place of a parameter whose slot holds a number.
double& place_of(const Parameter& parameter, Drive& drive) {
  const Slot slot = parameter.slot(drive);
  if (auto* const* number = std::get_if<double*>(&slot)) return **number;
  return std::get<std::optional<double>*>(slot)->emplace();
}

/// Whether the name means the same number, not its reciprocal.
bool is_alias(const Parameter& parameter, std::string_view name) {
  return parameter.path == name ||
         std::any_of(
             parameter.other_forms.begin(), parameter.other_forms.end(),
             [&](const OtherForm& form) { return form.path == name && form.dimension == nullptr; });
}

/// A difference of frictions that leaves less than this share of them counts as unsound, because
/// its rounding could not be bounded closely.
constexpr double least_left = 0x1p-20;

/// The sum of the absolute values of the terms of the motor's friction. With negative feedback the
/// friction is a difference.
double friction_terms(const Drive& drive, double friction) {
  if (drive.servo) return friction;
  const double ratio = drive.gearbox.ratio;
  const double viscous =
      drive.motor.friction.viscous * (ratio * ratio) + refer_output(drive).friction;
  return std::max(friction, 2.0 * viscous - friction);
}

Drive with_closed_form(const Drive& drive) {
  require_none(faults(drive));
  if (std::optional<Drive> found = closed_form_drive(drive)) return *std::move(found);
  throw InvalidInput({{"drive", "without a closed form", permitted_with_closed_form, ""}});
}

}  // namespace

DataError data_error_of(const Drive& drive, const Drivetrain& drivetrain) {
  DataError error;
  if (drive.servo && drive.servo->friction_ratio < 1.0) {
    // The error of 1 − φ for a decimal φ.
    error.motor_friction +=
        std::numeric_limits<double>::epsilon() / (1.0 - drive.servo->friction_ratio);
  }
  if (drive.is_rounded && drive.servo && drive.servo->friction_ratio == 1.0) {
    error.hidden_motor_friction = error.each * drivetrain.load_friction;
  }
  const double friction = drivetrain.motor_friction;
  const double terms = friction_terms(drive, friction);
  if (terms > friction) {
    error.motor_friction = std::max(error.motor_friction, error.each * (terms / friction));
  }
  return error;
}

ChangeableDrive::ChangeableDrive(const Drive& drive) : drive_(with_closed_form(drive)) {
  drivetrain_ = referred_drivetrain(drive_);
  for (const Name& name : before_feedback) add_parameter(name.path);
  if (drive_.servo) add_shares();
  if (!drive_.servo) add_feedback(1.0);
  for (const Name& name : after_feedback) add_parameter(name.path);
  usual_ = numbers_.size();
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (find(parameter.path) == nullptr) add_parameter(parameter.path);
  }
  data_error_ = data_error_of(drive_, drivetrain_);
}

void ChangeableDrive::add_parameter(std::string_view path) {
  if (!drivetrain_slopes(drive_, path)) return;
  const Parameter& parameter = *find_parameter(path, drive_);
  const Dimension* dimension = parameter.dimension(drive_);
  numbers_.push_back({.name = std::string(path),
                      .older_name = std::string(older_name_of(path)),
                      .description = std::string(parameter.meaning),
                      .unit = dimension == nullptr ? "1" : std::string(dimension->unit),
                      .present = *number_in(parameter, drive_),
                      .parameter = &parameter});
}

void ChangeableDrive::add_feedback(double scale) {
  numbers_.push_back({.name = "tachometer",
                      .description = "added tachometer feedback",
                      .unit = drive_.servo ? "1" : "V s/rad",
                      .kind = ChangeableNumber::Kind::feedback,
                      .scale = scale});
  if (std::holds_alternative<TorqueControl>(drive_.motor.kind) && !drive_.servo) {
    numbers_.back().unit = "N m s/rad";
  }
}

/// Present values equal those of the normal form to the bit.
void ChangeableDrive::add_shares() {
  const Drive physical = physical_form(drive_);
  const NormalForm& form = *drive_.servo;
  const double critical = 2.0 * form.natural_frequency.value_or(1.0);
  const auto add = [&](const char* name, const char* path, double present, double scale) {
    const Parameter& parameter = *find_parameter(path, physical);
    numbers_.push_back({.name = name,
                        .description = std::string(parameter.meaning) + ", as a share",
                        .unit = "1",
                        .present = present,
                        .kind = ChangeableNumber::Kind::share,
                        .parameter = &parameter,
                        .scale = scale});
  };
  add("gear_ratio", "gearbox.ratio", 1.0, 1.0);
  add("error_gain", "controller.proportional", 1.0, drivetrain_.stiffness);
  add("load_friction", "load.friction", form.damping * form.friction_ratio, critical);
  add("motor_friction", "motor.friction", form.damping * (1.0 - form.friction_ratio), critical);
  add_feedback(critical);
  add("load_inertia", "load.inertia", drivetrain_.load_inertia, 1.0);
  add("motor_inertia", "motor.inertia", drivetrain_.motor_inertia, 1.0);
}

std::vector<std::string> ChangeableDrive::usual_names() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < usual_; ++i) names.push_back(numbers_[i].name);
  return names;
}

const ChangeableNumber* ChangeableDrive::find(std::string_view name) const {
  const auto named = [](std::string_view wanted) {
    return [wanted](const ChangeableNumber& number) {
      return number.name == wanted || (!number.older_name.empty() && number.older_name == wanted);
    };
  };
  auto found = std::find_if(numbers_.begin(), numbers_.end(), named(name));
  if (found == numbers_.end()) {
    const Parameter* parameter = find_parameter(name);
    if (parameter != nullptr && is_alias(*parameter, name)) {
      found = std::find_if(numbers_.begin(), numbers_.end(), named(parameter->path));
    }
  }
  return found == numbers_.end() ? nullptr : &*found;
}

const ChangeableNumber& ChangeableDrive::number(std::string_view name) const {
  if (const ChangeableNumber* found = find(name)) return *found;
  std::string permitted = "must be one of";
  for (const ChangeableNumber& number : numbers_) {
    permitted += (&number == numbers_.data() ? " " : ", ") + number.name;
  }
  throw InvalidInput({{"parameter", std::string(name), permitted, ""}});
}

ChangeableDrive::Changed ChangeableDrive::changed(std::initializer_list<Change> changes) const {
  using Kind = ChangeableNumber::Kind;
  Drive drive = drive_;
  bool has_shares = false;
  for (const auto& [number, value] : changes) {
    if (number.kind == Kind::parameter) place_of(*number.parameter, drive) = value;
    has_shares = has_shares || number.kind != Kind::parameter;
  }
  if (has_shares) drive = physical_form(drive);
  for (const auto& [number, value] : changes) {
    if (number.kind == Kind::share) place_of(*number.parameter, drive) = number.scale * value;
  }
  Changed result{referred_drivetrain(drive)};
  double& friction = result.drivetrain.motor_friction;
  result.friction_terms = friction_terms(drive, friction);
  const ReferredOutput output = refer_output(drive);
  const double ratio = drive.gearbox.ratio;
  for (const auto& [number, value] : changes) {
    if (number.kind != Kind::feedback) continue;
    const double added = output.torque * ratio * (number.scale * value);
    friction += added;
    result.friction_terms += added;
  }
  return result;
}

bool ChangeableDrive::is_sound(const Changed& changed) const {
  const double friction = changed.drivetrain.motor_friction;
  const bool is_known =
      friction == changed.friction_terms || friction > least_left * changed.friction_terms;
  return is_known && validate(changed.drivetrain).empty();
}

Drivetrain ChangeableDrive::with(std::string_view name, double value) const {
  return changed({{number(name), value}}).drivetrain;
}

Drivetrain ChangeableDrive::with(std::string_view name, double value, std::string_view other,
                                 double other_value) const {
  return changed({{number(name), value}, {number(other), other_value}}).drivetrain;
}

DrivetrainSlopes ChangeableDrive::slopes(std::string_view name) const {
  const ChangeableNumber& of = number(name);
  if (of.kind == ChangeableNumber::Kind::parameter) return *drivetrain_slopes(drive_, of.name);
  const Drive physical = physical_form(drive_);
  if (of.kind == ChangeableNumber::Kind::feedback) {
    return {.motor_friction = refer_output(physical).torque * physical.gearbox.ratio * of.scale};
  }
  DrivetrainSlopes slopes = *drivetrain_slopes(physical, of.parameter->path);
  for (double* slope : {&slopes.motor_inertia, &slopes.load_inertia, &slopes.motor_friction,
                        &slopes.load_friction, &slopes.stiffness}) {
    *slope *= of.scale;
  }
  return slopes;
}

Bounds ChangeableDrive::range(std::string_view name) const {
  constexpr double factor = 1e3;
  constexpr double times_critical = 10.0;
  const ChangeableNumber& of = number(name);
  const double present = of.present;
  // Moves a wanted value towards the present one, which is sound, until it is sound itself.
  const auto reach = [&](double wanted) {
    constexpr int halvings = 200;
    for (int i = 0; i < halvings && !is_sound(changed({{of, wanted}})); ++i) {
      wanted = 0.5 * (present + wanted);
    }
    return wanted;
  };
  const bool is_share = of.is_restitution() || of.name == "servo.friction_ratio";
  if (is_share) return {reach(0.0), reach(1.0)};
  const DrivetrainSlopes by = slopes(name);
  const double friction = by.motor_friction + by.load_friction;
  if (by.stiffness == 0.0 && by.motor_inertia == 0.0 && by.load_inertia == 0.0 && friction > 0.0) {
    const double critical = 2.0 * std::sqrt(drivetrain_.stiffness) *
                            std::sqrt(drivetrain_.motor_inertia + drivetrain_.load_inertia);
    return {reach(0.0), reach(times_critical * critical / friction)};
  }
  if (present == 0.0 || std::isinf(present)) return {present, present};  // has no multiples
  const double low = reach(present / factor);
  const double high = reach(present * factor);
  return {std::min(low, high), std::max(low, high)};
}

/// Between two sound drives that differ in one number, every number of the drivetrain is monotone
/// in that number (formulas in drivetrain_slopes()), so box_between() contains all drives between
/// them. Most are linear in the number or its reciprocal, or go as its square. The exceptions are
/// 1/(1 + r) and the friction (f + E) n² + T n d of a ratio and feedback d < 0, which rises
/// wherever it is not negative.
DriveBox ChangeableDrive::box(std::string_view name, const Bounds& values) const {
  const ChangeableNumber& of = number(name);
  const Changed low = changed({{of, values.low}});
  const Changed high = changed({{of, values.high}});
  DataError error = data_error_;
  for (const Changed* end : {&low, &high}) {
    const double friction = end->drivetrain.motor_friction;
    if (end->friction_terms > friction) {
      error.motor_friction =
          std::max(error.motor_friction, data_error_.each * (end->friction_terms / friction));
    }
  }
  return box_between(low.drivetrain, high.drivetrain, error);
}

}  // namespace gearlash
