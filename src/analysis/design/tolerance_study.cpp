#include "analysis/design/tolerance_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/design/drawn_results.hpp"
#include "analysis/design/drawn_values.hpp"
#include "analysis/design/replicates.hpp"
#include "analysis/design/sampling.hpp"
#include "base/on_threads.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"

namespace gearlash {
namespace {

constexpr double no_cycle = -1.0;  // in the column of frequencies; sorts first

/// Counts. Integer counts of blocks add up the same in any order; the sum of amplitudes must be
/// added in the order of the blocks.
struct Counts {
  std::size_t hunting = 0;
  std::size_t meeting = 0;
  std::size_t undecided = 0;
  std::size_t unknown_amplitudes = 0;
  std::size_t finite_amplitudes = 0;
  std::size_t refused = 0;
  double sum_of_amplitudes = 0.0;

  void add(const Counts& others) {
    hunting += others.hunting;
    meeting += others.meeting;
    undecided += others.undecided;
    unknown_amplitudes += others.unknown_amplitudes;
    finite_amplitudes += others.finite_amplitudes;
    refused += others.refused;
    sum_of_amplitudes += others.sum_of_amplitudes;
  }
};

/// Columns, replicate by replicate.
struct Columns {
  std::vector<double> amplitude;  ///< infinite where unknown
  std::vector<double> frequency;  ///< no_cycle where there is none
};

Counts count_block(const detail::DrawnResults& results, std::size_t place, Columns& columns) {
  Counts counts{.refused = results.refused};
  for (std::size_t row = 0; row < results.rows(); ++row) {
    const double size = results.amplitude(row);
    const double frequency = results.performance[row].frequency;
    if (results.hunts(row)) ++counts.hunting;
    if (results.meets[row]) ++counts.meeting;
    if (results.verdict(row) == Verdict::undecided) ++counts.undecided;
    if (std::isnan(size)) ++counts.unknown_amplitudes;
    if (std::isfinite(size)) {
      ++counts.finite_amplitudes;
      counts.sum_of_amplitudes += size;
    }
    columns.amplitude[place + row] = std::isnan(size) ? infinity : size;
    columns.frequency[place + row] = std::isnan(frequency) ? no_cycle : frequency;
  }
  return counts;
}

/// Sorts the numbers of each replicate.
detail::SortedReplicates sorted(std::vector<double>& column, const SamplePlan& sampling,
                                std::size_t threads) {
  const auto replicate = [&](std::size_t i) {
    return std::span<double>(column).subspan(i * sampling.points, sampling.points);
  };
  on_threads(threads, sampling.replicates,
             [&](std::size_t i) { std::sort(replicate(i).begin(), replicate(i).end()); });
  detail::SortedReplicates all;
  for (std::size_t i = 0; i < sampling.replicates; ++i) all.replicates.emplace_back(replicate(i));
  return all;
}

std::vector<QuantileEstimate> quantiles_of(const detail::SortedReplicates& numbers,
                                           const std::vector<double>& shares) {
  std::vector<QuantileEstimate> quantiles;
  for (const double share : shares) {
    quantiles.push_back({share, numbers.estimated_quantile(share)});
  }
  return quantiles;
}

AmplitudeHistogram histogram_of(const detail::SortedReplicates& sizes, std::size_t bins) {
  const detail::SortedReplicates hunting = sizes.above(0.0).finite();
  const std::size_t count = hunting.size();
  AmplitudeHistogram histogram;
  histogram.quiet = sizes.count_between(0.0, std::numeric_limits<double>::denorm_min());
  histogram.unknown = sizes.size() - histogram.quiet - count;
  if (count == 0 || bins == 0) return histogram;
  const double low = hunting.smallest(0);
  const double high = hunting.smallest(count - 1);
  for (std::size_t i = 0; i < bins; ++i) {
    histogram.edges.push_back(low +
                              (high - low) * static_cast<double>(i) / static_cast<double>(bins));
  }
  histogram.edges.push_back(high);
  for (std::size_t i = 0; i < bins; ++i) {
    const bool is_last = i + 1 == bins;
    histogram.counts.push_back(
        hunting.count_between(histogram.edges[i], is_last ? infinity : histogram.edges[i + 1]));
  }
  return histogram;
}

/// Σ quantity/Σ all, over the replicates.
template <class Quantity, class All>
std::optional<Estimate> share_of(const std::vector<Counts>& replicates, Quantity quantity,
                                 All all) {
  std::vector<double> quantities;
  std::vector<double> wholes;
  for (const Counts& counts : replicates) {
    quantities.push_back(static_cast<double>(quantity(counts)));
    wholes.push_back(static_cast<double>(all(counts)));
  }
  return detail::ratio_of(quantities, wholes);
}

/// The part of a study that needs only the counts.
ToleranceStudy counted(const SamplePlan& sampling, const std::vector<Counts>& blocks) {
  std::vector<Counts> replicates(sampling.replicates);
  Counts total;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    replicates[i / (blocks.size() / sampling.replicates)].add(blocks[i]);
    total.add(blocks[i]);
  }
  const auto points = [&](const Counts&) { return sampling.points; };
  ToleranceStudy study;
  study.sampling = sampling;
  study.hunting = *share_of(
      replicates, [](const Counts& c) { return c.hunting; }, points);
  study.yield = *share_of(
      replicates, [](const Counts& c) { return c.meeting; }, points);
  study.mean_amplitude = share_of(
      replicates, [](const Counts& c) { return c.sum_of_amplitudes; },
      [](const Counts& c) { return c.finite_amplitudes; });
  study.undecided = total.undecided;
  study.unknown_amplitudes = total.unknown_amplitudes;
  study.refused = total.refused;
  return study;
}

void require_sound(const TolerancedDrive& drive, const SamplePlan& sampling,
                   const StudyQuestions& questions) {
  RangeCheck check;
  check.include(faults(drive)).include(validate(sampling)).include(validate(questions));
  require_none(check.faults());
}

}  // namespace

