#include "question/series/samples.hpp"

#include <algorithm>
#include <numeric>

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

/// A slow start may lead to rest, which does not matter where another hunts, unless the target asks
/// for rest. It is not watched for long then, and a few that stay undecided are enough. Of
/// irregular motion the amplitude counts: a decay that does not change it much may stay hidden, and
/// it may be steady before its mean period is.
/// Where a neighbour's motions lead into hunting of another kind, that is the sample's.
SearchScope hurried() {
  constexpr std::size_t few = 3;
  constexpr double hidden_decay = 0.25;
  const auto swings = [](const drive::AttractorSearch& search) { return search.swings(); };
  return {.suffices =
              [](const Answer& followed) {
                return gearlash::hunts(followed.verdict) && is_decided(followed);
              },
          .is_enough =
              [](const drive::AttractorSearch& search) {
                return search.swings() && search.count(drive::MotionEnd::undecided) >= few;
              },
          .may_hurry = swings,
          .tolerances = {.irregular = {.pace_suffices = true, .hidden_decay = hidden_decay}}};
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
                             const Workers& workers, bool hurries)
    : target_(target),
      amplitude_(amplitude),
      workers_(workers),
      family_(family_of(drive)),
      one_by_one_(family_.engines().search || !is_of_boxes(target) ||
                  amplitude != Quantity::amplitude),
      hurries_(hurries) {
  for (const Axis& axis : axes_of(drive)) widths_.push_back(axis.values[1] - axis.values[0]);
}

SampleResult SampleAnswers::result_of(const Answer* answer) const {
  if (answer == nullptr) return {.refused = true};
  return {.growth_at_rest = answer->growth_at_rest.value_or(not_a_number),
          .amplitude = amplitude_in(*answer, amplitude_),
          .frequency = answer->value(Quantity::frequency).value_or(not_a_number),
          .error = answer->value(Quantity::error).value_or(not_a_number),
          .verdict = answer->verdict,
          .meets = is_met(target_, *answer)};
}

bool SampleAnswers::fill(const FamilyRows& rows, std::span<SampleResult> results,
                         Progress& progress) const {
  if (!one_by_one_) {
    const TakeRow take = [&](std::size_t row, const Answer* answer) {
      results[row] = result_of(answer);
    };
    return !evaluate(family_, rows, {.take = take}, progress, workers_).stopped;
  }
  const std::size_t width = family_.width();
  std::vector<std::size_t> places(rows.count);  // of each ordered row
  const auto fill_run = [&](std::size_t from, std::span<double> values) {
    const std::size_t first = from / block_of_samples * block_of_samples;
    const std::size_t count = std::min(block_of_samples, rows.count - first);
    std::vector<double> block(count * width);
    rows.fill(first, block);
    const std::vector<std::size_t> order = chain_of(block, count, widths_);
    for (std::size_t row = from; row < from + values.size() / width; ++row) {
      const std::size_t place = order[row - first];
      places[row] = first + place;
      std::copy_n(block.begin() + static_cast<std::ptrdiff_t>(place * width), width,
                  values.begin() + static_cast<std::ptrdiff_t>((row - from) * width));
    }
  };
  AskedOfRows asked{.take = [&](std::size_t row,
                                const Answer* answer) { results[places[row]] = result_of(answer); },
                    .wanted = wanted_for(target_),
                    .one_by_one = true};
  asked.wanted.borders = true;  // of each sample the amplitude counts
  if (hurries_ && !asks_for_rest(target_)) asked.scope = hurried();
  const FamilyRows in_runs{.count = rows.count, .fill = fill_run, .line = block_of_samples};
  return !evaluate(family_, in_runs, asked, progress, workers_).stopped;
}

SampleResults SampleAnswers::of(std::span<const double> values, Progress& progress) const {
  const FamilyRows rows = rows_of(values, family_.width());
  SampleResults results(rows.count);
  fill(rows, results, progress);
  return results;
}

}  // namespace gearlash::detail
