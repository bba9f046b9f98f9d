#include "question/series/samples.hpp"

#include <algorithm>

namespace gearlash::detail {
namespace {

double amplitude_in(const Answer& answer, Quantity amplitude) {
  if (answer.verdict == Verdict::grows_without_bound || answer.verdict == Verdict::runs_away) {
    return infinity;
  }
  return answer.value(amplitude).value_or(not_a_number);
}

}  // namespace

SampleValues::SampleValues(const TolerancedDrive& drive, const SamplePlan& plan, std::size_t sets)
    : points_(drive.varied.size() * sets, plan),
      of_replicate_(plan.points),
      width_(drive.varied.size() * sets) {
  for (const ParameterTolerance& varied : drive.varied) {
    quantiles_.emplace_back(varied.distribution);
  }
}

void SampleValues::fill(std::size_t first, std::span<double> values) const {
  const std::size_t count = width_ == 0 ? 0 : values.size() / width_;
  for (std::size_t done = 0; done < count;) {
    const std::size_t point = (first + done) % of_replicate_;
    const std::size_t part = std::min(count - done, of_replicate_ - point);
    points_.fill((first + done) / of_replicate_, point,
                 values.subspan(done * width_, part * width_));
    done += part;
  }
  std::size_t number = 0;
  for (double& value : values) {
    value = quantiles_[number](value);
    if (++number == quantiles_.size()) number = 0;
  }
}

std::vector<double> SampleValues::of(std::size_t first, std::size_t count) const {
  std::vector<double> values(count * width_);
  fill(first, values);
  return values;
}

bool SampleResult::hunts() const { return gearlash::hunts(verdict); }

SampleAnswers::SampleAnswers(const TolerancedDrive& drive, const Target& target, Quantity amplitude,
                             const Workers& workers)
    : target_(target),
      amplitude_(amplitude),
      workers_(workers),
      family_(family_of(drive)),
      one_by_one_(family_.engines().search || !is_of_boxes(target) ||
                  amplitude != Quantity::amplitude) {}

SampleResult SampleAnswers::result_of(const Answer* answer) const {
  if (answer == nullptr) return {.refused = true};
  return {.growth_at_rest = answer->growth_at_rest.value_or(not_a_number),
          .amplitude = amplitude_in(*answer, amplitude_),
          .frequency = answer->value(Quantity::frequency).value_or(not_a_number),
          .verdict = answer->verdict,
          .meets = is_met(target_, *answer)};
}

bool SampleAnswers::fill(const FamilyRows& rows, std::span<SampleResult> results,
                         Progress& progress) const {
  AskedOfRows asked{
      .take = [&](std::size_t row, const Answer* answer) { results[row] = result_of(answer); },
      .wanted = wanted_for(target_, family_.base()),
      .one_by_one = one_by_one_};
  asked.wanted.borders = true;  // of each sample the amplitude counts
  return !evaluate(family_, rows, asked, progress, workers_).stopped;
}

SampleResults SampleAnswers::of(std::span<const double> values, Progress& progress) const {
  const FamilyRows rows = rows_of(values, family_.width());
  SampleResults results(rows.count);
  fill(rows, results, progress);
  return results;
}

}  // namespace gearlash::detail
