#include "general/attractors/attractors.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include "general/attractors/cycle_closing.hpp"
#include "general/attractors/found_cycle.hpp"
#include "general/attractors/irregular_motion.hpp"
#include "general/attractors/motion_watch.hpp"
#include "general/attractors/search_setting.hpp"
#include "general/attractors/thresholds.hpp"

namespace gearlash::drive {
namespace {

using hybrid::State;
using hybrid::StopReason;
using hybrid::Trajectory;
using hybrid::Vector;

// ---- the search ---------------------------------------------------------------------------------

/// Where a motion ends.
struct Verdict {
  MotionEnd end = MotionEnd::undecided;
  std::size_t which = 0;  ///< index into the cycles
  double watched = 0.0;
  std::string reason;
  double swing_ratio = std::numeric_limits<double>::quiet_NaN();
  bool is_creeping = false;  ///< to rest
  Vector last;               ///< numbers
  IrregularFound irregular;  ///< if `end` is irregular

  bool is_attracted() const { return end == MotionEnd::rest || end == MotionEnd::cycle; }
  bool is_same_end(const Verdict& other) const {
    return end == other.end && (end != MotionEnd::cycle || which == other.which);
  }
};

/// A stretch that was steady.
struct Steady {
  IrregularFound found;
  std::vector<Extent> ranges;  ///< of each number
};

/// What a sampled drive's start led to.
struct Known {
  Steady motion;
  MotionEnd end;      ///< irregular or cycle
  std::size_t which;  ///< index into the cycles
};

ShaftStates between(const ShaftStates& a, const ShaftStates& b, double share) {
  const auto mix = [&](double one, double other) { return one + share * (other - one); };
  return {mix(a.motor_position, b.motor_position), mix(a.motor_speed, b.motor_speed),
          mix(a.load_position, b.load_position), mix(a.load_speed, b.load_speed)};
}

class Search {
 public:
  Search(const ReducedDrive& drive, const AttractorOptions& options, Progress& progress)
      : options_(options),
        progress_(progress),
        unscaled_(search_setting(drive, options.chosen_starts)) {
    starts_ =
        options.starts.empty() ? usual_starts(unscaled_, options.chosen_starts) : options.starts;
    setting_ = scaled(unscaled_, glance());
    result_.coordinates = setting_.coordinates;
    result_.system = unscaled_.system.system();
    result_.swing_time = setting_.swing_time;
    result_.settling_time = setting_.settling_time;
    const double swings = options.swing_times * setting_.swing_time;
    result_.watch_time = swings + std::min(swings, budget_.settling_times * setting_.settling_time);
    most_events_ = options.most_events;
    if (setting_.drive.sampling) most_events_ += budget_.most_ticks * options.most_events;
  }

  AttractorSearch run() {
    for (const ShaftStates& start : starts_) {
      if (!goes_on()) break;
      verdicts_.push_back(watch(setting_.start(start), budget_.patience));
      record(start, verdicts_.back());
      ++done_;
    }
    if (result_.is_complete && !setting_.drive.sampling) seek_edges();
    if (result_.is_complete && options_.starts.empty()) {
      result_.thresholds = thresholds_of(
          setting_, result_.outcomes, budget_.bisections_of_steps, [&](const ShaftStates& start) {
            return goes_on() ? watch(setting_.start(start), budget_.patience_at_edges).end
                             : MotionEnd::undecided;
          });
    }
    if (result_.is_complete) progress_.go_on(1.0);
    finish();
    return std::move(result_);
  }

 private:
  bool goes_on() {
    if (!result_.is_complete) return false;
    const auto all = static_cast<double>(starts_.size() + options_.most_edges);
    if (!progress_.go_on(static_cast<double>(done_) / all)) {
      result_.is_complete = false;
    }
    return result_.is_complete;
  }

  /// A short first motion, which shows the magnitude of the numbers.
  Trajectory glance() const {
    const ShaftStates& start = starts_[starts_.size() / 2];
    return simulate(unscaled_.system, unscaled_.start(start),
                    {.until = budget_.glance_swings * unscaled_.swing_time,
                     .event_limit = budget_.glance_events,
                     .step_limit = steps_kept()});
  }

