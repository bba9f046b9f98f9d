#include "analysis/design/tolerance_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "analysis/design/drawn_results.hpp"
#include "analysis/design/drawn_values.hpp"
#include "analysis/design/replicates.hpp"
#include "analysis/design/sampling.hpp"
#include "base/on_threads.hpp"
#include "base/range_check.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"
#include "numeric/quantile_sketch.hpp"

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

/// Every value, replicate by replicate.
struct Columns {
  std::vector<double> amplitude;  ///< infinite where unknown
  std::vector<double> frequency;  ///< no_cycle where there is none
};

/// Values of each replicate that are too many to keep.
struct Sketches {
  explicit Sketches(std::size_t replicates)
      : amplitude(replicates),
        amplitude_of_hunting(replicates),
        frequency(replicates),
        adding(replicates) {}

  std::vector<QuantileSketch> amplitude;
  std::vector<QuantileSketch> amplitude_of_hunting;  ///< those above 0
  std::vector<QuantileSketch> frequency;             ///< of drives with a cycle
  std::vector<std::mutex> adding;
};

Counts count_block(const detail::DrawnResults& results) {
  Counts counts{.refused = results.refused};
  for (std::size_t row = 0; row < results.rows(); ++row) {
    const double size = results.amplitude(row);
    if (results.hunts(row)) ++counts.hunting;
    if (results.meets[row]) ++counts.meeting;
    if (results.verdict(row) == Verdict::undecided) ++counts.undecided;
    if (std::isnan(size)) ++counts.unknown_amplitudes;
    if (std::isfinite(size)) {
      ++counts.finite_amplitudes;
      counts.sum_of_amplitudes += size;
    }
  }
  return counts;
}

double known_amplitude(const detail::DrawnResults& results, std::size_t row) {
  const double size = results.amplitude(row);
  return std::isnan(size) ? infinity : size;
}

void keep_block(const detail::DrawnResults& results, std::size_t place, Columns& columns) {
  for (std::size_t row = 0; row < results.rows(); ++row) {
    const double frequency = results.performance[row].frequency;
    columns.amplitude[place + row] = known_amplitude(results, row);
    columns.frequency[place + row] = std::isnan(frequency) ? no_cycle : frequency;
  }
}

/// In any order of the blocks: the sketches are the same.
void keep_block(const detail::DrawnResults& results, const detail::SampleBlock& block,
                Sketches& sketches) {
  const std::size_t replicate = block.replicate;
  const std::scoped_lock lock(sketches.adding[replicate]);
  for (std::size_t row = 0; row < results.rows(); ++row) {
    const double size = known_amplitude(results, row);
    const double frequency = results.performance[row].frequency;
    sketches.amplitude[replicate].add(size);
    if (size > 0.0) sketches.amplitude_of_hunting[replicate].add(size);
    if (frequency > no_cycle) sketches.frequency[replicate].add(frequency);
  }
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

template <class Replicates>  // SortedReplicates or SketchedReplicates
std::vector<QuantileEstimate> quantiles_of(const Replicates& numbers,
                                           const std::vector<double>& shares) {
  std::vector<QuantileEstimate> quantiles;
  for (const double share : shares) {
    quantiles.push_back({share, numbers.estimated_quantile(share)});
  }
  return quantiles;
}

/// Empty bins from `low` to `high`.
AmplitudeHistogram bins_between(double low, double high, std::size_t bins) {
  AmplitudeHistogram histogram;
  for (std::size_t i = 0; i < bins; ++i) {
    histogram.edges.push_back(low +
                              (high - low) * static_cast<double>(i) / static_cast<double>(bins));
  }
  histogram.edges.push_back(high);
  histogram.counts.assign(bins, 0);
  return histogram;
}

AmplitudeHistogram histogram_of(const detail::SortedReplicates& sizes, std::size_t bins) {
  const detail::SortedReplicates hunting = sizes.above(0.0).finite();
  const std::size_t count = hunting.size();
  AmplitudeHistogram histogram;
  if (count > 0 && bins > 0) {
    histogram = bins_between(hunting.smallest(0), hunting.smallest(count - 1), bins);
  }
  histogram.quiet = sizes.count_between(0.0, std::numeric_limits<double>::denorm_min());
  histogram.unknown = sizes.size() - histogram.quiet - count;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const bool is_last = i + 1 == bins;
    histogram.counts[i] =
        hunting.count_between(histogram.edges[i], is_last ? infinity : histogram.edges[i + 1]);
  }
  return histogram;
}

