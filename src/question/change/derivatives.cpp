#include "question/change/derivatives.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/lists.hpp"
#include "base/progress_part.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/closed_answer.hpp"
#include "gearlash/design.hpp"
#include "gearlash/parameter.hpp"
#include "model/proportional_servo.hpp"
#include "question/axis.hpp"
#include "question/change/margins.hpp"
#include "question/change/orbit_derivatives.hpp"
#include "question/change/servo_line.hpp"
#include "question/family/family.hpp"

namespace gearlash {
namespace {

/// A servo with a closed form, and its limit cycle seen in practice.
struct PresentServo {
  explicit PresentServo(const ProportionalServo& of) : servo(of.servo) {
    if (servo.damping == 0.0) {
      reason = "not computed without damping";
      return;
    }
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    if (const LimitCycle* largest = largest_stable(analysis)) {
      cycle = *largest;
    } else {
      reason = analysis.verdict == Verdict::undecided
                   ? "the servo lies on the boundary of hunting, so only growth at rest has them"
                   : "there is no limit cycle, so only growth at rest has them";
    }
  }

  Answer answer_beside(const ProportionalServo& of) const {
    if (servo.damping == 0.0) return {};
    const LimitCycle* near = cycle ? &*cycle : nullptr;
    return answer_of(analyse_beside(of.servo, near, servo), of);
  }

  NormalizedServo servo;
  std::optional<LimitCycle> cycle{};
  std::string reason{};  ///< why it has no derivatives
};

/// The change of a number that makes the drivetrain another one.
double unit_on(const ServoLine& line) {
  const double present = line.present();
  if (present != 0.0) return std::abs(present);
  const std::optional<ProportionalServo> here = line.at(0.0);
  const std::optional<ProportionalServo> there = line.at(1.0);
  if (!here || !there) return 1.0;
  const Drivetrain& from = here->drivetrain;
  const Drivetrain& to = there->drivetrain;
  const double share = (std::abs(to.motor_inertia - from.motor_inertia) +
                        std::abs(to.load_inertia - from.load_inertia)) /
                           (from.motor_inertia + from.load_inertia) +
                       (std::abs(to.motor_friction - from.motor_friction) +
                        std::abs(to.load_friction - from.load_friction)) /
                           (from.motor_friction + from.load_friction);
  return share > 0.0 && std::isfinite(share) ? 1.0 / share : 1.0;
}

/// Bounces act as the cube of their restitution (docs/explanation/motions.md, Settling): all slopes
/// by one of 0 are 0.
bool is_plastic_restitution(const std::string& path, double present) {
  return present == 0.0 && find_parameter(path)->path == "contact.restitution";
}

/// With respect to numbers of a drive with a closed form.
Jacobian jacobian_of(const Drive& drive, std::span<const Quantity> quantities,
                     const std::vector<std::string>& names) {
  const Drive closed = without_ended_signals(drive);
  const ProportionalServo servo = servo_without_checks(closed);
  const PresentServo present(servo);
  const Answer known = present.answer_beside(servo);
  std::vector<std::string> paths;
  std::vector<double> presents;
  std::vector<ServoLine> lines;
  RangeCheck check;
  for (const std::string& name : names) {
    const std::string path = path_named(name, closed);
    if (auto line = ServoLine::along(closed, path)) {
      paths.push_back(path);
      presents.push_back(line->present());
      lines.push_back(*std::move(line));
    } else {
      check.refuse("paths", name, "must be a number of this drive that enters its closed form");
    }
  }
  require_none(check.faults());
  Jacobian jacobian = without_slopes(quantities, std::move(paths), std::move(presents), known);
  jacobian.reason = present.reason;
  for (std::size_t j = 0; j < lines.size(); ++j) {
    const auto answer_at = [&](double value) -> Answer {
      if (is_plastic_restitution(jacobian.paths[j], jacobian.present[j])) return Answer(known);
      if (lines[j].is_backlash() && lines[j].present() > 0.0) return with_backlash(known, value);
      const std::optional<ProportionalServo> beside = lines[j].at(value);
      return beside ? present.answer_beside(*beside) : Answer{};
    };
    set_slopes(jacobian, j, answer_at, {.unit = unit_on(lines[j])});
  }
  return jacobian;
}

}  // namespace

Jacobian without_slopes(std::span<const Quantity> quantities, std::vector<std::string> paths,
                        std::vector<double> present, const Answer& answer) {
  Jacobian jacobian{.quantities = {quantities.begin(), quantities.end()},
                    .paths = std::move(paths),
                    .values = of_each(quantities, [&](Quantity one) { return answer.value(one); }),
                    .present = std::move(present),
                    .slopes = {},
                    .reason = {}};
  jacobian.slopes.resize(quantities.size() * jacobian.paths.size());
  return jacobian;
}

void set_slopes(Jacobian& jacobian, std::size_t parameter, const AnswerAt& answer_at,
                DifferenceSteps steps) {
  const NumbersAt numbers_at = [&](double value) {
    return of_each(jacobian.quantities, [answer = answer_at(value)](Quantity quantity) {
      return answer.value(quantity).value_or(not_a_number);
    });
  };
  const double present = jacobian.present[parameter];
  const double amplitude = answer_at(present).value(Quantity::amplitude).value_or(0.0);
  for (std::size_t i = 0; i < jacobian.quantities.size(); ++i) {
    const double size = std::abs(jacobian.values[i].value_or(0.0));
    steps.sizes.push_back(jacobian.quantities[i] == Quantity::center ? size + amplitude : size);
  }
  const std::vector<Difference> found = differences(numbers_at, present, steps);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (jacobian.quantities[i] == Quantity::amplitude && amplitude == 0.0) continue;
    jacobian.slopes[i * jacobian.paths.size() + parameter] = known(found[i].slope);
  }
}