  // ---- one start --------------------------------------------------------------------------------

  Verdict watch(const State& start, double patience) {
    Watch watch{.here = start, .starts_at_rest = setting_.load.speed.at(start.numbers) == 0.0};
    double length = first_stretch();
    std::size_t most_in_stretch = budget_.ticks_of_stretch;
    std::optional<Steady> before;
    while (true) {
      const double until = setting_.between_ticks(watch.time + length);
      const Stretch stretch = next_stretch(watch, until, most_in_stretch);
      Verdict verdict;
      verdict.watched = watch.time;
      verdict.last = watch.here.numbers;
      if (is_decided(watch, stretch, verdict)) return verdict;
      if (!stretch.motion && is_steady(watch, stretch, before, verdict)) return verdict;
      if (!goes_on()) {
        verdict.reason = "the search was stopped";
        return verdict;
      }
      const double most = longest(watch, stretch, patience);
      if (watch.time >= most && creeps(watch, verdict)) return verdict;
      const bool may_creep = stands(watch.here, setting_, tolerances_.rest);
      const double times = may_creep ? budget_.patience_at_standstill : 1.0;
      if (watch.events >= most_events_ || watch.time >= times * most) {
        give_up(watch, stretch, before, verdict);
        return verdict;
      }
      // Events may have ended the stretch.
      length = 2.0 * (stretch.to - stretch.from);
      most_in_stretch = std::max(budget_.ticks_of_stretch, 2 * stretch.events);
    }
  }

  /// A step keeps its time, its mode and all numbers.
  std::size_t steps_kept() const {
    const auto numbers = static_cast<std::size_t>(unscaled_.system.system().size());
    return budget_.bytes_kept / (sizeof(double) * (numbers + 3));
  }

  /// Shorter if the motion may join a cycle that is known.
  double first_stretch() const {
    const bool may_join = !setting_.drive.sampling && !result_.cycles.empty();
    const double share = may_join ? budget_.share_to_join : 1.0;
    return share * budget_.first_stretch * setting_.swing_time;
  }

  /// The ticks of a sampled drive are too many to be kept.
  Stretch next_stretch(Watch& watch, double until, std::size_t most_if_sampled) const {
    const std::size_t most = std::max<std::size_t>(1, most_events_ - watch.events);
    if (setting_.drive.sampling) {
      const bool is_last = most < 2 * most_if_sampled;  // no short stretch remains
      return observe(watch, until, is_last ? most : most_if_sampled, setting_);
    }
    return follow(watch, until, std::min(most, budget_.events_of_stretch), steps_kept(), setting_,
                  budget_.short_stretch * setting_.swing_time);
  }

  /// Longest time that a start is watched: more if hardly anything happens.
  double longest(const Watch& watch, const Stretch& stretch, double patience) const {
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
    const bool is_slow =
        setting_.drive.sampling ||
        std::max(recent(turns), recent(extremes(watch.motor))) < budget_.hardly_any_swings ||
        is_small(turns, setting_, tolerances_.rest) || changes;
    constexpr double rounding = 1e-9;  // allows for rounding of the summed stretches
    const double more = is_slow ? patience : 1.0;
    const double times = setting_.drive.sampling ? more * budget_.patience_at_ticks : more;
    return times * result_.watch_time * (1.0 - rounding);
  }

  bool is_decided(const Watch& watch, const Stretch& stretch, Verdict& verdict) {
    if (stretch.stop_reason == StopReason::diverged || has_run_away(watch, setting_, tolerances_)) {
      verdict.end = MotionEnd::diverges;
      return true;
    }
    if (stretch.stop_reason == StopReason::zeno || stretch.stop_reason == StopReason::chattering) {
      verdict.reason = "events without end: " + stretch.culprit;
      return true;
    }
    if (setting_.coordinates == Coordinates::in_place) return false;
    if (is_at_rest(watch, stretch, setting_, tolerances_.rest) ||
        is_vanishing(watch, stretch, verdict)) {
      verdict.end = MotionEnd::rest;
      return true;
    }
    return stretch.motion &&
           is_on_cycle(*stretch.motion,
                       {tolerances_.cycle.nearness, tolerances_.cycle.wide_nearness}, verdict);
  }

