#include "question/series/samples.hpp"

#include <algorithm>
#include <numeric>

#include "base/progress_part.hpp"

namespace gearlash::detail {
namespace {

double amplitude_in(const Answer& answer, Quantity amplitude) {
  if (answer.verdict == Verdict::grows_without_bound || answer.verdict == Verdict::runs_away) {
    return infinity;
  }
  return answer.value(amplitude).value_or(not_a_number);
}

/// An order in which each drive differs little from the one before: the nearest that is left, with
/// each parameter in units of its range.
std::vector<std::size_t> chain_of(std::span<const double> values, std::size_t count,
                                  const std::vector<double>& widths) {
  const std::size_t width = widths.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto distance = [&](std::size_t one, std::size_t other) {
    double square = 0.0;
    for (std::size_t i = 0; i < width; ++i) {
      const double apart = values[one * width + i] - values[other * width + i];
      if (widths[i] > 0.0) square += (apart / widths[i]) * (apart / widths[i]);
    }
    return square;
  };
  for (auto last = order.begin(); order.end() - last > 2; ++last) {
    const auto nearest = std::min_element(last + 1, order.end(), [&](std::size_t a, std::size_t b) {
      return distance(*last, a) < distance(*last, b);
    });
    std::iter_swap(last + 1, nearest);
  }
  return order;
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
                  amplitude != Quantity::amplitude) {
  for (const Axis& axis : axes_of(drive)) widths_.push_back(axis.values[1] - axis.values[0]);
}

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
  const TakeRow take = [&](std::size_t row, const Answer* answer) {
    results[row] = result_of(answer);
  };
  if (!one_by_one_) return !evaluate(family_, rows, {.take = take}, progress, workers_).stopped;
  constexpr std::size_t most = 1024;  // of which the order is sought at a time
  for (std::size_t first = 0; first < rows.count; first += most) {
    const std::size_t count = std::min(most, rows.count - first);
    const auto all = static_cast<double>(rows.count);
    ProgressPart part(progress, static_cast<double>(first) / all,
                      static_cast<double>(first + count) / all);
    std::vector<double> values(count * family_.width());
    rows.fill(first, values);
    if (!fill_one_by_one(values, results.subspan(first, count), part)) return false;
  }
  return true;
}

bool SampleAnswers::fill_one_by_one(std::span<const double> values, std::span<SampleResult> results,
                                    Progress& progress) const {
  constexpr std::size_t run = 8;
  const std::size_t width = family_.width();
  const std::vector<std::size_t> order = chain_of(values, results.size(), widths_);
  AskedOfRows asked{.take = [&](std::size_t row,
                                const Answer* answer) { results[order[row]] = result_of(answer); },
                    .wanted = wanted_for(target_, family_.base()),
                    .one_by_one = true};
  asked.wanted.borders = true;  // of each sample the amplitude counts
  const FamilyRows rows{.count = results.size(),
                        .fill =
                            [&](std::size_t first, std::span<double> part) {
                              for (std::size_t i = 0; i < part.size(); ++i) {
                                part[i] = values[order[first + i / width] * width + i % width];
                              }
                            },
                        .line = results.size(),
                        .run = run};
  return !evaluate(family_, rows, asked, progress, workers_).stopped;
}

SampleResults SampleAnswers::of(std::span<const double> values, Progress& progress) const {
  const FamilyRows rows = rows_of(values, family_.width());
  SampleResults results(rows.count);
  fill(rows, results, progress);
  return results;
}

}  // namespace gearlash::detail
