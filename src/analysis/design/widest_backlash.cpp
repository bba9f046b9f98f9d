#include "analysis/design/widest_backlash.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/design/drawn_cycles.hpp"
#include "analysis/design/drawn_values.hpp"
#include "analysis/design/replicates.hpp"
#include "analysis/design/sampling.hpp"
#include "base/on_threads.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/parameter.hpp"

namespace gearlash {
namespace {

constexpr double never = -1.0;  // the target is met for no max

double lowest_backlash(const TolerancedDrive& drive, const BacklashDemand& demand) {
  if (demand.min) return *demand.min;
  const auto place = place_of_backlash(drive);
  if (!place) return get(drive.nominal, path_of_backlash(drive.nominal));
  const Distribution& distribution = drive.varied[*place].distribution;
  const double support = support_of(distribution).low;
  return std::isinf(support) ? drawn_range_of(distribution).low : support;
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
/// max = min.
double largest_max(const Target& target, const detail::DrawnCycles& cycles, std::size_t row,
                   double min) {
  Performance performance = cycles.performance(row);
  if (performance.verdict == Verdict::cannot_hunt) {
    return is_met(target, performance) ? infinity : never;
  }
  const double size = cycles.amplitude_per_backlash[row];
  performance.amplitude = min * size;
  if (is_met(target, performance) && !std::isnan(performance.amplitude)) {
    return min + std::max(0.0, target.permitted(Quantity::amplitude).high / size - min) /
                     cycles.backlash[row];
  }
  if (min > 0.0 || performance.verdict == Verdict::undamped) return never;
  // A sample without backlash does not hunt.
  return is_met(target, Performance{.verdict = Verdict::cannot_hunt,
                                    .growth_at_rest = performance.growth_at_rest,
                                    .amplitude = 0.0})
             ? 0.0
             : never;
}

/// The largest max of each sample, sorted within each replicate.
class LargestMaxima {
 public:
  LargestMaxima(std::vector<double> column, const SamplePlan& sampling, std::size_t threads)
      : column_(std::move(column)) {
    const auto replicate = [&](std::size_t i) {
      return std::span<double>(column_).subspan(i * sampling.points, sampling.points);
    };
    on_threads(threads, sampling.replicates,
               [&](std::size_t i) { std::sort(replicate(i).begin(), replicate(i).end()); });
    for (std::size_t i = 0; i < sampling.replicates; ++i) {
      all_.replicates.emplace_back(replicate(i));
    }
  }

  /// The largest max with at least this yield.
  std::optional<double> with_yield(double yield) const {
    const auto count = static_cast<double>(all_.size());
    const double share = std::clamp(yield, 0.0, 1.0);
    constexpr double rounding = 1e-12;  // of the product, which is usually a whole number
    const auto meeting = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(share * count * (1.0 - rounding))));
    const detail::SortedReplicates met = all_.above(never);
    if (meeting > met.size()) return std::nullopt;
    return met.smallest(met.size() - meeting);
  }

  Estimate yield_with(double max) const {
    std::vector<double> each;
    double sum = 0.0;
    for (const auto& replicate : all_.replicates) {
      const auto first = std::lower_bound(replicate.begin(), replicate.end(), max);
      each.push_back(static_cast<double>(replicate.end() - first) /
                     static_cast<double>(replicate.size()));
      sum += each.back();
    }
    return detail::estimate_of(sum / static_cast<double>(each.size()), each);
  }

 private:
  std::vector<double> column_;
  detail::SortedReplicates all_;
};

}  // namespace

std::vector<Fault> validate(const BacklashDemand& demand) {
  RangeCheck check;
  check.include(faults_for_performance(demand.target));
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
  check.include(faults_of_toleranced_servo(drive));
  check.include(validate(sampling)).include(validate(demand));
  require_none(check.faults());
  const double min = lowest_backlash(drive, demand);
  const TolerancedDrive unit_drive = with_unit_backlash(drive);
  const detail::DrawnValues values(unit_drive, sampling, 1);
  std::vector<double> column(sampling.samples());
  const auto work = [&](const detail::SampleBlock& block, Progress&) {
    const detail::DrawnCycles cycles =
        detail::solve(unit_drive, block.count, values.of(block), workers.unit);
    const std::size_t place = block.replicate * sampling.points + block.first;
    for (std::size_t row = 0; row < cycles.rows(); ++row) {
      column[place + row] = largest_max(demand.target, cycles, row, min);
    }
  };
  WidestBacklash widest;
  widest.min = min;
  widest.stopped =
      !detail::for_all_blocks(sampling, detail::drives_at_a_time(drive), workers, progress, work);
  if (widest.stopped) return widest;
  const LargestMaxima maxima(std::move(column), sampling, workers.threads);
  const auto max = maxima.with_yield(demand.yield);
  if (!max) return std::nullopt;
  widest.max = *max;
  widest.yield = maxima.yield_with(*max);
  const double error = widest.yield.standard_error.value_or(0.0);
  widest.uncertainty = {maxima.with_yield(demand.yield + error).value_or(min),
                        maxima.with_yield(demand.yield - error).value_or(min)};
  return widest;
}

std::optional<WidestBacklash> widest_backlash(const TolerancedDrive& drive,
                                              const BacklashDemand& demand,
                                              const SamplePlan& sampling, Progress& progress) {
  return widest_backlash(drive, demand, sampling, Workers{}, progress);
}

}  // namespace gearlash