  bool creeps(const Watch& watch, Verdict& verdict) const {
    verdict.is_creeping = is_creeping(watch, setting_, tolerances_.rest);
    if (verdict.is_creeping) verdict.end = MotionEnd::rest;
    return verdict.is_creeping;
  }

  /// Whether a sampled drive's motion is one that is known, or has repeated its statistics from one
  /// stretch to the next, which is twice as long. Motion that repeats may be a cycle.
  bool is_steady(const Watch& watch, const Stretch& stretch, std::optional<Steady>& before,
                 Verdict& verdict) {
    const IrregularTolerances& irregular = tolerances_.irregular;
    const Irregularity seen = irregularity_of(watch, stretch, setting_, tolerances_, false);
    if (!seen.reason.empty()) {
      if (watch.events < most_events_) before.reset();  // not of a stretch that was cut short
      return false;
    }
    const Steady now{seen.found, stretch.last};
    for (const Known& known : known_) {
      if (!is_sure(now.found, irregular, irregular.repeating)) break;
      if (!is_same(known.motion, now)) continue;
      verdict.end = known.end;
      verdict.which = known.which;
      verdict.irregular = now.found;
      return true;
    }
    const bool is_repeated = before && is_same(*before, now);
    before = now;
    if (!is_repeated || !is_sure(now.found, irregular, irregular.repeating_exactly)) return false;
    if (!closes(watch, now.found, verdict)) take(watch, now.found, verdict);
    known_.push_back({now, verdict.end, verdict.which});
    return true;
  }

  bool is_same(const Steady& one, const Steady& other) const {
    const IrregularTolerances& tolerances = tolerances_.irregular;
    return is_alike(one.found, other.found, setting_, tolerances) &&
           are_alike(one.ranges, other.ranges, setting_.own, tolerances.same_ranges);
  }

  /// Whether Newton's method closes a cycle on a sampled drive's motion.
  bool closes(const Watch& watch, const IrregularFound& found, Verdict& verdict) {
    if (setting_.coordinates == Coordinates::in_place) return false;
    if (!(found.mismatch < tolerances_.irregular.repeating)) return false;
    return is_on_cycle(recorded(watch, found, budget_.closing_periods),
                       {tolerances_.cycle.nearness, tolerances_.cycle.wide_nearness}, verdict);
  }

  /// A sampled drive's motion from here on, over a few periods, kept.
  Trajectory recorded(const Watch& watch, const IrregularFound& found, double periods) const {
    const double period = std::isfinite(found.period) ? found.period : setting_.swing_time;
    return simulate(setting_.system, watch.here,
                    {.from = watch.time,
                     .until = setting_.between_ticks(watch.time + periods * period),
                     .event_limit = budget_.recorded_events});
  }

  /// Whether swings shrink towards a rest that they never reach. Decided only after the linear
  /// loop's settling time.
  bool is_vanishing(const Watch& watch, const Stretch& stretch, Verdict& verdict) const {
    const bool is_small_by_now = extent_of(after(watch.load, stretch.from)).width() <
                                 tolerances_.rest.small_motion * setting_.small_length;
    const double awaited =
        std::min(result_.watch_time, budget_.settling_times * setting_.settling_time);
    if (!is_small_by_now || !(watch.time > awaited)) return false;
    const auto ratio =
        ratio_of_vanishing(turns_of(watch, setting_, tolerances_.rest), setting_, tolerances_.rest);
    if (ratio) verdict.swing_ratio = *ratio;
    return ratio.has_value();
  }

  bool is_on_cycle(const Trajectory& motion, std::initializer_list<double> nearness,
                   Verdict& verdict) {
    const auto which = cycle_of(motion, nearness);
    if (!which) return false;
    verdict.end = MotionEnd::cycle;
    verdict.which = *which;
    return true;
  }

