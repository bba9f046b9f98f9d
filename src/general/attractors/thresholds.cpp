#include "general/attractors/thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/lists.hpp"

namespace gearlash::drive {
namespace {

/// A start at rest, both shafts displaced together.
struct Step {
  double size;
  double face;  ///< the motor less the load, rad
  MotionEnd end;
};

bool leads_to(MotionEnd end, MotionEnd wanted) {
  return end == wanted || (wanted == MotionEnd::cycle && end == MotionEnd::irregular);
}

std::vector<Step> steps_towards(double direction, double reference,
                                const std::vector<Outcome>& outcomes) {
  std::vector<Step> steps;
  for (const Outcome& outcome : outcomes) {
    const ShaftStates& start = outcome.start;
    const double offset = start.load_position - reference;
    const bool is_at_rest = start.load_speed == 0.0 && start.motor_speed == 0.0;
    if (!is_at_rest || !(offset * direction > 0.0)) continue;
    steps.push_back({std::abs(offset), start.motor_position - start.load_position, outcome.end});
  }
  sort_by(steps, &Step::size);
  return steps;
}

}  // namespace

std::vector<Threshold> thresholds_of(const SearchSetting& setting,
                                     const std::vector<Outcome>& outcomes, int bisections,
                                     const std::function<MotionEnd(const ShaftStates&)>& end_of) {
  std::vector<Threshold> thresholds;
  const bool stands = std::holds_alternative<double>(setting.drive.reference) &&
                      !std::holds_alternative<Sine>(setting.drive.load_torque);
  if (!stands) return thresholds;
  const double reference = middle_of(setting.drive.reference);
  const auto seek = [&](const std::vector<Step>& steps, MotionEnd wanted, double direction) {
    const auto first = std::find_if(steps.begin(), steps.end(),
                                    [&](const Step& step) { return leads_to(step.end, wanted); });
    if (first == steps.end()) return;
    Threshold found{.end = wanted == MotionEnd::diverges ? "running away" : "hunting",
                    .direction = direction,
                    .from = first->size};
    for (auto step = steps.begin(); step != first; ++step) {
      if (step->size < first->size && step->end != MotionEnd::undecided) found.below = step->size;
    }
    for (int i = 0; found.below > 0.0 && i < bisections; ++i) {
      const double middle = std::sqrt(found.below * found.from);
      const double load = reference + direction * middle;
      const MotionEnd end = end_of({load + first->face, 0.0, load, 0.0});
      if (end == MotionEnd::undecided) break;
      (leads_to(end, wanted) ? found.from : found.below) = middle;
    }
    thresholds.push_back(found);
  };
  for (const double direction : {1.0, -1.0}) {
    const std::vector<Step> steps = steps_towards(direction, reference, outcomes);
    for (const MotionEnd wanted : {MotionEnd::cycle, MotionEnd::diverges}) {
      seek(steps, wanted, direction);
    }
  }
  if (is_mirrored(setting.drive)) {
    for (Threshold& threshold : thresholds) threshold.direction = 0.0;
  }
  return thresholds;
}

}  // namespace gearlash::drive
