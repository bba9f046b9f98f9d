#include "general/attractors/irregular_motion.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/special_numbers.hpp"
#include "general/attractors/found_cycle.hpp"

namespace gearlash::drive {

using hybrid::State;

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

/// Of the samples before a time, and from it on.
std::pair<Extent, Extent> ranges_about(double time, const std::vector<Sample>& samples) {
  std::pair<Extent, Extent> ranges;
  for (const Sample& sample : samples) {
    (sample.time < time ? ranges.first : ranges.second).include(sample.value);
  }
  return ranges;
}

/// Whether both halves have about the same range; or the same swings, and the wider range includes
/// the other: their middle wanders to and fro.
bool is_steady(const std::vector<Sample>& samples, const std::vector<Sample>& turns,
               const IrregularTolerances& tolerances) {
  const auto [first, last] =
      ranges_about(0.5 * (samples.front().time + samples.back().time), samples);
  const double wider = std::max(first.width(), last.width());
  const double share = tolerances.steadiness;
  if (agree(first.width(), last.width(), wider, share)) return true;
  const HalvesOfSwings swings = halves_of(turns);
  const double common = std::min(first.high, last.high) - std::max(first.low, last.low);
  return agree(swings.first, swings.last, std::max(swings.first, swings.last), share) &&
         common >= (1.0 - share) * std::min(first.width(), last.width());
}

Spread spread_of_periods(const std::vector<double>& passings) {
  return spread_of(of_neighbors(passings, [](double one, double next) { return next - one; }));
}

/// Of the middles of swings.
double mean_middle(const std::vector<Sample>& turns) {
  const auto middle = [](const Sample& one, const Sample& next) {
    return 0.5 * (one.value + next.value);
  };
  return spread_of(of_neighbors(turns, middle)).mean;
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
  constexpr double hardly = 0.1;
  found.is_motor_alone = extremes(of_load, least).size() < enough &&
                         extremes(of_motor, least).size() > enough &&
                         extent_of(of_load).width() < hardly * extent_of(of_motor).width();
  const Watched& watched = found.is_motor_alone ? setting.motor : setting.load;
  const std::vector<Sample>& last = found.is_motor_alone ? of_motor : of_load;
  const std::vector<Sample> turns = extremes(last, least);
  if (turns.size() < enough) {
    result.reason =
        is_out_of_events ? "as many events as were permitted" : "still on its way at the end";
  } else if (is_small(turns, setting, tolerances.rest) && shrink(turns)) {
    result.reason = "swings shrink at the end, towards what is not certain";
  } else if (!is_steady(last, turns, tolerances.irregular)) {
    result.reason = "swings still grow or shrink at the end";
  }
  if (!result.reason.empty()) return result;
  const Extent range = extent_of(of_load);
  found.amplitude = 0.5 * range.width();
  found.motor_amplitude = 0.5 * extent_of(of_motor).width();
  found.center = range.middle();
  found.mean_center = found.is_motor_alone ? found.center : mean_middle(turns);
  constexpr double rarely = 1e-3;
  found.error = size_exceeded_for(rarely, setting.error ? after(watch.error, from) : of_load);
  if (found.is_motor_alone && !setting.error) {
    found.error = std::max(found.error, error_beside(extent_of(of_motor), setting.drive));
  }
  found.watched = stretch.time - from;
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
  found.fastest_decay = fastest_decay(last);
  return result;
}

double fastest_decay(const std::vector<Sample>& samples) {
  constexpr double of_range = 0.1;
  const std::vector<Sample> turns = extremes(samples, of_range * extent_of(samples).width());
  const std::size_t swings = turns.empty() ? 0 : turns.size() - 1;
  constexpr std::size_t most_blocks = 20;
  constexpr std::size_t few_blocks = 4;
  const std::size_t blocks = swings >= 2 * most_blocks ? most_blocks : few_blocks;
  const double student = blocks == most_blocks ? 1.734 : 2.920;  // 95 %, 18 or 2 degrees of freedom
  if (swings < 2 * blocks) return infinity;
  std::vector<Sample> means;
  double mean_time = 0.0;
  double mean_value = 0.0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t from = i * swings / blocks;
    const std::size_t to = (i + 1) * swings / blocks;
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += std::abs(turns[k + 1].value - turns[k].value);
    means.push_back({0.5 * (turns[from].time + turns[to].time),
                     std::log(sum / static_cast<double>(to - from))});
    mean_time += means.back().time / static_cast<double>(blocks);
    mean_value += means.back().value / static_cast<double>(blocks);
  }
  double squares = 0.0;
  double products = 0.0;
  for (const Sample& one : means) {
    squares += (one.time - mean_time) * (one.time - mean_time);
    products += (one.time - mean_time) * (one.value - mean_value);
  }
  const double slope = products / squares;
  double misfit = 0.0;
  for (const Sample& one : means) {
    const double off = one.value - mean_value - slope * (one.time - mean_time);
    misfit += off * off;
  }
  return -slope + student * std::sqrt(misfit / (static_cast<double>(blocks - 2) * squares));
}

