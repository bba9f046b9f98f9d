#include "question/map/grid_points.hpp"

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

std::vector<std::vector<double>> corners_of(const Grid& grid) {
  std::vector<std::vector<double>> corners = {{}};
  for (const Axis& axis : grid.axes) {
    if (axis.values.empty()) continue;
    const std::size_t others = corners.size();
    for (std::size_t i = 0; i < others; ++i) {
      corners.push_back(corners[i]);
      corners[i].push_back(axis.values.front());
      corners.back().push_back(axis.values.back());
    }
  }
  return corners;
}

GridPoints::GridPoints(const Grid& grid) : drive_(grid.drive) {
  for (const Axis& axis : grid.axes) axes_.push_back({axis.path, {}, axis.logarithmic});
  members_ = members_of(axes_);
  if (drive_.servo && members_.size() == axes_.size()) {
    Drive any = drive_;  // because the drive's own numbers may be at fault
    any.servo = NormalForm{.damping = 0.5,
                           .inertia_ratio = 1.0,
                           .friction_ratio = 0.5,
                           .backlash = 1.0,
                           .natural_frequency = drive_.servo->natural_frequency};
    servo_ = faults(any).empty() ? final_servo(any) : std::nullopt;
    if (servo_) {
      const NormalForm& form = *drive_.servo;
      servo_->closed_form.servo = {.damping = form.damping,
                                   .inertia_ratio = form.inertia_ratio,
                                   .friction_ratio = form.friction_ratio,
                                   .backlash = form.backlash,
                                   .restitution = servo_->closed_form.servo.restitution};
    }
  }
  for (const std::vector<double>& corner : corners_of(grid)) {
    const Drive drive = drive_at(corner);
    if (!faults(drive).empty()) continue;
    const std::optional<FinalServo> servo = final_servo(drive);
    (servo ? engines_.closed_form : engines_.search) = true;
    if (servo && servo->closed_form.servo.restitution > 0.0) engines_.bounces = true;
  }
}

Drive GridPoints::drive_at(std::span<const double> values) const {
  Drive drive = drive_;
  set_on(axes_, drive, values);
  return drive;
}

NormalizedServo GridPoints::normal_form_at(std::span<const double> values) const {
  NormalizedServo servo = servo_->closed_form.servo;
  for (std::size_t i = 0; i < values.size(); ++i) servo.*members_[i] = values[i];
  return servo;
}

std::optional<FinalServo> GridPoints::servo_at(std::span<const double> values) const {
  if (servo_) {
    FinalServo point = *servo_;
    point.closed_form.servo = normal_form_at(values);
    return faults(point.closed_form.servo).empty() ? std::optional(point) : std::nullopt;
  }
  const Drive drive = drive_at(values);
  return faults(drive).empty() ? final_servo(drive) : std::nullopt;
}

}  // namespace gearlash