std::vector<Fault> validate(const StudyQuestions& questions) {
  RangeCheck check;
  check.include(faults(questions.target));
  const Quantity of = questions.amplitude;
  if (of != Quantity::amplitude && of != Quantity::motor_amplitude) {
    check.refuse("amplitude", std::string(name_of(of)), "must be amplitude or motor_amplitude");
  }
  for (const double share : questions.shares) check.within("quantile", share, 0.0, 1.0);
  constexpr std::size_t most_bins = 1'000'000;
  if (questions.bins > most_bins) {
    check.refuse("bins", std::to_string(questions.bins),
                 "must be at most " + std::to_string(most_bins));
  }
  return check.faults();
}

ToleranceStudy study_tolerances(const TolerancedDrive& drive, const SamplePlan& sampling,
                                const StudyQuestions& questions, const Workers& workers,
                                Progress& progress) {
  require_sound(drive, sampling, questions);
  const detail::DrawnValues values(drive, sampling, 1);
  const detail::DrawnAnswers answers(drive, questions.target, questions.amplitude, workers.unit);
  const std::size_t at_a_time = answers.at_a_time();
  Columns columns{std::vector<double>(sampling.samples()), std::vector<double>(sampling.samples())};
  std::vector<Counts> blocks(detail::block_count(sampling, at_a_time));
  const auto work = [&](const detail::SampleBlock& block, Progress& of_block) {
    blocks[block.index] = count_block(answers.of(block.count, values.of(block), of_block),
                                      block.replicate * sampling.points + block.first, columns);
  };
  const bool all_done = detail::for_all_blocks(sampling, at_a_time, workers, progress, work);
  ToleranceStudy study = counted(sampling, blocks);
  study.stopped = !all_done;
  if (study.stopped) return study;
  const detail::SortedReplicates sizes = sorted(columns.amplitude, sampling, workers.threads);
  study.amplitude = quantiles_of(sizes, questions.shares);
  study.amplitude_of_hunting = quantiles_of(sizes.above(0.0), questions.shares);
  study.histogram = histogram_of(sizes, questions.bins);
  const detail::SortedReplicates frequencies = sorted(columns.frequency, sampling, workers.threads);
  study.frequency = quantiles_of(frequencies.above(no_cycle), questions.shares);
  return study;
}

ToleranceStudy study_tolerances(const TolerancedDrive& drive, const SamplePlan& sampling,
                                const StudyQuestions& questions, Progress& progress) {
  return study_tolerances(drive, sampling, questions, Workers{}, progress);
}

namespace {

/// Whether two standard errors are small enough; where all samples agree, three by their number.
bool is_known_to(double error, const Estimate& share, std::size_t samples) {
  if (3.0 > error * static_cast<double>(samples)) return false;
  return share.standard_error && 2.0 * *share.standard_error <= error;
}

}  // namespace

ToleranceStudy study_tolerances_to(double error, const TolerancedDrive& drive,
                                   const SamplePlan& sampling, const StudyQuestions& questions,
                                   Progress& progress) {
  RangeCheck check;
  require_none(check.within("error", error, 1e-6, 0.5).faults());
  const bool has_target = questions.target != Target{};
  SamplePlan plan = sampling;
  while (true) {
    ToleranceStudy study = study_tolerances(drive, plan, questions, progress);
    const bool is_known = is_known_to(error, study.hunting, plan.samples()) &&
                          (!has_target || is_known_to(error, study.yield, plan.samples()));
    if (is_known || study.stopped || 2 * plan.samples() > most_samples) return study;
    plan.points *= 2;
  }
}

}  // namespace gearlash
