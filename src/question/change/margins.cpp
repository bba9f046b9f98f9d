#include "question/change/margins.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/lists.hpp"
#include "base/progress_part.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "question/axis.hpp"
#include "question/change/analysed_values.hpp"
#include "question/change/overall_margin.hpp"
#include "question/change/target.hpp"
#include "question/change/value_scan.hpp"
#include "question/family/analysed_line.hpp"

namespace gearlash {
namespace {

/// Whether the drive with a value of the parameter is sound.
using IsSoundAt = std::function<bool(double)>;

/// Keeps a border of a drive that rests only if the drive is known to hunt beyond it.
void keep_if_hunting_begins(std::optional<double>& border, double outwards,
                            const FeasibleValues& quiet, const IsSoundAt& is_sound_at) {
  if (!border) return;
  const double range = quiet.searched.high - quiet.searched.low;
  constexpr double nearest = 1e-3;  // of `located`, of the range: what counts as one value
  const double apart = 2.0 * quiet.located * std::max(std::abs(*border), nearest * range);
  if (is_in(quiet.undecided, *border) || !is_sound_at(*border + outwards * apart)) {
    border.reset();
  }
}

void set_choices(const FeasibleValues& quiet, const IsSoundAt& is_sound_at,
                 ParameterMargin& margin) {
  for (const double word : quiet.grid) {
    if (word == quiet.present || is_in(quiet.undecided, word) || !is_sound_at(word)) continue;
    if (quiet.contains(word) == margin.hunts) margin.choices.push_back(word);
  }
}

/// ln(border/present) of the nearer border; infinite if there is none at a finite ratio.
double log_distance(const ParameterMargin& margin) {
  double nearest = infinity;
  for (const std::optional<double>& border : {margin.below, margin.above}) {
    if (!border || !(*border > 0.0) || !(margin.present > 0.0)) continue;
    const double distance = std::log(*border / margin.present);
    if (std::abs(distance) < std::abs(nearest)) nearest = distance;
  }
  return nearest;
}

std::vector<double> factors_along(const std::vector<double>& direction, double length) {
  return of_each(direction, [&](double component) { return std::exp(length * component); });
}

/// The first length at which the drive starts to hunt, or stops. Empty also where its motion beyond
/// is unknown.
std::optional<double> first_border(const FeasibleValues& quiet, bool hunts) {
  if (quiet.intervals.empty()) return std::nullopt;
  const Bounds& first = quiet.intervals.front();
  if (hunts) return first.low > 0.0 ? std::optional(first.low) : std::nullopt;
  const bool is_border =
      first.low == 0.0 && first.high < quiet.searched.high && !is_in(quiet.undecided, first.high);
  return is_border ? std::optional(first.high) : std::nullopt;
}

std::vector<Axis> usual_axes(const Drive& drive) {
  std::vector<Axis> axes;
  for (const std::string& parameter : usual_parameters(drive)) {
    if (parameter == "contact.restitution" && get(drive, parameter) == 0.0) continue;
    axes.push_back(axis_to_search(drive, parameter));
  }
  return axes;
}

}  // namespace

bool has_margins(const Analysis& analysis) {
  return !analysis.servo || faults(analysis.servo->drivetrain).empty();
}

ParameterMargin margin_of(const FeasibleValues& quiet) {
  ParameterMargin margin{.parameter = quiet.parameter,
                         .present = quiet.present,
                         .searched = quiet.searched,
                         .kind = quiet.kind,
                         .hunts = !quiet.contains(quiet.present),
                         .undecided = quiet.undecided,
                         .grid = quiet.grid,
                         .located = quiet.located,
                         .stopped = quiet.stopped};
  const auto take = [&](double end) {
    if (end <= quiet.present) margin.below = std::max(margin.below.value_or(end), end);
    if (end >= quiet.present) margin.above = std::min(margin.above.value_or(end), end);
  };
  for (const Bounds& interval : quiet.intervals) {
    if (interval.low != quiet.searched.low) take(interval.low);
    if (interval.high != quiet.searched.high) take(interval.high);
  }
  return margin;
}

ParameterMargin parameter_margin(const Drive& drive, const Axis& axis, bool hunts,
                                 Progress& progress) {
  const FeasibleValues quiet = values(drive, axis, always_at_rest(), progress);
  ParameterMargin margin = margin_of(quiet);
  margin.hunts = hunts;
  const IsSoundAt is_sound_at = [along = drives_along(axis, drive)](double value) {
    return faults(along(value)).empty();
  };
  if (!parameter_of(axis, drive)->choices.empty()) {
    margin.below.reset();
    margin.above.reset();
    set_choices(quiet, is_sound_at, margin);
    return margin;
  }
  if (hunts || quiet.kind != SearchKind::searched) return margin;
  if (!quiet.contains(quiet.present)) {  // what lies beside it is unknown
    margin.below.reset();
    margin.above.reset();
  }
  keep_if_hunting_begins(margin.below, -1.0, quiet, is_sound_at);
  keep_if_hunting_begins(margin.above, 1.0, quiet, is_sound_at);
  return margin;
}

std::optional<CombinedMargin> combined_margin(const Drive& drive, const std::vector<Axis>& axes,
                                              const std::vector<ParameterMargin>& margins,
                                              bool hunts, Progress& progress) {
  CombinedMargin combined;
  std::vector<double> direction;
  double reach = infinity;
  double square = 0.0;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < margins.size(); ++i) {
    combined.parameters.push_back(margins[i].parameter);
    const double distance = log_distance(margins[i]);
    direction.push_back(1.0 / distance);
    square += 1.0 / (distance * distance);
    if (std::abs(distance) >= reach) continue;
    reach = std::abs(distance);
    nearest = i;
  }
  if (!(square > 0.0) || !std::isfinite(square)) return std::nullopt;
  for (double& component : direction) component /= std::sqrt(square);
  const auto changed = [&](const std::vector<double>& factors) {
    Drive result = drive;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (factors[i] != 1.0) set_on(axes[i], result, margins[i].present * factors[i]);
    }
    return result;
  };
  constexpr std::size_t count = 9;
  FeasibleValues quiet{.searched = {0.0, reach},
                       .grid = linear("length", 0.0, reach, count).values};
  searched_values([&](double length) { return changed(factors_along(direction, length)); },
                  always_at_rest(), wanted_for(always_at_rest()), quiet, progress);
  if (quiet.stopped) return std::nullopt;
  const std::optional<double> length = first_border(quiet, hunts);
  constexpr double beyond = 2.0;  // times what counts as one length
  if (length &&
      faults(changed(factors_along(direction, *length * (1.0 + beyond * quiet.located)))).empty()) {
    combined.factors = factors_along(direction, *length);
    combined.distance = *length;
    combined.located = quiet.located;
    return combined;
  }
  combined.factors.assign(margins.size(), 1.0);
  combined.factors[nearest] = std::exp(std::copysign(reach, direction[nearest]));
  combined.distance = reach;
  combined.located = margins[nearest].located;
  return combined;
}

