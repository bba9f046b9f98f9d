#include "question/change/derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/design.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameter_values.hpp"
#include "question/axis.hpp"
#include "question/change/orbit_derivatives.hpp"
#include "question/final_servo.hpp"

namespace gearlash {
namespace {

/// The chain rule: `by` holds the drivetrain's slopes with respect to a number, `of` a quantity's
/// slopes with respect to the drivetrain.
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

/// The slopes of the normalized parameters and of ln ω_n.
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

}  // namespace

const QuantitySlopes* DrivetrainSensitivity::find(Quantity quantity) const {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const auto& one) { return one.quantity == quantity; });
  return found == quantities.end() ? nullptr : &*found;
}

QuantitySlopes drivetrain_growth(const Drivetrain& drive) {
  const NormalizedServo servo = normalize(drive);
  const SensitiveValue growth = growth_sensitivity(servo);
  return {Quantity::growth_at_rest, growth.value,
          Normalization(drive, servo).slopes_of(growth.slope)};
}

DrivetrainSensitivity drivetrain_sensitivity(const Drivetrain& drive) {
  const NormalizedServo servo = normalize(drive);
  const CycleSensitivity cycle = cycle_sensitivity(servo);
  DrivetrainSensitivity sensitivity{.outcome = cycle.outcome};
  const Normalization normalization(drive, servo);
  const auto add = [&](Quantity quantity, const SensitiveValue& value) {
    if (std::isnan(value.value)) return;
    sensitivity.quantities.push_back({quantity, value.value, normalization.slopes_of(value.slope)});
  };
  add(Quantity::growth_at_rest, cycle.growth_at_rest);
  add(Quantity::amplitude, cycle.amplitude);
  add(Quantity::multiplier, cycle.multiplier);
  if (!cycle.available()) return sensitivity;
  // In seconds: T = T′/ω_n, dT = (dT′ − T′ d ln ω_n)/ω_n; and f = 1/T.
  const double unit = 1.0 / natural_frequency(drive);
  const double period = cycle.period.value * unit;
  const DrivetrainSlopes slopes = sum(scaled(unit, normalization.slopes_of(cycle.period.slope)),
                                      scaled(-period, normalization.log_frequency()));
  sensitivity.quantities.push_back({Quantity::period, period, slopes});
  sensitivity.quantities.push_back(
      {Quantity::frequency, 1.0 / period, scaled(-1.0 / (period * period), slopes)});
  return sensitivity;
}

namespace {

std::string reason(SensitivityOutcome outcome) {
  switch (outcome) {
    case SensitivityOutcome::no_cycle:
      return "there is no limit cycle, so only growth at rest has them";
    case SensitivityOutcome::undecided:
      return "the servo lies on the boundary of hunting, so only growth at rest has them";
    case SensitivityOutcome::undamped:
      return "not computed without damping";
    case SensitivityOutcome::bounces:
      return "not computed for this motion, in which faces bounce";
    case SensitivityOutcome::available:
      break;
  }
  return "";
}

/// By the number as it is named, which may be a reciprocal.
std::optional<DrivetrainSlopes> slopes_by(const Drive& drive, const std::string& name) {
  std::optional<DrivetrainSlopes> slopes = drivetrain_slopes(drive, name);
  const Parameter* parameter = find_parameter(name);
  const OtherForm* form = slopes ? form_named(*parameter, name) : nullptr;
  if (form == nullptr || form->dimension == nullptr) return slopes;
  const double value = get(drive, name);
  return scaled(-form->inverse / (value * value), *slopes);
}

/// The Jacobian with respect to numbers of the drive, by the chain rule.
Jacobian jacobian_of(const Drive& drive, std::span<const Quantity> quantities,
                     const std::vector<std::string>& names) {
  const Drive closed = *closed_form_drive(drive);
  const DrivetrainSensitivity found = drivetrain_sensitivity(referred_drivetrain(closed));
  Jacobian jacobian{.reason = reason(found.outcome)};
  jacobian.quantities.assign(quantities.begin(), quantities.end());
  std::vector<DrivetrainSlopes> by_name;
  RangeCheck check;
  for (const std::string& name : names) {
    const std::string path = path_named(name, closed);
    if (const std::optional<DrivetrainSlopes> slopes = slopes_by(closed, path)) {
      jacobian.paths.push_back(path);
      jacobian.present.push_back(get(closed, path));
      by_name.push_back(*slopes);
    } else {
      check.refuse("paths", name, "must be a number of this drive that enters its closed form");
    }
  }
  require_none(check.faults());
  for (const Quantity quantity : quantities) {
    const QuantitySlopes* of = found.find(quantity);
    jacobian.values.push_back(of == nullptr ? std::nullopt : std::optional(of->value));
    for (const DrivetrainSlopes& by : by_name) {
      jacobian.slopes.push_back(known(of == nullptr ? not_a_number : chained(by, of->slopes)));
    }
  }
  return jacobian;
}

}  // namespace

Jacobian drive_sensitivity(const Drive& drive, const std::vector<std::string>& names) {
  return jacobian_of(drive, differentiable, names);
}

Jacobian drive_sensitivity(const Drive& drive) {
  if (drive.servo) return drive_sensitivity(drive, usual_parameters(drive));
  const Drive closed = *closed_form_drive(drive);
  std::vector<std::string> names;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const bool is_its_own = find_parameter(parameter.path, closed) == &parameter;
    if (is_its_own && drivetrain_slopes(closed, parameter.path)) names.emplace_back(parameter.path);
  }
  return drive_sensitivity(drive, names);
}

std::optional<double> Jacobian::slope(std::size_t quantity, std::size_t parameter) const {
  if (parameter >= paths.size()) throw std::out_of_range("no such parameter of the Jacobian");
  return slopes.at(quantity * paths.size() + parameter);
}

std::optional<double> Jacobian::elasticity(std::size_t quantity, std::size_t parameter) const {
  const std::optional<double> by = slope(quantity, parameter);
  if (!by || !values[quantity]) return std::nullopt;
  const double ratio = present[parameter] * *by / *values[quantity];
  return std::isnan(ratio) ? std::nullopt : std::optional(ratio);
}

Jacobian derivatives(const Drive& drive, std::span<const Quantity> quantities,
                     std::span<const std::string_view> paths, Progress& progress) {
  RangeCheck check;
  for (const Quantity quantity : quantities) {
    const auto is_among = [&](const auto& all) {
      return std::find(all.begin(), all.end(), quantity) != all.end();
    };
    if (!is_among(differentiable) && !is_among(differentiable_by_search)) {
      check.refuse("quantities", std::string(name_of(quantity)),
                   "must be amplitude, motor_amplitude, center, period, frequency, multiplier or "
                   "growth_at_rest");
    }
  }
  require_none(check.faults());
  const std::vector<std::string> names(paths.begin(), paths.end());
  require_none(faults(drive));
  if (!closed_form_drive(drive)) return searched_derivatives(drive, quantities, names, progress);
  return jacobian_of(drive, quantities, names);
}

Jacobian derivatives(const Drive& drive, std::initializer_list<Quantity> quantities,
                     std::initializer_list<std::string_view> paths) {
  return derivatives(drive, std::span(quantities.begin(), quantities.size()),
                     std::span(paths.begin(), paths.size()));
}

}  // namespace gearlash
