#include "question/change/design.hpp"

#include <algorithm>
#include <utility>

#include "base/progress_part.hpp"
#include "question/analyse.hpp"
#include "question/axis.hpp"
#include "question/change/values.hpp"

namespace gearlash {
namespace {

/// Without an axis the drive is as it is. `known`: its analysis by a search, or nullptr.
DriveWithValue with_value(const Drive& base, const Axis* axis, double value, const Target& target,
                          Progress& progress, const AnalysedLine::Known& known = nullptr) {
  Wanted wanted = wanted_for(target);
  wanted.borders = true;
  for (const Quantity cost : {Quantity::bandwidth, Quantity::overshoot}) {
    ask_for(cost, wanted);
  }
  Drive drive = base;
  if (axis != nullptr) set_on(*axis, drive, value);
  if (!known) return {.value = value, .answer = analyse(drive, wanted, progress)};
  DriveWithValue one{.value = value, .answer = known->answer};
  add_figures(drive, wanted, one.answer, progress);
  return one;
}

Judgement judge_present(const Drive& drive, const Target& target, const Answer& present) {
  const Judgement at_point = is_met(target, present)     ? Judgement::all
                             : is_known(target, present) ? Judgement::none
                                                         : Judgement::some;
  const std::optional<AnswerBounds> bounds = proved_bounds(drive, present);
  if (!bounds) return at_point;
  const auto [bounded, others] = parts_of(target, [](Quantity one) { return is_of_boxes(one); });
  const Judgement proved = judge(bounded, *bounds);
  return is_empty(others) || proved == Judgement::none ? proved : std::min(proved, at_point);
}

}  // namespace

Design design(const Drive& drive, const std::vector<Axis>& axes, const Target& target,
              Progress& progress) {
  Design found{.present = with_value(drive, nullptr, 0.0, target, progress)};
  found.met = judge_present(drive, target, found.present.answer);
  for (const Axis& axis : axes) {
    ProgressPart part(progress, found.parameters.size(), axes.size());
    AnalysedLine::Known at_closest;
    DesignedParameter parameter{.values = values(drive, axis, target, part, at_closest)};
    for (const double value : parameter.values.nearest_of_each()) {
      parameter.results.push_back(with_value(drive, &axis, value, target, part, at_closest));
    }
    found.parameters.push_back(std::move(parameter));
    if (!part.go_on(1.0)) break;
  }
  return found;
}

}  // namespace gearlash