std::optional<double> ParameterMargin::per_cent_below() const {
  return below && present != 0.0 ? std::optional(100.0 * (*below / present - 1.0)) : std::nullopt;
}

std::optional<double> ParameterMargin::per_cent_above() const {
  return above && present != 0.0 ? std::optional(100.0 * (*above / present - 1.0)) : std::nullopt;
}

HuntingMargin margins(const Drive& drive, const std::vector<Axis>& of, Progress& progress) {
  require_none(faults(drive));
  const std::vector<Axis> axes = of.empty() ? usual_axes(drive) : of;
  const std::size_t parts = axes.size() + 2;
  HuntingMargin margin;
  ProgressPart first(progress, 0, parts);
  const Answer present = analyse(drive, wanted_for(always_at_rest()), first);
  margin.hunts = !is_met(always_at_rest(), present);
  margin.is_known = is_known(always_at_rest(), present);
  margin.growth_at_rest = present.growth_at_rest;
  margin.stopped = present.search && !present.search->is_complete;
  for (const Axis& axis : axes) {
    if (margin.stopped) break;
    ProgressPart part(progress, margin.parameters.size() + 1, parts);
    margin.parameters.push_back(
        parameter_margin(drive, axis, margin.hunts || !margin.is_known, part));
    margin.stopped = margin.parameters.back().stopped;
  }
  if ((margin.overall = overall_margin(drive))) return margin;
  if (margin.stopped || !margin.is_known) return margin;
  ProgressPart last(progress, parts - 1, parts);
  margin.combined = combined_margin(drive, axes, margin.parameters, margin.hunts, last);
  margin.stopped = !progress.go_on(1.0);
  return margin;
}

}  // namespace gearlash