bool excludes_decay(double fastest_decay, double watched, const IrregularTolerances& tolerances) {
  return fastest_decay * watched <= tolerances.hidden_decay;
}

namespace {

/// Standard errors of means.
double error_of_half_swing(const IrregularFound& motion) {
  return motion.half_swing_deviation / std::sqrt(static_cast<double>(motion.swings));
}
double error_of_period(const IrregularFound& motion) {
  return motion.period_deviation / std::sqrt(motion.watched / motion.period);
}

}  // namespace

bool is_sure(const IrregularFound& found, const IrregularTolerances& tolerances, double repeating) {
  const bool means_are_known =
      found.swings >= tolerances.few_swings &&
      error_of_half_swing(found) < tolerances.error_of_means * found.half_swing &&
      error_of_period(found) < tolerances.error_of_means * found.period;
  return means_are_known || found.swings >= tolerances.enough_swings || found.mismatch < repeating;
}

namespace {

/// By how much two means of one motion may differ: at 95 %, but by `least` at least.
double apart_by_chance(double error, double other_error, double least) {
  constexpr double normal = 1.96;
  return std::max(least, normal * std::hypot(error, other_error));
}

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
  const auto time_of_swing = [](const IrregularFound& found) {
    return found.watched / static_cast<double>(found.swings);
  };
  const bool may_count =
      tolerances.pace_suffices && std::min(one.swings, other.swings) >= tolerances.enough_swings;
  const bool has_same_pace =
      agree(one.period, other.period, other.period,
            one.is_motor_alone ? tolerances.same_ranges : share) ||
      (may_count && agree(time_of_swing(one), time_of_swing(other), time_of_swing(other), share));
  return one.is_motor_alone == other.is_motor_alone && has_same_pace &&
         same(one.amplitude, other.amplitude, tolerances.same_ranges) &&
         same(one.motor_amplitude, other.motor_amplitude, tolerances.same_ranges) &&
         same(one.half_swing, other.half_swing, share);
}

/// The drive's own numbers. In place positions go along with the reference.
bool are_alike(const std::vector<Extent>& ranges, const std::vector<Extent>& others,
               const SearchSetting& setting, double share) {
  if (ranges.empty() || others.empty()) return false;
  const StateIndices& at = setting.built.at;
  const auto goes_along = [&](std::size_t i) {
    const auto number = static_cast<Eigen::Index>(i);
    return setting.coordinates == Coordinates::in_place &&
           (number == motor_position || number == load_position || number == at.encoder ||
            number == at.last_reading);
  };
  const auto width_of = [&](std::size_t i) {
    return std::max(ranges[i].width(), others[i].width());
  };
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < static_cast<std::size_t>(setting.own); ++i) {
    if (goes_along(i)) continue;
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
  const double extent = std::max(other.found.amplitude, other.found.motor_amplitude);
  const bool is_centered =
      setting.coordinates != Coordinates::in_place ||
      agree(one.found.center, other.found.center, extent, tolerances.same_ranges);
  return is_centered && is_alike(one.found, other.found, setting, tolerances) &&
         are_alike(one.ranges, other.ranges, setting, tolerances.same_ranges);
}

namespace {

/// Positions to the share to which motions repeat, or half an encoder step; no number drifts.
bool is_same_course(const Course& one, const Course& other, const IrregularFound& found,
                    const SearchSetting& setting, const IrregularTolerances& tolerances) {
  if (one.positions.empty() || other.positions.empty()) return false;
  const double apart =
      std::max(tolerances.repeating * std::max(found.amplitude, found.motor_amplitude),
               tolerances.steady_steps * setting.drive.sensing.resolution);
  for (std::size_t i = 0; i < one.means.size(); ++i) {
    // One that drifts changes its mean by its range; those that chatter scatter.
    constexpr double drift = 0.5;
    constexpr double rounding = 1e-9;
    const double width =
        std::max({one.widths[i], other.widths[i], rounding * std::abs(one.means[i])});
    if (!agree(one.means[i], other.means[i], width, drift)) return false;
  }
  return std::equal(one.positions.begin(), one.positions.end(), other.positions.begin(),
                    [&](double a, double b) { return agree(a, b, 1.0, apart); });
}

}  // namespace

