#include "question/family/family.hpp"

#include <algorithm>

#include "model/parameter_values.hpp"

namespace gearlash {
namespace {

/// Empty if an axis is not a number of the normal form.
std::vector<double NormalizedServo::*> members_of(const std::vector<Axis>& axes) {
  std::vector<double NormalizedServo::*> members;
  for (const Axis& axis : axes) {
    const NormalFormNumber* number = normal_form_number(axis.path);
    if (number == nullptr) return {};
    members.push_back(number->member);
  }
  return members;
}

/// Where a number of the drive lies; nullptr for a word, an element of a list, another form, and
/// for what the drive does not have.
double* place_in(Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  if (parameter == nullptr) return nullptr;
  const OtherForm* form = form_named(*parameter, path);
  if (form != nullptr && form->relation != Relation::same) return nullptr;
  const Slot slot = parameter->slot(drive);
  if (auto* const* number = std::get_if<double*>(&slot)) return *number;
  if (auto* const* given = std::get_if<std::optional<double>*>(&slot)) {
    return &(*given)->emplace((*given)->value_or(1.0));
  }
  return nullptr;
}

/// Empty for an unsound drive, or one that must be searched.
std::optional<ProportionalServo> servo_of(const Drive& drive) {
  const std::optional<SoundDrive> sound = SoundDrive::of(drive);
  return sound ? settled_servo(*sound) : std::nullopt;
}

/// The servo of a normal form whose own numbers do not matter, because they vary.
std::optional<ProportionalServo> shared_servo(const Drive& drive) {
  Drive any = drive;  // because the drive's own numbers may be at fault
  any.servo = NormalForm{.damping = 0.5,
                         .inertia_ratio = 1.0,
                         .friction_ratio = 0.5,
                         .backlash = 1.0,
                         .natural_frequency = drive.servo->natural_frequency};
  std::optional<ProportionalServo> servo = servo_of(any);
  if (!servo) return servo;
  servo->servo = servo_with_restitution(*drive.servo, servo->servo.restitution);
  return servo;
}

/// A breakaway torque that does not vary by itself keeps its ratio to the Coulomb friction.
void keep_ratio(Friction& changed, const Friction& base, const std::vector<Axis>& axes,
                std::string_view path) {
  const bool is_changed = changed.coulomb != base.coulomb && base.coulomb > 0.0;
  const bool varies = std::any_of(axes.begin(), axes.end(), [&](const Axis& axis) {
    const Parameter* parameter = find_parameter(axis.path);
    return parameter != nullptr && parameter->path == path;
  });
  if (!changed.breakaway || !is_changed || varies) return;
  // Rounding must not make it the smaller of the two.
  changed.breakaway =
      std::max(*changed.breakaway * (changed.coulomb / base.coulomb), changed.coulomb);
}

}  // namespace

std::vector<double> values_at(const Grid& grid, std::size_t index) {
  std::vector<double> values(grid.axes.size());
  for (std::size_t i = values.size(); i-- > 0;) {
    const std::vector<double>& of_axis = grid.axes[i].values;
    values[i] = of_axis[index % of_axis.size()];
    index /= of_axis.size();
  }
  return values;
}

std::vector<std::vector<double>> corners_of(std::span<const Bounds> ranges) {
  std::vector<std::vector<double>> corners = {{}};
  for (const Bounds& range : ranges) {
    const std::size_t others = corners.size();
    for (std::size_t i = 0; i < others; ++i) {
      if (range.low != range.high) {
        corners.push_back(corners[i]);
        corners.back().push_back(range.high);
      }
      corners[i].push_back(range.low);
    }
  }
  return corners;
}

std::vector<std::vector<double>> corners_of(const std::vector<Axis>& axes) {
  constexpr std::size_t most_axes = 12;
  if (axes.size() > most_axes) {
    std::vector<std::vector<double>> corners = {{}};
    for (const Axis& axis : axes) corners.front().push_back(axis.values.front());
    for (std::size_t i = 0; i < axes.size(); ++i) {
      corners.push_back(corners.front());
      corners.back()[i] = axes[i].values.back();
    }
    return corners;
  }
  std::vector<Bounds> ranges;
  for (const Axis& axis : axes) {
    if (!axis.values.empty()) ranges.push_back({axis.values.front(), axis.values.back()});
  }
  return corners_of(ranges);
}

Drive drive_with(const Drive& base, const std::vector<Axis>& axes, std::span<const double> values,
                 Breakaway breakaway) {
  Drive drive = base;
  set_on(axes, drive, values);
  if (breakaway == Breakaway::keeps_its_ratio) {
    keep_ratio(drive.motor.friction, base.motor.friction, axes, "motor.breakaway");
    keep_ratio(drive.load.friction, base.load.friction, axes, "load.breakaway");
  }
  return drive;
}

Family::Family(Drive base, const std::vector<Axis>& axes, Breakaway breakaway)
    : base_(std::move(base)), breakaway_(breakaway) {
  for (const Axis& axis : axes) axes_.push_back({axis.path, {}, axis.logarithmic});
  members_ = members_of(axes_);
  if (base_.servo && members_.size() == axes_.size()) normal_form_ = shared_servo(base_);
  bool are_all_closed = !normal_form_;
  for (const std::vector<double>& corner : corners_of(axes)) {
    const Drive drive = drive_at(corner);
    const std::optional<SoundDrive> sound = SoundDrive::of(drive);
    const std::optional<ProportionalServo> servo = sound ? settled_servo(*sound) : std::nullopt;
    are_all_closed = are_all_closed && servo;
    if (!sound) continue;
    (servo ? engines_.solution : engines_.search) = true;
    if (servo && servo->servo.restitution > 0.0) engines_.bounces = true;
    if (are_all_closed && !closed_) closed_ = without_ended_signals(drive);
  }
  if (!are_all_closed) closed_.reset();
}

NormalizedServo Family::normal_form_at(std::span<const double> values) const {
  NormalizedServo servo = normal_form_->servo;
  for (std::size_t i = 0; i < values.size(); ++i) servo.*members_[i] = values[i];
  return servo;
}

std::optional<ProportionalServo> Family::servo_at(std::span<const double> values) const {
  if (normal_form_) {
    ProportionalServo point = *normal_form_;
    point.servo = normal_form_at(values);
    return faults(point.servo).empty() ? std::optional(point) : std::nullopt;
  }
  return servo_of(drive_at(values));
}

FamilyMember::FamilyMember(const Family& family) : drive_(family.closed_) {
  if (!drive_) return;
  for (const Axis& axis : family.axes_) places_.push_back(place_in(*drive_, axis.path));
  is_whole_ = std::find(places_.begin(), places_.end(), nullptr) == places_.end();
}

std::optional<ProportionalServo> FamilyMember::servo(std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) *places_[i] = values[i];
  const ProportionalServo servo = servo_without_checks(*drive_);
  return faults(servo.servo).empty() ? std::optional(servo) : std::nullopt;
}

}  // namespace gearlash
