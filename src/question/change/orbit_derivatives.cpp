#include "question/change/orbit_derivatives.hpp"

#include <cmath>

#include "base/progress_part.hpp"
#include "base/range_check.hpp"
#include "general/attractors/cycle_derivatives.hpp"
#include "question/axis.hpp"

namespace gearlash {
namespace {

/// The largest cycle that is not unstable; nullptr if there is none.
const drive::FoundCycle* cycle_in_practice(const Analysis& analysis) {
  const Cycle* cycle = analysis.answer.largest_stable();
  if (cycle == nullptr || !analysis.search) return nullptr;
  // The answer lists the cycles of the search in its order.
  return &analysis.search->cycles[static_cast<std::size_t>(cycle - analysis.answer.cycles.data())];
}

std::vector<double> presents_of(const Drive& drive, const std::vector<std::string>& paths) {
  RangeCheck check;
  std::vector<double> presents;
  for (const std::string& path : paths) {
    const Parameter* parameter = find_parameter(path, drive);
    const bool is_number =
        parameter != nullptr && parameter->choices.empty() && number_in(*parameter, drive);
    if (is_number) {
      presents.push_back(*number_in(*parameter, drive));
    } else {
      check.refuse("paths", path, "must be a number that this drive has");
    }
  }
  require_none(check.faults());
  return presents;
}

std::optional<drive::CycleSlopes> slopes_by(const Drive& drive, const std::string& path,
                                            double present, const drive::SearchSetting& setting,
                                            const drive::FoundCycle& cycle) {
  constexpr double share = 1e-3;
  const double step = share * std::abs(present);
  if (step == 0.0) return std::nullopt;
  const Axis axis{.path = path};
  const auto family = [&](double value) {
    Drive changed = drive;
    set_on(axis, changed, value);
    require_none(faults(changed));
    return reduce_settled(changed);
  };
  try {
    return cycle_slopes(setting, cycle, family, present, step);
  } catch (const InvalidInput&) {
    return std::nullopt;  // the parameter is at the end of its permitted range
  }
}

std::optional<double> slope_of(Quantity quantity, const drive::CycleSlopes& slopes, double period) {
  const auto known = [](double slope) {
    return std::isfinite(slope) ? std::optional(slope) : std::nullopt;
  };
  switch (quantity) {
    case Quantity::amplitude:
      return known(slopes.amplitude);
    case Quantity::motor_amplitude:
      return known(slopes.motor_amplitude);
    case Quantity::center:
      return known(slopes.center);
    case Quantity::period:
      return known(slopes.period);
    case Quantity::frequency:
      return known(-slopes.period / (period * period));
    default:
      return std::nullopt;
  }
}

}  // namespace

Jacobian searched_derivatives(const Drive& drive, const Analysis& analysis,
                              std::span<const Quantity> quantities,
                              const std::vector<std::string>& paths, Progress& progress) {
  Jacobian jacobian{.quantities = {quantities.begin(), quantities.end()},
                    .paths = paths,
                    .values = {},
                    .present = presents_of(drive, paths),
                    .slopes = {},
                    .reason = {}};
  const drive::FoundCycle* cycle = cycle_in_practice(analysis);
  for (const Quantity quantity : quantities) {
    jacobian.values.push_back(cycle == nullptr ? std::nullopt : analysis.answer.value(quantity));
  }
  jacobian.slopes.resize(quantities.size() * paths.size());
  if (cycle == nullptr) {
    jacobian.reason = "no limit cycle was found";
    return jacobian;
  }
  const drive::SearchSetting setting = drive::search_setting(analysis.reduced);
  jacobian.reason = obstacle_to_slopes(setting, *cycle);
  if (!jacobian.reason.empty()) return jacobian;
  for (std::size_t j = 0; j < paths.size(); ++j) {
    if (!progress.go_on(static_cast<double>(j) / static_cast<double>(paths.size()))) break;
    const auto slopes = slopes_by(drive, paths[j], jacobian.present[j], setting, *cycle);
    if (!slopes) continue;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      jacobian.slopes[i * paths.size() + j] = slope_of(quantities[i], *slopes, cycle->period());
    }
  }
  return jacobian;
}

Jacobian searched_derivatives(const Drive& drive, std::span<const Quantity> quantities,
                              const std::vector<std::string>& paths, Progress& progress) {
  presents_of(drive, paths);  // before the search
  ProgressPart search(progress, 0.0, 0.5);
  ProgressPart rest(progress, 0.5, 1.0);
  return searched_derivatives(drive, analyse_in_full(drive, {}, search), quantities, paths, rest);
}

Jacobian searched_derivatives(const Drive& drive, const Analysis& analysis, Progress& progress) {
  std::vector<std::string> paths;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (!exists(parameter, drive) || !parameter.choices.empty()) continue;
    const std::optional<double> present = number_in(parameter, drive);
    if (present && *present != 0.0) paths.emplace_back(parameter.path);
  }
  return searched_derivatives(drive, analysis, differentiable_by_search, paths, progress);
}

}  // namespace gearlash
