#include "general/attractors/irregular_motion.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "general/attractors/found_cycle.hpp"

namespace gearlash::drive {
namespace {

/// Sums of the swings of a motion's first half and of its last.
struct HalvesOfSwings {
  double first = 0.0;
  double last = 0.0;
};

HalvesOfSwings halves_of(const std::vector<Sample>& turns) {
  HalvesOfSwings sums;
  const std::size_t half = turns.empty() ? 0 : (turns.size() - 1) / 2;
  for (std::size_t i = 0; i < half; ++i) {
    sums.last += swing(turns, i);
    sums.first += swing(turns, i + half);
  }
  return sums;
}

bool shrink(const std::vector<Sample>& turns) {
  const HalvesOfSwings swings = halves_of(turns);
  constexpr double clearly = 0.9;
  return swings.last < clearly * swings.first;
}

/// Whether both halves have about the same range; or the same swings, and the wider range includes
/// the other: their middle wanders to and fro.
bool is_steady(const std::vector<Sample>& samples, const std::vector<Sample>& turns,
               const IrregularTolerances& tolerances) {
  const double middle = 0.5 * (samples.front().time + samples.back().time);
  Extent first;
  Extent last;
  for (const Sample& sample : samples) {
    (sample.time < middle ? first : last).include(sample.value);
  }
  const double wider = std::max(first.width(), last.width());
  const double share = tolerances.steadiness;
  if (agree(first.width(), last.width(), wider, share)) return true;
  const HalvesOfSwings swings = halves_of(turns);
  const double common = std::min(first.high, last.high) - std::max(first.low, last.low);
  return agree(swings.first, swings.last, std::max(swings.first, swings.last), share) &&
         common >= (1.0 - share) * std::min(first.width(), last.width());
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
  const double least = tolerances.rest.negligible_swing * setting.small_length;
  found.is_motor_alone =
      extremes(of_load, least).size() < enough && extremes(of_motor, least).size() > enough;
  const Watched& watched = found.is_motor_alone ? setting.motor : setting.load;
  const std::vector<Sample>& last = found.is_motor_alone ? of_motor : of_load;
  const std::vector<Sample> turns = extremes(last, least);
  const bool is_in_place = setting.coordinates == Coordinates::in_place;
  if (!is_in_place && turns.size() < enough) {
    result.reason =
        is_out_of_events ? "as many events as were permitted" : "still on its way at the end";
  } else if (is_small(turns, setting, tolerances.rest) && shrink(turns)) {
    result.reason = "swings shrink at the end, towards what is not certain";
  } else if (!is_in_place && !is_steady(last, turns, tolerances.irregular)) {
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

bool is_sure(const IrregularFound& found, const IrregularTolerances& tolerances, double repeating) {
  const auto error = [&](double deviation, double mean) {
    return deviation / (mean * std::sqrt(static_cast<double>(found.swings)));
  };
  const bool means_are_known =
      found.swings >= tolerances.few_swings &&
      error(found.half_swing_deviation, found.half_swing) < tolerances.error_of_means &&
      error(found.period_deviation, found.period) < tolerances.error_of_means;
  return means_are_known || found.swings >= tolerances.enough_swings || found.mismatch < repeating;
}

namespace {

bool is_alike(const IrregularFound& one, const IrregularFound& other, const SearchSetting& setting,
              const IrregularTolerances& tolerances) {
  const double extent = std::max(other.amplitude, other.motor_amplitude);
  const auto same = [&](double a, double b, double share) {
    return agree(
        a, b, 1.0,
        std::max(share * extent, tolerances.steady_steps * setting.drive.sensing.resolution));
  };
  // A slow growth shows less in a few swings.
  const double share = std::min(one.swings, other.swings) < tolerances.enough_swings
                           ? tolerances.error_of_means
                           : tolerances.steady_statistics;
  return one.is_motor_alone == other.is_motor_alone &&
         same(one.amplitude, other.amplitude, tolerances.same_ranges) &&
         same(one.motor_amplitude, other.motor_amplitude, tolerances.same_ranges) &&
         same(one.half_swing, other.half_swing, share) &&
         agree(one.period, other.period, other.period,
               one.is_motor_alone ? tolerances.same_ranges : share);
}

bool are_alike(const std::vector<Extent>& ranges, const std::vector<Extent>& others,
               Eigen::Index count, double share) {
  if (ranges.empty() || others.empty()) return false;
  const auto width_of = [&](std::size_t i) {
    return std::max(ranges[i].width(), others[i].width());
  };
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    double width = width_of(i);
    for (const auto& [one, other] :
         {std::pair{motor_position, load_position}, std::pair{motor_speed, load_speed}}) {
      const bool is_of_both =
          i == static_cast<std::size_t>(one) || i == static_cast<std::size_t>(other);
      if (is_of_both)
        width = std::max(width_of(static_cast<std::size_t>(one)),
                         width_of(static_cast<std::size_t>(other)));
    }
    const double apart =
        share * width + rounding * std::max(std::abs(others[i].low), std::abs(others[i].high));
    if (!agree(ranges[i].low, others[i].low, 1.0, apart) ||
        !agree(ranges[i].high, others[i].high, 1.0, apart)) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool is_same(const SteadyMotion& one, const SteadyMotion& other, const SearchSetting& setting,
             const IrregularTolerances& tolerances) {
  return is_alike(one.found, other.found, setting, tolerances) &&
         are_alike(one.ranges, other.ranges, setting.own, tolerances.same_ranges);
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
           (found.is_motor_alone ||
            agree(one.motor_amplitude, found.motor_amplitude, extent, share)) &&
           agree(one.half_swing, found.half_swing, extent, share);
  });
  return static_cast<std::size_t>(same - known.begin());
}

bool may_join(const IrregularFound& motion, const FoundCycle& cycle,
              const IrregularTolerances& tolerances) {
  const double above = 1.0 + tolerances.same_ranges;
  const double swing = motion.is_motor_alone ? cycle.motor_amplitude : cycle.amplitude;
  return cycle.stability == Stability::stable && cycle.amplitude <= above * motion.amplitude &&
         cycle.motor_amplitude <= above * motion.motor_amplitude &&
         motion.half_swing <= above * swing;
}

namespace {

/// Whether the motion swings as the cycle does. The cycle may have several upward passings.
bool swings_as(const IrregularFound& motion, const FoundCycle& cycle, double share) {
  const double extent = extent_of(cycle);
  const double turns = std::round(cycle.period() / motion.period);
  return cycle.stability != Stability::unstable && turns >= 1.0 &&
         agree(turns * motion.period, cycle.period(), cycle.period(), share) &&
         agree(motion.amplitude, cycle.amplitude, extent, share) &&
         agree(motion.motor_amplitude, cycle.motor_amplitude, extent, share);
}

}  // namespace

void take_for_cycles(AttractorSearch& search, const CycleTolerances& tolerances) {
  std::vector<IrregularFound> others;
  std::vector<std::pair<MotionEnd, std::size_t>> ends;  // of the starts that led to each
  for (const IrregularFound& motion : search.irregular) {
    const auto cycle = std::find_if(
        search.cycles.begin(), search.cycles.end(),
        [&](const FoundCycle& one) { return swings_as(motion, one, tolerances.agreement); });
    if (cycle == search.cycles.end()) {
      ends.emplace_back(MotionEnd::irregular, others.size());
      others.push_back(motion);
    } else {
      ends.emplace_back(MotionEnd::cycle, cycle - search.cycles.begin());
      cycle->starts += motion.starts;
    }
  }
  for (Outcome& outcome : search.outcomes) {
    if (outcome.end != MotionEnd::irregular) continue;
    std::tie(outcome.end, outcome.which) = ends[outcome.which];
  }
  search.irregular = std::move(others);
}

}  // namespace gearlash::drive
