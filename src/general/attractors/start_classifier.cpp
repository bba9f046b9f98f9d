#include "general/attractors/start_classifier.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "base/lists.hpp"
#include "general/attractors/found_cycle.hpp"
#include "general/attractors/motion_measures.hpp"
#include "general/attractors/time_to_rest.hpp"
#include "hybrid/limit_in_mode.hpp"
#include "hybrid/shrinking_rounds.hpp"

namespace gearlash::drive {

using hybrid::State;
using hybrid::StopReason;
using hybrid::Trajectory;

std::size_t steps_kept(const SearchSetting& setting, const SearchBudget& budget) {
  const auto numbers = static_cast<std::size_t>(setting.system.system().size());
  constexpr std::size_t least = 1000;  // fewer would show neither rest nor swings
  return std::max(least, budget.bytes_kept / (sizeof(double) * (numbers + 3)));
}

Verdict StartClassifier::end_of(const State& start, double patience, double longer) {
  Watch watch{.here = start,
              .starts_at_rest = setting_.load.speed.at(start.numbers) == 0.0,
              .progress = &asked_};
  Verdict verdict = watched(watch, patience, longer);
  if (!is_disturbed_) last_ = std::move(watch);
  return verdict;
}

std::optional<double> StartClassifier::time_to_rest(const Verdict& verdict, double band) const {
  const double final = verdict.approach ? verdict.approach->final : verdict.rest.back().load;
  const double later = verdict.approach ? time_until_within(band, *verdict.approach) : 0.0;
  if (later > 0.0) return last_.time + later;
  return last_time_outside(band, final, last_, setting_, steps_kept(setting_, budget_));
}

Verdict StartClassifier::watched(Watch& watch, double patience, double longer) {
  const double no_move = tolerances_.rest.no_move * setting_.small_length;
  bool is_costly = setting_.drive.sampling || is_driven(setting_.drive);
  double length = first_stretch();
  std::size_t most_in_stretch =
      std::max(budget_.ticks_of_stretch, is_under_sine() ? ticks_in(length) : 0);
  std::optional<SteadyMotion> before;
  while (true) {
    const double until = setting_.between_ticks(watch.time + length);
    const Stretch stretch = next_stretch(watch, until, most_in_stretch);
    Verdict verdict;
    verdict.watched = watch.time;
    if (is_decided(watch, stretch, verdict)) return verdict;
    if (longer == 1.0 && joins(stretch, verdict)) return verdict;
    if (longer == 1.0 && is_steady(watch, stretch, before, verdict)) return verdict;
    if (!goes_on_()) {
      verdict.reason = "the search was stopped";
      return verdict;
    }
    const auto stood = standstills(watch.load, watch.motor, no_move);
    is_costly = is_costly || stretch.stop_reason == StopReason::step_limit;
    const double counted = is_costly
                               ? watch.time - (1.0 - budget_.counted_if_costly) * duration_of(stood)
                               : watch.busy;
    const double most = longer * longest(watch, stretch, patience);
    const bool is_over = watch.events >= most_events() || counted >= most;
    const bool is_long = is_over || (is_costly && watch.time >= most);
    if (creeps(stood, watch, is_long, verdict)) return verdict;
    if (is_over) {
      give_up(watch, stretch, before, verdict);
      return verdict;
    }
    watch.before = stretch.last;
    // Events may have ended the stretch.
    length = 2.0 * (stretch.time - stretch.from);
    most_in_stretch = std::max(budget_.ticks_of_stretch, 2 * stretch.events);
  }
}

std::size_t StartClassifier::most_events() const {
  const std::size_t ticks = setting_.drive.sampling ? budget_.most_ticks * options_.most_events : 0;
  const std::size_t under_sine =
      is_under_sine() ? ticks_in(budget_.most_periods_of_sine * setting_.common_sine) : 0;
  return options_.most_events + std::max(ticks, under_sine);
}

std::size_t StartClassifier::ticks_in(double time) const {
  constexpr double ticks_of_period = 2.0;  // a sample, and its output
  return static_cast<std::size_t>(ticks_of_period * time / setting_.drive.sampling->period);
}

double StartClassifier::first_stretch() const {
  if (is_under_sine() && setting_.swing_time <= setting_.common_sine) {
    return setting_.common_sine *
           (known_.empty() ? budget_.periods_of_sine : budget_.periods_to_join);
  }
  const bool may_join =
      is_under_sine() ? !known_.empty() : !setting_.drive.sampling && !search_.cycles.empty();
  const double share = may_join ? budget_.share_to_join : 1.0;
  return share * budget_.first_stretch * setting_.swing_time;
}

Stretch StartClassifier::next_stretch(Watch& watch, double until,
                                      std::size_t most_if_sampled) const {
  const std::size_t most = std::max<std::size_t>(1, most_events() - watch.events);
  if (setting_.drive.sampling) {
    const bool is_last = most < 2 * most_if_sampled;  // no short stretch remains
    return observe(watch, until, is_last ? most : most_if_sampled, setting_);
  }
  return follow(watch, until, steps_kept(setting_, budget_),
                std::min(most, budget_.events_of_stretch), setting_, budget_);
}

double StartClassifier::longest(const Watch& watch, const Stretch& stretch, double patience) const {
  const auto recent = [&](const std::vector<Sample>& turns) {
    return count_of_swings(turns, stretch.from, setting_, tolerances_.rest);
  };
  const std::vector<Sample> turns = turns_of(watch, setting_, tolerances_.rest);
  // Swings that still shrink may end in rest, and those that grow in a cycle.
  const std::size_t count = recent(turns);
  const double last = count > 2 ? swing(turns, 0) : 0.0;
  const double first = count > 2 ? swing(turns, count - 2) : 0.0;
  const bool changes =
      last < budget_.still_changing * first || first < budget_.still_changing * last;
  const bool hardly_moves =
      setting_.drive.sampling ||
      std::max(recent(turns), recent(extremes(watch.motor))) < budget_.hardly_any_swings;
  const bool is_slow = hardly_moves || is_small(turns, setting_, tolerances_.rest) || changes ||
                       !excludes_decay(fastest_decay(after(watch.load, stretch.from)),
                                       stretch.time - stretch.from, tolerances_.irregular);
  constexpr double rounding = 1e-9;  // allows for rounding of the summed stretches
  const double more = is_slow ? patience : 1.0;
  const double times = setting_.drive.sampling ? more * budget_.patience_if_sampled : more;
  return times * search_.watch_time * (1.0 - rounding);
}

bool StartClassifier::is_decided(const Watch& watch, const Stretch& stretch, Verdict& verdict) {
  if (stretch.stop_reason == StopReason::diverged || has_run_away(watch, setting_, tolerances_)) {
    verdict.end = MotionEnd::diverges;
    return true;
  }
  const RestTolerances& rest = tolerances_.rest;
  const bool may_rest = setting_.coordinates != Coordinates::in_place;
  if (may_rest && (settles(watch, stretch, verdict) || fades(watch, stretch, verdict))) return true;
  const bool goes_on = !is_endless(stretch);
  const bool rests = is_at_rest(watch, stretch, setting_, rest) ||
                     stands_while_driven(watch, stretch, setting_, tolerances_) ||
                     (goes_on && is_vanishing(watch, stretch, verdict));
  if (may_rest ? rests : moves_along(watch, stretch, setting_, rest)) {
    rest_at(watch, watch.here.numbers, verdict);
    return true;
  }
  if (!goes_on) verdict.reason = "events without end: " + stretch.culprit;
  if (!goes_on || !may_rest) return !goes_on;
  return stretch.motion &&
         is_on_cycle(*stretch.motion, {tolerances_.cycle.nearness, tolerances_.cycle.wide_nearness},
                     verdict);
}

void StartClassifier::rest_at(const Watch& watch, const hybrid::Vector& numbers,
                              Verdict& verdict) const {
  verdict.end = MotionEnd::rest;
  verdict.rest = {
      {.load = setting_.load.value.at(numbers), .motor = setting_.motor.value.at(numbers)}};
  const double moved = std::max(extent_of(watch.load).width(), extent_of(watch.motor).width());
  if (verdict.is_creeping) return;
  verdict.uncertainty =
      tolerances_.rest.still * moved + tolerances_.rest.no_move * setting_.small_length;
}

bool StartClassifier::settles(const Watch& watch, const Stretch& stretch, Verdict& verdict) {
  const double no_move = tolerances_.rest.no_move * setting_.small_length;
  const auto settles_from = [&](State state) {
    // What rounding leaves between a shaft and the reference would be integrated for ages.
    for (const Watched* shaft : {&setting_.load, &setting_.motor}) {
      const Eigen::Index position = shaft == &setting_.load ? load_position : motor_position;
      if (std::abs(shaft->value.at(state.numbers)) < no_move) state.numbers[position] = 0.0;
    }
    const hybrid::AffineMode& mode = setting_.system.system().mode(state.mode);
    const auto limit = hybrid::limit_in_mode(mode, state.numbers);
    const auto drifts = [&](const Watched& shaft) {
      return shaft.value.normal.dot(limit->drift) != 0.0;
    };
    if (!limit || drifts(setting_.load) || drifts(setting_.motor)) return false;
    rest_at(watch, limit->numbers, verdict);
    if (limit->is_on_border) {
      verdict = disturbed({state.mode, limit->numbers}, verdict);
      if (verdict.end != MotionEnd::rest) search_.rests_until_disturbed = true;
    }
    return true;
  };
  if (settles_from(watch.here)) return true;
  const auto quiet = stretch.motion ? longest_move(*stretch.motion, setting_) : std::nullopt;
  return quiet && settles_from(stretch.motion->at(*quiet));
}

bool StartClassifier::fades(const Watch& watch, const Stretch& stretch, Verdict& verdict) const {
  if (!stretch.motion) return false;
  const RestTolerances& rest = tolerances_.rest;
  const auto limit = hybrid::shrinking_rounds(setting_.system.system(), *stretch.motion,
                                              rest.fading, rest.vanishing_limit);
  if (!limit) return false;
  rest_at(watch, limit->numbers, verdict);
  for (const Watched* shaft : {&setting_.load, &setting_.motor}) {
    const double off = shaft->value.normal.cwiseAbs().dot(limit->off);
    verdict.uncertainty = std::max(*verdict.uncertainty, off);
  }
  return true;
}

Verdict StartClassifier::disturbed(const State& rest, const Verdict& undisturbed) {
  if (has_dry_friction(setting_.drive) || is_disturbed_) return undisturbed;
  const auto known = ends_of_disturbed_.find(rest.mode);
  if (known != ends_of_disturbed_.end()) return known->second;
  is_disturbed_ = true;
  Verdict end = undisturbed;
  for (const double side : {1.0, -1.0}) {
    State start = rest;
    for (const Eigen::Index position : {motor_position, load_position}) {
      start.numbers[position] += side * options_.chosen_starts.least_step * setting_.small_length /
                                 setting_.frame.scale[position];
    }
    Verdict next = end_of(start, budget_.patience);
    if (next.end == MotionEnd::rest) continue;
    end = std::move(next);
    break;
  }
  is_disturbed_ = false;
  return ends_of_disturbed_.emplace(rest.mode, std::move(end)).first->second;
}

bool StartClassifier::creeps(const std::vector<Standstill>& stood, const Watch& watch, bool is_long,
                             Verdict& verdict) const {
  const RestTolerances& rest = tolerances_.rest;
  verdict.approach = creeping(watch, setting_, rest);
  verdict.is_creeping =
      verdict.approach || (is_long && stands_for_long(stood, watch, setting_, rest));
  if (!verdict.is_creeping) return false;
  rest_at(watch, watch.here.numbers, verdict);
  return true;
}

const StartClassifier::Known* StartClassifier::known_as(const SteadyMotion& motion) const {
  return first_of(known_, [&](const Known& one) {
    return is_same(one.motion, motion, setting_, tolerances_.irregular);
  });
}

SteadyMotion StartClassifier::steady(const Watch& watch, const Stretch& stretch,
                                     const IrregularFound& found) const {
  return {.found = found,
          .ranges = stretch.last,
          .course = stretch.course,
          .repeats_course = repeats_course(watch, stretch, found, setting_, tolerances_.irregular)};
}

bool StartClassifier::joins(const Stretch& stretch, Verdict& verdict) const {
  const Known* known = first_of(known_, [&](const Known& one) {
    return runs_along(stretch, one.motion, setting_, tolerances_.irregular);
  });
  if (known == nullptr) return false;
  verdict.end = known->end;
  verdict.which = known->which;
  verdict.irregular = known->motion.found;
  return true;
}

bool StartClassifier::is_steady(const Watch& watch, const Stretch& stretch,
                                std::optional<SteadyMotion>& before, Verdict& verdict) {
  const IrregularTolerances& irregular = tolerances_.irregular;
  const Irregularity seen = irregularity_of(watch, stretch, setting_, tolerances_, false);
  if (!seen.reason.empty()) {
    if (watch.events < most_events()) before.reset();  // not of a stretch that was cut short
    return false;
  }
  const SteadyMotion now = steady(watch, stretch, seen.found);
  if (stretch.motion && may_still_close(now, before)) {
    before = now;
    return false;
  }
  const bool may_be_known = is_sure(now.found, irregular, irregular.repeating);
  if (const Known* known = may_be_known ? known_as(now) : nullptr) {
    verdict.end = known->end;
    verdict.which = known->which;
    verdict.irregular = now.found;
    return true;
  }
  const bool is_repeated =
      now.repeats_course || (before && is_same(*before, now, setting_, irregular));
  before = now;
  if (!is_repeated || !is_sure(now.found, irregular, irregular.repeating_exactly) ||
      !excludes_decay(now.found.fastest_decay, now.found.watched, irregular)) {
    return false;
  }
  if (!closes(watch, stretch, now.found, verdict)) take(watch, now.found, verdict, &stretch);
  known_.push_back({now, verdict.end, verdict.which});
  return true;
}

bool StartClassifier::may_still_close(const SteadyMotion& now,
                                      const std::optional<SteadyMotion>& before) const {
  const double mismatch = now.found.mismatch;
  return mismatch < tolerances_.irregular.repeating ||
         (before && mismatch < budget_.still_changing * before->found.mismatch);
}

bool StartClassifier::closes(const Watch& watch, const Stretch& stretch,
                             const IrregularFound& found, Verdict& verdict) {
  if (stretch.motion || setting_.coordinates == Coordinates::in_place) return false;
  if (!(found.mismatch < tolerances_.irregular.repeating)) return false;
  return is_on_cycle(recorded(watch, found, budget_.closing_periods),
                     {tolerances_.cycle.nearness, tolerances_.cycle.wide_nearness}, verdict);
}

Trajectory StartClassifier::recorded(const Watch& watch, const IrregularFound& found,
                                     double periods) const {
  const double period = std::isfinite(found.period) ? found.period : setting_.swing_time;
  return simulate(setting_.system, watch.here,
                  {.from = watch.time,
                   .until = setting_.between_ticks(watch.time + periods * period),
                   .event_limit = budget_.recorded_events});
}

bool StartClassifier::is_vanishing(const Watch& watch, const Stretch& stretch,
                                   Verdict& verdict) const {
  const bool is_small_by_now = extent_of(after(watch.load, stretch.from)).width() <
                               tolerances_.rest.small_motion * setting_.small_length;
  const double awaited =
      std::min(search_.watch_time, budget_.settling_times * setting_.settling_time);
  if (!is_small_by_now || !(watch.time > awaited)) return false;
  verdict.approach =
      vanishing_swings(turns_of(watch, setting_, tolerances_.rest), setting_, tolerances_.rest);
  if (verdict.approach) verdict.swing_ratio = verdict.approach->ratio;
  return verdict.approach.has_value();
}

bool StartClassifier::is_on_cycle(const Trajectory& motion,
                                  std::initializer_list<double> all_nearness, Verdict& verdict) {
  const auto ends_in = [&](MotionEnd end, std::size_t which) {
    verdict.end = end;
    verdict.which = which;
    return true;
  };
  if (const auto which = closing_.known_cycle_of(motion, search_.cycles)) {
    return ends_in(MotionEnd::cycle, *which);
  }
  for (const double nearness : all_nearness) {
    const auto found = closing_.closed_cycle(motion, nearness);
    if (!found) continue;
    const bool is_left = found->stability == Stability::unstable;
    if (!is_left) verdict.rest = places_of_rest(*found, setting_, tolerances_.rest);
    verdict.is_creeping = !verdict.rest.empty();
    if (verdict.is_creeping) return ends_in(MotionEnd::rest, 0);
    const std::size_t which = place_of(*found, tolerances_.cycle, search_.cycles);
    if (!is_left) return ends_in(MotionEnd::cycle, which);
  }
  return false;
}

void StartClassifier::give_up(const Watch& watch, const Stretch& stretch,
                              const std::optional<SteadyMotion>& before, Verdict& verdict) {
  // The motion may approach its cycle slowly.
  const bool may_close = stretch.motion && setting_.coordinates != Coordinates::in_place;
  if (may_close && is_on_cycle(*stretch.motion, {tolerances_.cycle.widest_nearness}, verdict))
    return;
  const bool is_out_of_events = watch.events >= most_events();
  Irregularity seen = irregularity_of(watch, stretch, setting_, tolerances_, is_out_of_events);
  if (!seen.reason.empty() && !before && !stretch.motion) {
    Stretch longer = stretch;  // the last half of the watch, which may have swings enough
    longer.from = 0.5 * watch.time;
    seen = irregularity_of(watch, longer, setting_, tolerances_, is_out_of_events);
  }
  if (!seen.reason.empty() && !before) {
    verdict.reason = seen.reason;
    return;
  }
  const SteadyMotion last = seen.reason.empty() ? steady(watch, stretch, seen.found) : *before;
  if (!excludes_decay(last.found.fastest_decay, last.found.watched, tolerances_.irregular)) {
    std::ostringstream reason;
    reason << std::setprecision(2) << "after " << watch.time
           << " s swings may still decay by up to " << last.found.fastest_decay << "/s";
    verdict.reason = reason.str();
    return;
  }
  take(watch, last.found, verdict, &stretch);
  known_.push_back({last, verdict.end, 0});
}

void StartClassifier::take(const Watch& watch, const IrregularFound& found, Verdict& verdict,
                           const Stretch* stretch) {
  verdict.end = MotionEnd::irregular;
  verdict.irregular = found;
  const bool is_known =
      place_among(search_.irregular, found, tolerances_.irregular) != search_.irregular.size();
  if (is_known || setting_.drive.sensing.reads_steps()) return;
  const bool is_kept = stretch != nullptr && stretch->motion;
  verdict.irregular.exponent = largest_exponent(
      setting_.system.system(),
      is_kept ? *stretch->motion : recorded(watch, found, budget_.compared_periods), setting_.own);
}

}  // namespace gearlash::drive