bool repeats_course(const Watch& watch, const Stretch& stretch, const IrregularFound& found,
                    const SearchSetting& setting, const IrregularTolerances& tolerances) {
  const auto [first, last] =
      ranges_about(0.5 * (stretch.from + stretch.time), after(watch.load, stretch.from));
  const double apart = tolerances.steady_statistics * std::max(first.width(), last.width());
  return agree(first.low, last.low, 1.0, apart) && agree(first.high, last.high, 1.0, apart) &&
         is_same_course(stretch.course, stretch.course_before, found, setting, tolerances);
}

bool runs_along(const Stretch& stretch, const SteadyMotion& known, const SearchSetting& setting,
                const IrregularTolerances& tolerances) {
  return known.repeats_course &&
         is_same_course(stretch.course, known.course, known.found, setting, tolerances);
}

namespace {

/// Whether an integral of the error of a drive that stands goes to and fro: its mean is that of a
/// reading at the reference's middle.
bool integrates_nothing(const SearchSetting& setting, const State& here) {
  if (!integrates(setting.drive.controller)) return true;
  const Sensing& sensing = setting.drive.sensing;
  const double share = sensing.load_share_of_position;
  const double middle = middle_of(setting.drive.reference);
  const double sensed = middle + share * setting.load.value.at(here.numbers) +
                        (1.0 - share) * setting.motor.value.at(here.numbers);
  const double step = sensing.resolution;
  const double reading = step > 0.0 ? step * std::round(sensed / step) : sensed;
  constexpr double rounding = 1e-9;
  return std::abs(reading - middle) <= rounding * setting.small_length;
}

}  // namespace

bool stands_while_driven(const Watch& watch, const Stretch& stretch, const SearchSetting& setting,
                         const SearchTolerances& tolerances) {
  constexpr double enough = 3.0;
  const double period = setting.longest_sine;
  if (period == 0.0 || stretch.time - stretch.from < enough * period) return false;
  const double no_move = tolerances.rest.no_move * setting.small_length;
  const auto stands = [&](const std::vector<Sample>& samples) {
    return extent_of(after(samples, stretch.from)).width() <= no_move;
  };
  return stands(watch.load) && stands(watch.motor) && integrates_nothing(setting, watch.here) &&
         are_alike(stretch.last, watch.before, setting, tolerances.irregular.steady_statistics);
}

std::size_t place_among(const std::vector<IrregularFound>& known, const IrregularFound& found,
                        const IrregularTolerances& tolerances) {
  const double share = tolerances.same_motion;
  const double extent = std::max(found.amplitude, found.motor_amplitude);
  const auto same = std::find_if(known.begin(), known.end(), [&](const IrregularFound& one) {
    // If the motor hunts alone, the load may stand anywhere.
    const auto is_centered = [&](double apart) {
      return found.is_motor_alone || agree(one.mean_center, found.mean_center, extent, apart);
    };
    // Its mean swings are better known than its extremes, which are larger the longer it is
    // watched.
    const auto has_same_mean = [&](double mean, double error, double other, double other_error) {
      const double apart = apart_by_chance(error, other_error, tolerances.steady_statistics * mean);
      return agree(other, mean, 1.0, std::min(apart, share * mean));
    };
    const bool has_same_means =
        has_same_mean(found.half_swing, error_of_half_swing(found), one.half_swing,
                      error_of_half_swing(one)) &&
        has_same_mean(found.period, error_of_period(found), one.period, error_of_period(one));
    const bool has_same_extremes =
        agree(one.amplitude, found.amplitude, extent, share) &&
        (found.is_motor_alone ||
         agree(one.motor_amplitude, found.motor_amplitude, extent, share)) &&
        agree(one.half_swing, found.half_swing, extent, share);
    return one.is_motor_alone == found.is_motor_alone &&
           ((has_same_means && is_centered(tolerances.wandering)) ||
            (has_same_extremes && is_centered(tolerances.same_ranges)));
  });
  return static_cast<std::size_t>(same - known.begin());
}

bool may_join(const IrregularFound& motion, const FoundCycle& cycle,
              const IrregularTolerances& tolerances) {
  const double above = 1.0 + tolerances.same_ranges;
  return cycle.stability == Stability::stable && cycle.amplitude <= above * motion.amplitude &&
         cycle.motor_amplitude <= above * motion.motor_amplitude;
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