/// Each value is counted where the middle of its bucket lies.
AmplitudeHistogram histogram_of(const detail::SketchedReplicates& sizes,
                                const detail::SketchedReplicates& hunting, std::size_t bins) {
  const QuantileSketch& all = hunting.whole();
  AmplitudeHistogram histogram;
  const double low = all.smallest_finite();
  const double high = all.largest_finite();
  if (all.finite() > 0 && bins > 0) histogram = bins_between(low, high, bins);
  histogram.quiet = sizes.whole().size() - all.size();
  histogram.unknown = all.size() - all.finite();
  if (histogram.counts.empty()) return histogram;
  for (const QuantileSketch::Bucket& bucket : all.buckets()) {
    const double middle = std::clamp(bucket.low + 0.5 * (bucket.high - bucket.low), low, high);
    const auto above =
        std::upper_bound(histogram.edges.begin() + 1, histogram.edges.end() - 1, middle);
    histogram.counts[static_cast<std::size_t>(above - histogram.edges.begin()) - 1] += bucket.count;
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

/// What is known from the sketches.
void add_values(const Sketches& sketches, const StudyQuestions& questions, ToleranceStudy& study) {
  const detail::SketchedReplicates sizes(sketches.amplitude);
  const detail::SketchedReplicates hunting(sketches.amplitude_of_hunting);
  study.relative_accuracy = QuantileSketch::relative_accuracy;
  study.amplitude = quantiles_of(sizes, questions.shares);
  study.amplitude_of_hunting = quantiles_of(hunting, questions.shares);
  study.frequency = quantiles_of(detail::SketchedReplicates(sketches.frequency), questions.shares);
  study.histogram = histogram_of(sizes, hunting, questions.bins);
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

SamplePlan usual_sampling(const TolerancedDrive& drive, const StudyQuestions& questions) {
  if (is_searched(drive)) return sampling_of(64);
  const detail::DrawnAnswers answers(drive, questions.target, questions.amplitude,
                                     widest_vector_unit());
  return sampling_of(answers.are_one_by_one() || may_bounce(drive) ? 512 : 65536);
}

namespace {

/// What is kept of the results of all blocks, which may come in any order and from several threads.
class Tally {
 public:
  Tally(const SamplePlan& sampling, const StudyQuestions& questions, std::size_t at_a_time)
      : sampling_(sampling),
        questions_(questions),
        keeps_all_(sampling.samples() <= questions.most_exact),
        columns_{std::vector<double>(kept()), std::vector<double>(kept())},
        sketches_(keeps_all_ ? 0 : sampling.replicates),
        blocks_(detail::block_count(sampling, at_a_time)) {}

  void take(const detail::SampleBlock& block, const detail::DrawnResults& results) {
    blocks_[block.index] = count_block(results);
    if (keeps_all_) {
      keep_block(results, block.replicate * sampling_.points + block.first, columns_);
    } else {
      keep_block(results, block, sketches_);
    }
  }

  /// Once. `is_whole`: all blocks were taken.
  ToleranceStudy study(bool is_whole, std::size_t threads) {
    ToleranceStudy study = counted(sampling_, blocks_);
    study.stopped = !is_whole;
    if (!is_whole) return study;
    if (!keeps_all_) {
      add_values(sketches_, questions_, study);
      return study;
    }
    const detail::SortedReplicates sizes = sorted(columns_.amplitude, sampling_, threads);
    study.amplitude = quantiles_of(sizes, questions_.shares);
    study.amplitude_of_hunting = quantiles_of(sizes.above(0.0), questions_.shares);
    study.histogram = histogram_of(sizes, questions_.bins);
    const detail::SortedReplicates frequencies = sorted(columns_.frequency, sampling_, threads);
    study.frequency = quantiles_of(frequencies.above(no_cycle), questions_.shares);
    return study;
  }

 private:
  std::size_t kept() const { return keeps_all_ ? sampling_.samples() : 0; }

  const SamplePlan& sampling_;
  const StudyQuestions& questions_;
  bool keeps_all_;
  Columns columns_;
  Sketches sketches_;
  std::vector<Counts> blocks_;
};

/// The rows of a block among those of all samples.
detail::DrawnResults rows_of(const detail::DrawnResults& all, std::size_t first,
                             std::size_t count) {
  const auto begin = static_cast<std::ptrdiff_t>(first);
  const auto end = static_cast<std::ptrdiff_t>(first + count);
  return {.performance = {all.performance.begin() + begin, all.performance.begin() + end},
          .meets = {all.meets.begin() + begin, all.meets.begin() + end}};
}

}  // namespace

ToleranceStudy study_tolerances(const TolerancedDrive& drive, const SamplePlan& sampling,
                                const StudyQuestions& questions, const Workers& workers,
                                Progress& progress) {
  require_sound(drive, sampling, questions);
  const detail::DrawnValues values(drive, sampling, 1);
  const detail::DrawnAnswers answers(drive, questions.target, questions.amplitude, workers.unit);
  Tally tally(sampling, questions, answers.at_a_time());
  const auto work = [&](const detail::SampleBlock& block, Progress& of_block) {
    tally.take(block, answers.of(block.count, values.of(block), of_block));
  };
  const bool all_done =
      detail::for_all_blocks(sampling, answers.at_a_time(), workers, progress, work);
  return tally.study(all_done, workers.threads);
}

detail::DrawnResults answer_samples(const TolerancedDrive& drive, const SamplePlan& sampling,
                                    const StudyQuestions& questions, std::size_t first,
                                    std::size_t count, Progress& progress) {
  require_sound(drive, sampling, questions);
  const std::size_t samples = sampling.samples();
  if (first >= samples || count == 0 || count > samples - first) {
    require_none({{"samples", std::to_string(first) + " and " + std::to_string(count) + " more",
                   "must be among the " + std::to_string(samples) + " of the plan", ""}});
  }
  const detail::DrawnValues values(drive, sampling, 1);
  const detail::DrawnAnswers answers(drive, questions.target, questions.amplitude,
                                     widest_vector_unit());
  std::vector<detail::DrawnResults> found(count);
  SharedProgress shared(progress, count);
  on_threads(0, count, [&](std::size_t i) {
    const std::size_t sample = first + i;
    const detail::SampleBlock block{
        .replicate = sample / sampling.points, .first = sample % sampling.points, .count = 1};
    if (shared.is_stopped()) return;
    found[i] = answers.of(1, values.of(block), shared);
    shared.finish(1);
  });
  detail::DrawnResults all;
  for (const detail::DrawnResults& one : found) {
    all.performance.push_back(one.performance.empty() ? Performance{} : one.performance.front());
    all.meets.push_back(!one.meets.empty() && one.meets.front());
    all.refused += one.refused;
  }
  return all;
}

ToleranceStudy study_of(const TolerancedDrive& drive, const SamplePlan& sampling,
                        const StudyQuestions& questions, const detail::DrawnResults& results) {
  require_sound(drive, sampling, questions);
  if (results.rows() != sampling.samples()) {
    require_none({{"results", std::to_string(results.rows()),
                   "must be as many as samples: " + std::to_string(sampling.samples()), ""}});
  }
  const detail::DrawnAnswers answers(drive, questions.target, questions.amplitude,
                                     widest_vector_unit());
  Tally tally(sampling, questions, answers.at_a_time());
  detail::for_all_blocks(sampling, answers.at_a_time(), {}, no_progress(),
                         [&](const detail::SampleBlock& block, Progress&) {
                           const std::size_t begin =
                               block.replicate * sampling.points + block.first;
                           tally.take(block, rows_of(results, begin, block.count));
                         });
  ToleranceStudy study = tally.study(true, 0);
  study.refused = results.refused;
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
