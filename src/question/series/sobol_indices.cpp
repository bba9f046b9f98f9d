#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "base/progress_part.hpp"
#include "base/range_check.hpp"
#include "question/series/replicates.hpp"
#include "question/series/sample_plan.hpp"
#include "question/series/samples.hpp"
#include "question/series/tolerance_study.hpp"

namespace gearlash {
namespace {

/// Sums of a function f at the points A, B and AB_i, less a constant near its mean.
struct Sums {
  explicit Sums(std::size_t numbers = 0) : first(numbers), shift(numbers), total(numbers) {}

  double points = 0.0;
  double both = 0.0;          ///< Σ f(A) + f(B)
  double both_squared = 0.0;  ///< Σ f(A)² + f(B)²
  std::vector<double> first;  ///< Σ f(B)(f(AB_i) − f(A)), by number
  std::vector<double> shift;  ///< Σ f(AB_i) − f(A)
  std::vector<double> total;  ///< Σ (f(A) − f(AB_i))²

  void add_point(double at_a, double at_b) {
    points += 1.0;
    both += at_a + at_b;
    both_squared += at_a * at_a + at_b * at_b;
  }
  void add_number(std::size_t number, double at_a, double at_b, double at_mixed) {
    const double change = at_mixed - at_a;
    first[number] += at_b * change;
    shift[number] += change;
    total[number] += change * change;
  }
  void add(const Sums& others) {
    points += others.points;
    both += others.both;
    both_squared += others.both_squared;
    for (std::size_t i = 0; i < first.size(); ++i) {
      first[i] += others.first[i];
      shift[i] += others.shift[i];
      total[i] += others.total[i];
    }
  }

  // 0 without points.
  double mean() const { return share(both / 2.0); }
  double variance() const { return share(both_squared / 2.0) - mean() * mean(); }
  double first_variance(std::size_t number) const {
    return share(first[number] - mean() * shift[number]);
  }
  double total_variance(std::size_t number) const { return share(total[number] / 2.0); }

 private:
  double share(double sum) const { return points > 0.0 ? sum / points : 0.0; }
};

struct ReplicateSums {
  Sums amplitude;
  Sums hunting;
  std::size_t left_out = 0;
  std::size_t refused = 0;

  void add(const ReplicateSums& others) {
    amplitude.add(others.amplitude);
    hunting.add(others.hunting);
    left_out += others.left_out;
    refused += others.refused;
  }
};

/// For each point the values of A, of B, and of each AB_i: numbers + 2 drives.
std::vector<double> mixed_values(const std::vector<double>& both_sets, std::size_t numbers) {
  std::vector<double> values;
  values.reserve(both_sets.size() / 2 * (numbers + 2));
  for (std::size_t point = 0; point < both_sets.size(); point += 2 * numbers) {
    const double* a = &both_sets[point];
    const double* b = a + numbers;
    values.insert(values.end(), a, b);
    values.insert(values.end(), b, b + numbers);
    for (std::size_t i = 0; i < numbers; ++i) {
      values.insert(values.end(), a, b);
      values[values.size() - numbers + i] = b[i];
    }
  }
  return values;
}

/// The sums of the drives of mixed_values(); `usual_amplitude` is subtracted from amplitudes.
ReplicateSums sums_of(std::span<const detail::SampleResult> results, std::size_t numbers,
                      double usual_amplitude) {
  ReplicateSums sums{Sums(numbers), Sums(numbers)};
  for (const detail::SampleResult& result : results) sums.refused += result.refused ? 1 : 0;
  for (std::size_t point = 0; point < results.size(); point += numbers + 2) {
    const auto size = [&](std::size_t of) {
      return results[point + of].amplitude - usual_amplitude;
    };
    const auto hunts = [&](std::size_t of) { return results[point + of].hunts() ? 1.0 : 0.0; };
    bool all_known = true;
    for (std::size_t i = 0; i < numbers + 2; ++i) all_known = all_known && std::isfinite(size(i));
    if (!all_known) {
      ++sums.left_out;
      continue;
    }
    sums.amplitude.add_point(size(0), size(1));
    sums.hunting.add_point(hunts(0), hunts(1));
    for (std::size_t i = 0; i < numbers; ++i) {
      sums.amplitude.add_number(i, size(0), size(1), size(i + 2));
      sums.hunting.add_number(i, hunts(0), hunts(1), hunts(i + 2));
    }
  }
  return sums;
}

/// A constant near the mean amplitude; subtracting it avoids cancellation in a small variance.
double amplitude_of_mean_drive(const TolerancedDrive& drive, const detail::SampleAnswers& answers,
                               Progress& progress) {
  ProgressPart at_start(progress, 0.0, 0.0);
  const double size = answers.of(means_of(drive), at_start)[0].amplitude;
  return std::isfinite(size) ? size : 0.0;
}

/// The indices of one quantity, from all replicates; empty where its variance is only rounding.
class Indices {
 public:
  Indices(const std::vector<const Sums*>& replicates, double usual) : replicates_(replicates) {
    double sum = 0.0;
    double largest = std::abs(usual);
    for (const Sums* sums : replicates_) {
      variances_.push_back(sums->variance());
      sum += variances_.back();
      largest = std::max(largest, std::abs(sums->mean() + usual));
    }
    const double mean = sum / static_cast<double>(variances_.size());
    variance_ = detail::estimate_of(mean, variances_);
    constexpr double rounding = 1e-12;
    varies_ = mean > rounding * largest * rounding * largest;
  }

