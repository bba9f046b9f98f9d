#include "question/series/tolerance_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "question/change/target.hpp"
#include "question/series/replicates.hpp"
#include "question/series/sample_plan.hpp"

namespace gearlash {
namespace {

using detail::SampleResult;
using detail::SampleResults;
using detail::SortedReplicates;

static_assert(sizeof(SampleResult) == 40);  // SamplePlan::most_samples says what they take

constexpr double above_zero = std::numeric_limits<double>::denorm_min();

std::vector<QuantileEstimate> quantiles_of(const SortedReplicates& numbers,
                                           const std::vector<double>& shares) {
  return of_each(shares, [&](double share) {
    return QuantileEstimate{share, numbers.estimated_quantile(share)};
  });
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

AmplitudeHistogram histogram_of(const SortedReplicates& sizes, std::size_t bins) {
  const SortedReplicates hunting = sizes.from(above_zero).below(infinity);
  const std::size_t count = hunting.size();
  AmplitudeHistogram histogram;
  if (count > 0 && bins > 0) {
    histogram = bins_between(hunting.smallest(0), hunting.smallest(count - 1), bins);
  }
  histogram.quiet = sizes.below(above_zero).size();
  histogram.unknown = sizes.size() - histogram.quiet - count;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const bool is_last = i + 1 == bins;
    histogram.counts[i] =
        hunting.from(histogram.edges[i]).below(is_last ? infinity : histogram.edges[i + 1]).size();
  }
  return histogram;
}

/// The part of a study that needs only the counts.
ToleranceStudy counted(const SamplePlan& sampling, std::span<const SampleResult> results) {
  const std::vector<double> points(sampling.replicates, static_cast<double>(sampling.points));
  std::vector<double> hunting(sampling.replicates);
  std::vector<double> meeting(sampling.replicates);
  std::vector<double> finite(sampling.replicates);
  std::vector<double> sum_of_finite(sampling.replicates);
  ToleranceStudy study{.sampling = sampling};
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::size_t replicate = i / sampling.points;
    const SampleResult& result = results[i];
    if (result.hunts()) hunting[replicate] += 1.0;
    if (result.meets) meeting[replicate] += 1.0;
    if (result.refused) ++study.refused;
    if (result.verdict == Verdict::undecided) ++study.undecided;
    if (std::isnan(result.amplitude)) ++study.unknown_amplitudes;
    if (std::isfinite(result.amplitude)) {
      finite[replicate] += 1.0;
      sum_of_finite[replicate] += result.amplitude;
    }
  }
  study.answered = results.size() - study.undecided;
  study.hunting = *detail::ratio_of(hunting, points);
  study.yield = *detail::ratio_of(meeting, points);
  study.mean_amplitude = detail::ratio_of(sum_of_finite, finite);
  return study;
}

/// Of the samples that were answered before the work was stopped. One that was broken off is
/// undecided.
ToleranceStudy stopped_study(const SamplePlan& sampling, std::span<const SampleResult> results) {
  ToleranceStudy study{.sampling = sampling, .stopped = true};
  double hunting = 0.0;
  double meeting = 0.0;
  for (const SampleResult& result : results) {
    if (result.verdict == Verdict::undecided) continue;
    ++study.answered;
    if (result.hunts()) hunting += 1.0;
    if (result.meets) meeting += 1.0;
  }
  const auto share = [&](double count) {
    return Estimate{study.answered > 0 ? count / static_cast<double>(study.answered)
                                       : std::numeric_limits<double>::quiet_NaN()};
  };
  study.hunting = share(hunting);
  study.yield = share(meeting);
  return study;
}

/// False if the work was stopped; samples without an answer are then undecided.
bool answer_all(const TolerancedDrive& drive, const SamplePlan& sampling,
                const StudyQuestions& questions, std::size_t first, const Workers& workers,
                Progress& progress, SampleResults& all) {
  const detail::SampleValues values(drive, sampling, 1);
  const detail::SampleAnswers answers(drive, questions.target, questions.amplitude, workers);
  return answers.fill(
      {.count = all.size(),
       .fill = [&](std::size_t row, std::span<double> part) { values.fill(first + row, part); }},
      all, progress);
}

}  // namespace

std::vector<Fault> faults(const StudyQuestions& questions) {
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
  const detail::SampleAnswers answers(drive, questions.target, questions.amplitude, {});
  return sampling_of(answers.are_one_by_one() || may_bounce(drive) ? 512 : 65536);
}

std::optional<SampleResults> answer_samples(const TolerancedDrive& drive,
                                            const SamplePlan& sampling,
                                            const StudyQuestions& questions, std::size_t first,
                                            std::size_t count, const Workers& workers,
                                            Progress& progress) {
  require_none(faults(drive), faults(sampling), faults(questions));
  const std::size_t samples = sampling.samples();
  if (first >= samples || count == 0 || count > samples - first) {
    require_none({{"samples", std::to_string(first) + " and " + std::to_string(count) + " more",
                   "must be among the " + std::to_string(samples) + " of the plan"}});
  }
  SampleResults all(count);
  if (!answer_all(drive, sampling, questions, first, workers, progress, all)) return std::nullopt;
  return all;
}

ToleranceStudy study_of(const SamplePlan& sampling, const StudyQuestions& questions,
                        std::span<const SampleResult> results, std::size_t threads) {
  require_none(faults(sampling), faults(questions));
  if (results.size() != sampling.samples()) {
    require_none({{"results", std::to_string(results.size()),
                   "must be as many as samples: " + std::to_string(sampling.samples())}});
  }
  ToleranceStudy study = counted(sampling, results);
  std::vector<double> column(results.size());  // one, for memory
  const auto sorted_by = [&](auto number) {
    std::transform(results.begin(), results.end(), column.begin(), number);
    return detail::sorted(column, sampling.replicates, threads);
  };
  const SortedReplicates sizes = sorted_by([](const SampleResult& result) {
    return std::isnan(result.amplitude) ? infinity : result.amplitude;
  });
  study.amplitude = quantiles_of(sizes, questions.shares);
  study.amplitude_of_hunting = quantiles_of(sizes.from(above_zero), questions.shares);
  study.histogram = histogram_of(sizes, questions.bins);
  study.error = quantiles_of(sorted_by([](const SampleResult& result) {
                               return std::isnan(result.error) ? infinity : result.error;
                             }),
                             questions.shares);
  for (const SampleResult& result : results) {
    if (result.meets && hides_error(questions.target, result.error)) ++study.hidden_errors;
  }
  constexpr double no_cycle = -1.0;  // NaN has no place in an order
  const SortedReplicates frequencies = sorted_by([](const SampleResult& result) {
    return std::isnan(result.frequency) ? no_cycle : result.frequency;
  });
  study.frequency = quantiles_of(frequencies.from(0.0), questions.shares);
  return study;
}

ToleranceStudy study_tolerances(const TolerancedDrive& drive, const SamplePlan& sampling,
                                const StudyQuestions& questions, const Workers& workers,
                                Progress& progress) {
  require_none(faults(drive), faults(sampling), faults(questions));
  SampleResults results(sampling.samples());
  return answer_all(drive, sampling, questions, 0, workers, progress, results)
             ? study_of(sampling, questions, results, workers.threads)
             : stopped_study(sampling, results);
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
    if (is_known || study.stopped || 2 * plan.samples() > SamplePlan::most_samples) return study;
    plan.points *= 2;
  }
}

}  // namespace gearlash