  /// The cycle that the end of a motion is on. Unstable cycles passed by are kept in the result.
  std::optional<std::size_t> cycle_of(const Trajectory& motion,
                                      std::initializer_list<double> all_nearness) {
    if (const auto which = closing_.known_cycle_of(motion, result_.cycles)) return which;
    for (const double nearness : all_nearness) {
      const auto found = closing_.closed_cycle(motion, nearness);
      if (!found) continue;
      const std::size_t which = place_of(*found, tolerances_.cycle, result_.cycles);
      if (found->stability != Stability::unstable) return which;
    }
    return std::nullopt;
  }

  /// The motion is what its last stretch shows, or that `before` which was steady.
  void give_up(const Watch& watch, const Stretch& stretch, const std::optional<Steady>& before,
               Verdict& verdict) {
    // The motion may approach its cycle slowly.
    const bool may_close = stretch.motion && setting_.coordinates != Coordinates::in_place;
    if (may_close && is_on_cycle(*stretch.motion, {tolerances_.cycle.widest_nearness}, verdict))
      return;
    const bool is_out_of_events = watch.events >= most_events_;
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
    const Steady last = seen.reason.empty() ? Steady{seen.found, stretch.last} : *before;
    take(watch, last.found, verdict, &stretch);
    if (!stretch.motion) known_.push_back({last, verdict.end, 0});
  }

  /// Takes the motion as irregular.
  void take(const Watch& watch, const IrregularFound& found, Verdict& verdict,
            const Stretch* stretch = nullptr) {
    verdict.end = MotionEnd::irregular;
    verdict.irregular = found;
    const bool is_known =
        place_among(result_.irregular, found, tolerances_.irregular) != result_.irregular.size();
    const Sensing& sensing = setting_.drive.sensing;
    if (is_known || sensing.resolution > 0.0 || sensing.resolution_of_speed > 0.0) return;
    const bool is_kept = stretch != nullptr && stretch->motion;
    verdict.irregular.exponent = largest_exponent(
        setting_.system.system(),
        is_kept ? *stretch->motion : recorded(watch, found, budget_.compared_periods),
        setting_.own);
  }

  // ---- the record -------------------------------------------------------------------------------

  void record(const ShaftStates& start, const Verdict& verdict) {
    Outcome outcome{start, verdict.end, verdict.which, verdict.watched, verdict.reason};
    if (verdict.end == MotionEnd::rest) record_rest(verdict);
    if (verdict.end == MotionEnd::cycle) ++result_.cycles[verdict.which].starts;
    if (verdict.end == MotionEnd::irregular) {
      outcome.which = place_among(result_.irregular, verdict.irregular, tolerances_.irregular);
      if (outcome.which == result_.irregular.size()) result_.irregular.push_back(verdict.irregular);
      ++result_.irregular[outcome.which].starts;
    }
    result_.outcomes.push_back(std::move(outcome));
  }

  void record_rest(const Verdict& verdict) {
    if (!result_.rest) result_.rest = RestFound{};
    RestFound& rest = *result_.rest;
    add_rest(rest, verdict.last, setting_, tolerances_.rest);
    ++rest.starts;
    if (verdict.is_creeping) ++rest.creeping_starts;
    rest.swing_ratio = std::fmax(rest.swing_ratio, verdict.swing_ratio);  // fmax ignores NaN
  }

  /// Sorts the cycles: stable ones first, by falling amplitude. Removes the scale from their
  /// orbits.
  void finish() {
    std::vector<std::size_t> order(result_.cycles.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const FoundCycle& one = result_.cycles[a];
      const FoundCycle& other = result_.cycles[b];
      if (one.stability != other.stability) return one.stability < other.stability;
      return one.amplitude > other.amplitude;
    });
    std::vector<FoundCycle> sorted;
    std::vector<std::size_t> place(order.size());
    for (const std::size_t i : order) {
      place[i] = sorted.size();
      sorted.push_back(result_.cycles[i]);
      sorted.back().orbit = unscaled(sorted.back().orbit, setting_.frame.scale);
    }
    result_.cycles = std::move(sorted);
    for (Outcome& outcome : result_.outcomes) {
      if (outcome.end == MotionEnd::cycle) outcome.which = place[outcome.which];
    }
    for (Edge& edge : result_.edges) {
      if (edge.cycle) edge.cycle = place[*edge.cycle];
    }
    take_for_cycles(result_, tolerances_.cycle);
  }