Jacobian drive_sensitivity(const Drive& drive) {
  if (drive.servo) return jacobian_of(drive, differentiable, usual_parameters(drive));
  const Drive closed = without_ended_signals(drive);
  std::vector<std::string> names;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const bool is_its_own = find_parameter(parameter.path, closed) == &parameter;
    if (is_its_own && enters_servo(closed, parameter.path)) names.emplace_back(parameter.path);
  }
  return jacobian_of(drive, differentiable, names);
}

Jacobian sensitivities(const Drive& drive, const Analysis& analysis, Progress& progress) {
  if (!analysis.servo) {
    return orbit_derivatives(drive, analysis, differentiable_by_search, numbers_of_orbits(drive),
                             progress);
  }
  return has_margins(analysis) ? drive_sensitivity(drive) : Jacobian{};
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

std::vector<std::optional<double>> Jacobian::elasticities() const {
  return of_each(indices(slopes.size()),
                 [&](std::size_t i) { return elasticity(i / paths.size(), i % paths.size()); });
}

Jacobian derivatives(const Drive& drive, std::span<const Quantity> quantities,
                     std::span<const std::string_view> paths, Progress& progress) {
  RangeCheck check;
  for (const Quantity quantity : quantities) {
    if (!contains(differentiable, quantity) && !contains(differentiable_by_search, quantity)) {
      check.refuse("quantities", std::string(name_of(quantity)),
                   "must be amplitude, motor_amplitude, center, period, frequency, multiplier or "
                   "growth_at_rest");
    }
  }
  require_none(check.faults());
  const std::vector<std::string> names(paths.begin(), paths.end());
  require_none(faults(drive));
  if (!engines_of(drive).search) return jacobian_of(drive, quantities, names);
  presents_of(drive, names);  // before the search
  ProgressPart search(progress, 0.0, 0.5);
  ProgressPart rest(progress, 0.5, 1.0);
  return orbit_derivatives(drive, analyse_in_full(drive, {}, search), quantities, names, rest);
}

Jacobian derivatives(const Drive& drive, std::initializer_list<Quantity> quantities,
                     std::initializer_list<std::string_view> paths) {
  return derivatives(drive, std::span(quantities.begin(), quantities.size()),
                     std::span(paths.begin(), paths.size()));
}

}  // namespace gearlash
