#include "question/series/widest_backlash.hpp"

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/parameter.hpp"
#include "model/proportional_servo.hpp"
#include "question/change/target.hpp"
#include "question/series/replicates.hpp"
#include "question/series/sample_plan.hpp"
#include "question/series/samples.hpp"

namespace gearlash {
namespace {

constexpr double never = -1.0;  // the target is met for no max

double lowest_backlash(const TolerancedDrive& drive, const BacklashDemand& demand) {
  if (demand.min) return *demand.min;
  const auto place = place_of_backlash(drive);
  if (!place) return get(drive.nominal, path_of_backlash(drive.nominal));
  const Distribution& distribution = drive.varied[*place].distribution;
  const double support = support_of(distribution).low;
  return std::isinf(support) ? range_of_draws(distribution).low : support;
}

/// The drive with the coordinate u itself as backlash.
TolerancedDrive with_unit_backlash(TolerancedDrive drive) {
  const auto place = place_of_backlash(drive);
  if (!place) {
    drive.varied.push_back({std::string(path_of_backlash(drive.nominal)), {}});
  }
  drive.varied[place.value_or(drive.varied.size() - 1)].distribution = UniformBetween{0.0, 1.0};
  return drive;
}

/// The largest max for which a sample meets the target; `never` where it misses it even with
/// max = min. Amplitudes are proportional to backlash, and nothing else depends on it.
double largest_max(const Target& target, Answer answer, double backlash, double min) {
  double amplitude_per_backlash = not_a_number;
  for (Cycle& cycle : answer.cycles) {
    amplitude_per_backlash = cycle.amplitude / backlash;
    cycle.amplitude = min * amplitude_per_backlash;
  }
  for (IrregularMotion& motion : answer.irregular) {
    amplitude_per_backlash = motion.amplitude / backlash;
    motion.amplitude = min * amplitude_per_backlash;
  }
  const bool meets = is_met(target, answer);
  if (answer.verdict == Verdict::cannot_hunt) return meets ? infinity : never;
  if (meets && !std::isnan(amplitude_per_backlash)) {
    const double most = target.permitted(Quantity::amplitude).high / amplitude_per_backlash;
    return min + std::max(0.0, most - min) / backlash;
  }
  if (min > 0.0 || answer.verdict == Verdict::undamped) return never;
  // A sample without backlash does not hunt.
  answer.verdict = Verdict::cannot_hunt;
  answer.cycles.clear();
  answer.irregular.clear();
  return is_met(target, answer) ? 0.0 : never;
}

/// The largest max with at least this yield, by the largest max of each sample.
std::optional<double> max_with_yield(const detail::SortedReplicates& maxima, double yield) {
  const auto count = static_cast<double>(maxima.size());
  const double share = std::clamp(yield, 0.0, 1.0);
  constexpr double rounding = 1e-12;  // of the product, which is usually a whole number
  const auto meeting = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(share * count * (1.0 - rounding))));
  const detail::SortedReplicates met = maxima.from(0.0);
  if (meeting > met.size()) return std::nullopt;
  return met.smallest(met.size() - meeting);
}

Estimate yield_with(const detail::SortedReplicates& maxima, double max) {
  const auto size = [](const auto& replicate) { return static_cast<double>(replicate.size()); };
  return *detail::ratio_of(of_each(maxima.from(max).replicates, size),
                           of_each(maxima.replicates, size));
}

}  // namespace

std::vector<Fault> faults(const BacklashDemand& demand) {
  RangeCheck check;
  check.include(faults_of_boxes(demand.target));
  if (const double low = demand.target.permitted(Quantity::amplitude).low; low > 0.0) {
    check.refuse("target", "amplitude >= " + exact_text(low),
                 "must have no lower limit of amplitude: more backlash would then be better");
  }
  if (!(demand.yield > 0.0 && demand.yield <= 1.0)) {
    check.refuse("yield", exact_text(demand.yield), "must be above 0 and at most 1");
  }
  if (demand.min) check.not_negative("min", *demand.min, "rad");
  return check.faults();
}

std::optional<WidestBacklash> widest_backlash(const TolerancedDrive& drive,
                                              const BacklashDemand& demand,
                                              const SamplePlan& sampling, const Workers& workers,
                                              Progress& progress) {
  RangeCheck check;
  check.include(faults(drive));
  if (check.faults().empty() && is_searched(drive)) {
    check.refuse("drive", "not a servo as that of 1960", permitted_with_servo);
  }
  check.include(faults(sampling)).include(faults(demand));
  require_none(check.faults());
  const double min = lowest_backlash(drive, demand);
  const TolerancedDrive unit_drive = with_unit_backlash(drive);
  const detail::SampleValues values(unit_drive, sampling, 1);
  const std::size_t width = unit_drive.varied.size();
  const std::size_t place = *place_of_backlash(unit_drive);
  std::vector<double> column(sampling.samples());
  std::vector<double> backlash(column.size());
  const FamilyRows rows{.count = column.size(),
                        .fill = [&](std::size_t first, std::span<double> part) {
                          values.fill(first, part);
                          for (std::size_t i = place; i < part.size(); i += width) {
                            backlash[first + i / width] = part[i];
                          }
                        }};
  const auto take = [&](std::size_t row, const Answer* answer) {
    column[row] =
        answer == nullptr ? never : largest_max(demand.target, *answer, backlash[row], min);
  };
  WidestBacklash widest;
  widest.min = min;
  widest.stopped = evaluate(family_of(unit_drive), rows, {.take = take}, progress, workers).stopped;
  if (widest.stopped) return widest;
  const detail::SortedReplicates maxima =
      detail::sorted(column, sampling.replicates, workers.threads);
  const auto max = max_with_yield(maxima, demand.yield);
  if (!max) return std::nullopt;
  widest.max = *max;
  widest.yield = yield_with(maxima, *max);
  const double error = widest.yield.standard_error.value_or(0.0);
  widest.uncertainty = {max_with_yield(maxima, demand.yield + error).value_or(min),
                        max_with_yield(maxima, demand.yield - error).value_or(min)};
  return widest;
}

std::optional<WidestBacklash> widest_backlash(const TolerancedDrive& drive,
                                              const BacklashDemand& demand,
                                              const SamplePlan& sampling, Progress& progress) {
  return widest_backlash(drive, demand, sampling, Workers{}, progress);
}

}  // namespace gearlash