  // ---- edges ------------------------------------------------------------------------------------

  static std::pair<int, std::size_t> name_of(const Verdict& verdict) {
    return {verdict.end == MotionEnd::rest ? 0 : 1, verdict.which};
  }

  /// Between neighbouring starts with different attractors, once for each pair of attractors.
  void seek_edges() {
    std::set<std::pair<std::pair<int, std::size_t>, std::pair<int, std::size_t>>> sought;
    for (std::size_t i = 0; i + 1 < verdicts_.size(); ++i) {
      const Verdict& one = verdicts_[i];
      const Verdict& other = verdicts_[i + 1];
      if (sought.size() >= options_.most_edges) return;
      if (!one.is_attracted() || !other.is_attracted() || one.is_same_end(other)) continue;
      const auto both = std::minmax({name_of(one), name_of(other)});
      if (!sought.insert({both.first, both.second}).second) continue;
      if (!goes_on()) return;
      result_.edges.push_back({i, i + 1, cycle_between(i, one)});
      ++done_;
    }
  }

  /// Bisects until the two starts are adjacent doubles. At intervals it tests whether the motion
  /// hovers long enough for Newton's method to close a cycle.
  std::optional<std::size_t> cycle_between(std::size_t first, const Verdict& end_of_first) {
    const ShaftStates& a = starts_[first];
    const ShaftStates& b = starts_[first + 1];
    double low = 0.0;
    double high = 1.0;
    for (int step = 1; step <= budget_.bisections; ++step) {
      const double middle = 0.5 * (low + high);
      if (!(low < middle && middle < high)) break;
      if (step % budget_.bisections_between_tries == 0) {
        if (const auto found = hovered_at(setting_.start(between(a, b, middle)))) return found;
      }
      if (!goes_on()) return std::nullopt;
      const bool is_as_first =
          watch(setting_.start(between(a, b, middle)), budget_.patience_at_edges)
              .is_same_end(end_of_first);
      (is_as_first ? low : high) = middle;
    }
    return std::nullopt;
  }

  /// The unstable cycle near which a motion hovers. Empty if none closes.
  std::optional<std::size_t> hovered_at(const State& start) {
    for (double swings = 1.0; swings <= budget_.most_hovering_swings; swings += 1.0) {
      const Trajectory motion =
          simulate(setting_.system, start,
                   {.until = setting_.between_ticks(swings * setting_.swing_time),
                    .event_limit = options_.most_events});
      if (motion.stop_reason() != StopReason::reached_end) return std::nullopt;
      const auto found = closing_.closed_cycle(motion, tolerances_.cycle.widest_nearness);
      if (found && found->stability == Stability::unstable) {
        return place_of(*found, tolerances_.cycle, result_.cycles);
      }
    }
    return std::nullopt;
  }

  const AttractorOptions& options_;
  Progress& progress_;
  const SearchTolerances& tolerances_ = options_.tolerances;
  const SearchBudget& budget_ = options_.budget;
  std::size_t most_events_ = 0;  ///< per start, including permitted ticks
  SearchSetting unscaled_;
  SearchSetting setting_;
  CycleClosing closing_{setting_, options_};
  std::vector<ShaftStates> starts_;
  std::vector<Verdict> verdicts_;
  std::vector<Known> known_;
  std::size_t done_ = 0;
  AttractorSearch result_;
};

}  // namespace

std::size_t AttractorSearch::count(MotionEnd end) const {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(),
                    [&](const Outcome& outcome) { return outcome.end == end; }));
}

AttractorSearch find_attractors(const ReducedDrive& drive, const AttractorOptions& options,
                                Progress& progress) {
  return Search(drive, options, progress).run();
}

}  // namespace gearlash::drive
