#include "question/change/servo_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/special_numbers.hpp"
#include "closed_form/closed_answer.hpp"
#include "closed_form/drive_box.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "model/parameter_values.hpp"
#include "model/reduced_drive.hpp"
#include "question/axis.hpp"
#include "question/change/value_scan.hpp"

namespace gearlash {

std::optional<ServoLine> ServoLine::along(const Drive& drive, const std::string& path) {
  Drive settled = without_ended_signals(drive);
  const bool is_on_it = proportional_servo(settled) && parameter_of({.path = path}, settled) &&
                        enters_servo(settled, path);
  return is_on_it ? std::optional(ServoLine(std::move(settled), path)) : std::nullopt;
}

ServoLine::ServoLine(Drive drive, std::string path)
    : drive_(std::move(drive)),
      axis_{.path = std::move(path)},
      parameter_(parameter_of(axis_, drive_)->path),
      drivetrain_(referred_drivetrain(drive_)),
      present_(present_value(axis_, drive_).value_or(not_a_number)) {}

Drive ServoLine::drive_at(double value) const {
  Drive drive = drive_;
  set_on(axis_, drive, value);
  return drive;
}

std::optional<ProportionalServo> ServoLine::at(double value) const {
  const ProportionalServo servo = servo_without_checks(drive_at(value));
  return faults(servo.drivetrain).empty() ? std::optional(servo) : std::nullopt;
}

Answer ServoLine::answer_at(double value) const {
  const std::optional<ProportionalServo> servo = at(value);
  return servo ? answer_of(*servo) : Answer{};
}

Answer ServoLine::answer_at(double value, const Target& target) const {
  const std::optional<ProportionalServo> servo = at(value);
  if (!servo) return {};
  const NormalizedServo& normal = servo->servo;
  if (normal.restitution == 0.0 || normal.backlash == 0.0) return answer_of(*servo);
  const double growth = growth_at_rest(servo_dynamics(normal));
  if (!is_ruled_out(target, growth)) return answer_of(*servo);
  Answer answer;
  answer.verdict = growth > 1.0 ? Verdict::hunts : Verdict::undecided;
  answer.growth_at_rest = growth;
  return answer;
}

double ServoLine::growth_at(double value) const {
  const std::optional<ProportionalServo> servo = at(value);
  return servo ? growth_at_rest(servo_dynamics(servo->servo)) : not_a_number;
}

/// Between two sound drives that differ in one number, every number of the drivetrain is monotone
/// in that number (formulas in referred_drivetrain()), so box_between() contains all drives between
/// them. Most are linear in the number or its reciprocal, or go as its square. The exceptions are
/// 1/(1 + r) and the friction (f + E) n² + T n d of a ratio and feedback d < 0, which rises
/// wherever it is not negative.
DriveBox ServoLine::box(const Bounds& values) const {
  const Drive low = drive_at(values.low);
  const Drive high = drive_at(values.high);
  const Drivetrain at_low = referred_drivetrain(low);
  const Drivetrain at_high = referred_drivetrain(high);
  DataError error = data_error_of(drive_, drivetrain_);
  for (const DataError& of_end : {data_error_of(low, at_low), data_error_of(high, at_high)}) {
    error.motor_friction = std::max(error.motor_friction, of_end.motor_friction);
  }
  return box_between(at_low, at_high, error);
}

AnswerBounds ServoLine::bounds(const Bounds& values) const {
  double guess = not_a_number;
  for (const double value : {middle_value(values.low, values.high), values.low, values.high}) {
    if (std::isnan(guess)) guess = flight_time_of(answer_at(value));
  }
  return bounds_of(box(values), guess);
}

bool ServoLine::is_sound_at(double value) const {
  const Drive drive = drive_at(value);
  const Drivetrain drivetrain = referred_drivetrain(drive);
  return has_resolved_friction(drive, drivetrain) && faults(drivetrain).empty();
}

bool ServoLine::is_backlash() const {
  return parameter_ == "servo.backlash" || parameter_ == "gearbox.backlash";
}

bool ServoLine::is_share() const {
  return parameter_ == "contact.restitution" || parameter_ == "servo.friction_ratio";
}

bool ServoLine::has_bounces() const {
  const bool has_two_masses = drivetrain_.motor_inertia > 0.0 && drivetrain_.load_inertia > 0.0;
  return has_two_masses && (parameter_ == "contact.restitution" || drivetrain_.restitution > 0.0);
}

Bounds ServoLine::range() const {
  constexpr double factor = 1e3;
  constexpr double times_critical = 10.0;
  // Moves a wanted value towards the present one, which is sound, until it is sound itself.
  const auto reach = [&](double wanted) {
    constexpr int halvings = 200;
    for (int i = 0; i < halvings && !is_sound_at(wanted); ++i) wanted = 0.5 * (present_ + wanted);
    return wanted;
  };
  if (is_share()) return {reach(0.0), reach(1.0)};
  // All that only adds friction adds it in proportion.
  const double other = present_ == 0.0 ? 1.0 : 2.0 * present_;
  const Drivetrain from = referred_drivetrain(drive_at(present_));
  const Drivetrain to = referred_drivetrain(drive_at(other));
  const double added =
      to.motor_friction - from.motor_friction + (to.load_friction - from.load_friction);
  const double friction = added / (other - present_);
  if (to.stiffness == from.stiffness && to.motor_inertia == from.motor_inertia &&
      to.load_inertia == from.load_inertia && friction > 0.0) {
    const double critical = 2.0 * std::sqrt(drivetrain_.stiffness) *
                            std::sqrt(drivetrain_.motor_inertia + drivetrain_.load_inertia);
    return {reach(0.0), reach(times_critical * critical / friction)};
  }
  if (present_ == 0.0 || std::isinf(present_)) return {present_, present_};  // has no multiples
  const double low = reach(present_ / factor);
  const double high = reach(present_ * factor);
  return {std::min(low, high), std::max(low, high)};
}

Answer with_backlash(Answer answer, double backlash) {
  const double factor = backlash / answer.normal_form->backlash;
  answer.normal_form->backlash = backlash;
  for (Cycle& cycle : answer.cycles) {
    cycle.amplitude *= factor;
    cycle.motor_amplitude *= factor;
    cycle.impact_speed *= factor;
    if (cycle.mesh_torque) *cycle.mesh_torque *= factor;
    if (cycle.energy) {
      for (double* part : {&cycle.energy->motor, &cycle.energy->motor_friction,
                           &cycle.energy->load_friction, &cycle.energy->impacts}) {
        *part *= factor * factor;
      }
    }
  }
  for (IrregularMotion& motion : answer.irregular) motion.amplitude *= factor;
  return answer;
}

}  // namespace gearlash