  Estimate variance() const { return variance_; }
  std::optional<SensitivityIndices> of(std::size_t number) const {
    if (!varies_) return std::nullopt;
    const auto share_of = [&](double (Sums::*part)(std::size_t) const) {
      return *detail::ratio_of(of_each(replicates_,
                                       [&](const Sums* sums) {
                                         return sums->points > 0.0 ? (sums->*part)(number) : 0.0;
                                       }),
                               variances_);
    };
    return SensitivityIndices{share_of(&Sums::first_variance), share_of(&Sums::total_variance)};
  }

 private:
  std::vector<const Sums*> replicates_;
  std::vector<double> variances_;
  Estimate variance_;
  bool varies_ = false;
};

SensitivityStudy study_of(const TolerancedDrive& drive, const SamplePlan& sampling,
                          const std::vector<ReplicateSums>& replicates, double usual_amplitude) {
  const std::size_t numbers = drive.varied.size();
  SensitivityStudy study{.sampling = sampling};
  std::vector<const Sums*> sizes;
  std::vector<const Sums*> hunting;
  for (const ReplicateSums& replicate : replicates) {
    sizes.push_back(&replicate.amplitude);
    hunting.push_back(&replicate.hunting);
    study.left_out += replicate.left_out;
    study.refused += replicate.refused;
  }
  const Indices of_amplitude(sizes, usual_amplitude);
  const Indices of_hunting(hunting, 0.0);
  study.amplitude_variance = of_amplitude.variance();
  study.hunting_variance = of_hunting.variance();
  for (std::size_t i = 0; i < numbers; ++i) {
    study.numbers.push_back({drive.varied[i].path, of_amplitude.of(i), of_hunting.of(i)});
  }
  return study;
}

}  // namespace

SensitivityStudy study_sensitivities(const TolerancedDrive& drive, const SamplePlan& sampling,
                                     const StudyQuestions& questions, const Workers& workers,
                                     Progress& progress) {
  require_none(faults(drive), faults(sampling), faults(questions));
  const std::size_t numbers = drive.varied.size();
  if (numbers == 0) return {.sampling = sampling};
  const detail::SampleValues values(drive, sampling, 2);
  const Target no_target;
  const detail::SampleAnswers answers(drive, no_target, questions.amplitude, workers);
  const double usual_amplitude = amplitude_of_mean_drive(drive, answers, progress);
  constexpr std::size_t points_at_a_time = 4096;  // for memory
  const auto samples = static_cast<double>(sampling.samples());
  std::vector<ReplicateSums> replicates(sampling.replicates, {Sums(numbers), Sums(numbers)});
  bool all_done = true;
  for (std::size_t first = 0; first < sampling.samples() && all_done;) {
    const std::size_t end = std::min(first + points_at_a_time, sampling.samples());
    ProgressPart part(progress, static_cast<double>(first) / samples,
                      static_cast<double>(end) / samples);
    const std::vector<double> mixed = mixed_values(values.of(first, end - first), numbers);
    detail::SampleResults results((end - first) * (numbers + 2));
    all_done = answers.fill(rows_of(mixed, numbers), results, part);
    for (std::span<const detail::SampleResult> left = results; !left.empty();) {
      const std::size_t replicate = first / sampling.points;
      const std::size_t next = std::min(end, (replicate + 1) * sampling.points);
      const std::size_t count = (next - first) * (numbers + 2);
      replicates[replicate].add(sums_of(left.first(count), numbers, usual_amplitude));
      left = left.subspan(count);
      first = next;
    }
  }
  SensitivityStudy study = study_of(drive, sampling, replicates, usual_amplitude);
  study.stopped = !all_done;
  return study;
}

SensitivityStudy study_sensitivities(const TolerancedDrive& drive, const SamplePlan& sampling,
                                     const StudyQuestions& questions, Progress& progress) {
  return study_sensitivities(drive, sampling, questions, Workers{}, progress);
}

}  // namespace gearlash
