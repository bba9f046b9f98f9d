#include "general/attractors/irregular_motion.hpp"

#include <algorithm>
#include <cmath>

#include "general/attractors/found_cycle.hpp"

namespace gearlash::drive {
namespace {

/// Whether both halves have about the same range.
bool is_steady(const std::vector<Sample>& samples, const IrregularTolerances& tolerances) {
  const double middle = 0.5 * (samples.front().time + samples.back().time);
  Extent first;
  Extent second;
  for (const Sample& sample : samples) {
    (sample.time < middle ? first : second).include(sample.value);
  }
  return agree(first.width(), second.width(), std::max(first.width(), second.width()),
               tolerances.steadiness);
}

/// Whether the swings of the last half are smaller than those of the first.
bool shrink(const std::vector<Sample>& turns) {
  const std::size_t half = (turns.size() - 1) / 2;
  double last = 0.0;
  double first = 0.0;
  for (std::size_t i = 0; i < half; ++i) {
    last += swing(turns, i);
    first += swing(turns, i + half);
  }
  constexpr double clearly = 0.9;
  return last < clearly * first;
}

Spread spread_of_periods(const std::vector<double>& passings) {
  std::vector<double> periods;
  for (std::size_t i = 0; i + 1 < passings.size(); ++i) {
    periods.push_back(passings[i + 1] - passings[i]);
  }
  return spread_of(periods);
}

Spread spread_of_half_swings(const std::vector<Sample>& turns) {
  std::vector<double> half_swings;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) half_swings.push_back(0.5 * swing(turns, i));
  return spread_of(half_swings);
}

}  // namespace

Irregularity irregularity_of(const Watch& watch, const Stretch& stretch,
                             const SearchSetting& setting, const SearchTolerances& tolerances,
                             bool is_out_of_events) {
  const double from = stretch.from;
  const std::size_t enough = tolerances.irregular.least_turns;
  const std::vector<Sample> of_load = after(watch.load, from);
  const std::vector<Sample> of_motor = after(watch.motor, from);
  Irregularity result;
  IrregularFound& found = result.found;
  // Within the gap the motor may hunt alone while the load stands.
  found.is_motor_alone =
      extremes(of_load).size() < enough &&
      count_of_swings(extremes(of_motor), from, setting, tolerances.rest) >= enough;
  const Watched& watched = found.is_motor_alone ? setting.motor : setting.load;
  const std::vector<Sample>& last = found.is_motor_alone ? of_motor : of_load;
  const std::vector<Sample> turns = extremes(last);
  const bool is_in_place = setting.coordinates == Coordinates::in_place;
  if (!is_in_place && turns.size() < enough) {
    result.reason =
        is_out_of_events ? "as many events as were permitted" : "still on its way at the end";
  } else if (is_small(turns, setting, tolerances.rest) && shrink(turns)) {
    result.reason = "swings shrink at the end, towards what is not certain";
  } else if (!is_in_place && !is_steady(last, tolerances.irregular)) {
    result.reason = "swings still grow or shrink at the end";
  }
  if (!result.reason.empty()) return result;
  const Extent range = extent_of(of_load);
  found.amplitude = 0.5 * range.width();
  found.motor_amplitude = 0.5 * extent_of(of_motor).width();
  found.center = range.middle();
  found.watched = stretch.to - from;
  const double middle = extent_of(last).middle();
  const Spread period = spread_of_periods(
      stretch.motion ? upward_passings(*stretch.motion, watched, last, middle, from)
                     : upward_passings(turns, middle));
  found.period = period.mean;
  found.period_deviation = period.deviation;
  const Spread half_swing = spread_of_half_swings(turns);
  found.half_swing = half_swing.mean;
  found.half_swing_deviation = half_swing.deviation;
  found.mismatch = least_mismatch(turns);
  found.swings = turns.empty() ? 0 : turns.size() - 1;
  return result;
}

bool is_alike(const IrregularFound& one, const IrregularFound& other, const SearchSetting& setting,
              const IrregularTolerances& tolerances) {
  const auto same = [&](double a, double b, double scale) {
    return agree(a, b, 1.0,
                 std::max(tolerances.steady_statistics * scale,
                          tolerances.steady_steps * setting.drive.sensing.resolution));
  };
  const double extent = std::max(other.amplitude, other.motor_amplitude);
  return one.is_motor_alone == other.is_motor_alone &&
         same(one.amplitude, other.amplitude, extent) &&
         same(one.motor_amplitude, other.motor_amplitude, extent) &&
         same(one.half_swing, other.half_swing, extent) &&
         agree(one.period, other.period, other.period, tolerances.steady_statistics);
}

bool are_alike(const std::vector<Extent>& ranges, const std::vector<Extent>& others,
               Eigen::Index count, double share) {
  if (ranges.empty() || others.empty()) return false;
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const double width = std::max(ranges[i].width(), others[i].width());
    const double apart =
        share * width + rounding * std::max(std::abs(others[i].low), std::abs(others[i].high));
    if (!agree(ranges[i].low, others[i].low, 1.0, apart) ||
        !agree(ranges[i].high, others[i].high, 1.0, apart)) {
      return false;
    }
  }
  return true;
}

std::size_t place_among(const std::vector<IrregularFound>& known, const IrregularFound& found,
                        const IrregularTolerances& tolerances) {
  const double share = tolerances.same_motion;
  const double extent = std::max(found.amplitude, found.motor_amplitude);
  const auto same = std::find_if(known.begin(), known.end(), [&](const IrregularFound& one) {
    // If the motor hunts alone, the load may stand anywhere.
    const bool is_centered = found.is_motor_alone || agree(one.center, found.center, extent, share);
    return one.is_motor_alone == found.is_motor_alone && is_centered &&
           agree(one.amplitude, found.amplitude, extent, share) &&
           agree(one.half_swing, found.half_swing, extent, share);
  });
  return static_cast<std::size_t>(same - known.begin());
}

}  // namespace gearlash::drive
