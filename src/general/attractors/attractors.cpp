#include "general/attractors/attractors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/lists.hpp"
#include "general/attractors/cycle_closing.hpp"
#include "general/attractors/cycle_energy.hpp"
#include "general/attractors/found_cycle.hpp"
#include "general/attractors/irregular_motion.hpp"
#include "general/attractors/search_setting.hpp"
#include "general/attractors/start_classifier.hpp"
#include "general/attractors/thresholds.hpp"

namespace gearlash::drive {
namespace {

using hybrid::State;
using hybrid::StopReason;
using hybrid::Trajectory;

// ---- the search ---------------------------------------------------------------------------------

ShaftStates between(const ShaftStates& a, const ShaftStates& b, double share) {
  const auto mix = [&](double one, double other) { return one + share * (other - one); };
  return {mix(a.motor_position, b.motor_position), mix(a.motor_speed, b.motor_speed),
          mix(a.load_position, b.load_position), mix(a.load_speed, b.load_speed)};
}

/// The start of another drive, whose gap may have been wider.
ShaftStates within_gap(ShaftStates start, const ReducedDrive& drive) {
  const double half = 0.5 * drive.backlash;
  start.motor_position =
      start.load_position + std::clamp(start.motor_position - start.load_position, -half, half);
  return start;
}

class Search {
 public:
  Search(const ReducedDrive& drive, const AttractorOptions& options, Progress& progress)
      : options_(options),
        progress_(progress),
        unscaled_(search_setting(drive, options.chosen_starts)) {
    starts_ =
        options.starts.empty() ? usual_starts(unscaled_, options.chosen_starts) : options.starts;
    const std::optional<Trajectory> motion = glance();
    setting_ = motion ? scaled(unscaled_, *motion) : unscaled_;
    result_.coordinates = setting_.coordinates;
    result_.system = unscaled_.system.system();
    result_.band = options.band;
    result_.swing_time = setting_.swing_time;
    result_.settling_time = setting_.settling_time;
    const double swings = options.swing_times * setting_.swing_time;
    result_.watch_time = swings + std::min(swings, budget_.settling_times * setting_.settling_time);
  }

  AttractorSearch follow(const AttractorSearch& known) {
    close_near(known);
    for (const ShaftStates& start : starts_) result_.outcomes.emplace_back().start = start;
    finish();
    return std::move(result_);
  }

  AttractorSearch run() {
    if (options_.nearby != nullptr) close_near(*options_.nearby);
    for (const ShaftStates& start : starts_) {
      if (!goes_on()) break;
      verdicts_.push_back(end_of(start));
      record(start, verdicts_.back());
      ++done_;
      if (options_.is_enough && options_.is_enough(result_)) break;
    }
    if (result_.is_complete && !setting_.drive.sampling) {
      watch_transients();
      seek_edges();
    }
    if (result_.is_complete && options_.starts.empty() && options_.most_edges > 0) {
      result_.thresholds = thresholds_of(
          setting_, result_.outcomes, budget_.bisections_of_steps, [&](const ShaftStates& start) {
            return goes_on()
                       ? classifier_.end_of(setting_.start(start), budget_.patience_at_edges).end
                       : MotionEnd::undecided;
          });
    }
    if (result_.is_complete) progress_.go_on(1.0);
    measure_torques();
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

  double patience() const {
    if (!options_.may_hurry || !options_.may_hurry(result_)) return budget_.patience;
    return setting_.drive.sampling ? budget_.hurried_if_sampled / budget_.patience_if_sampled : 1.0;
  }

  Verdict end_of(const ShaftStates& start, double longer = 1.0) {
    Verdict verdict = classifier_.end_of(setting_.start(start), patience(), longer);
    if (verdict.end == MotionEnd::rest) {
      verdict.time_to_rest = classifier_.time_to_rest(verdict, result_.band);
    }
    return verdict;
  }

  /// A short first motion, which shows the magnitude of the numbers: that of the middle start, or
  /// of the next one that moves. Where nothing moves, a number may be nothing but rounding.
  std::optional<Trajectory> glance() {
    const std::size_t count = starts_.size();
    for (std::size_t i = 0; i < count && goes_on(); ++i) {
      Trajectory motion = glance_from(starts_[(count / 2 + i) % count]);
      if (moves(motion)) return motion;
    }
    return std::nullopt;
  }

  Trajectory glance_from(const ShaftStates& start) const {
    return simulate(unscaled_.system, unscaled_.start(start),
                    {.until = budget_.glance_swings * unscaled_.swing_time,
                     .event_limit = budget_.glance_events,
                     .step_limit = steps_kept(unscaled_, budget_),
                     .progress = &progress_});
  }

  bool moves(const Trajectory& motion) const {
    const double no_move = tolerances_.rest.no_move * unscaled_.small_length;
    const auto goes = [&](const Watched& shaft) {
      return extent_of(rough_samples(motion, shaft)).width() > no_move;
    };
    return goes(unscaled_.load) || goes(unscaled_.motor);
  }

  void close_near(const AttractorSearch& known) {
    const hybrid::Vector& scale = setting_.frame.scale;
    const hybrid::HybridSystem& own = setting_.system.system();
    const bool has_same_states =
        known.system.size() == own.size() && known.system.mode_count() == own.mode_count();
    if (!has_same_states) return;
    const hybrid::Vector none = hybrid::Vector::Zero(scale.size());
    std::optional<hybrid::PreparedSystem> system_of_known;
    for (const FoundCycle& cycle : known.cycles) {
      const hybrid::PeriodicOrbit near = unscaled(cycle.orbit, scale.cwiseInverse());
      auto orbit = neighbouring_orbit(setting_.system, near, options_.shooting);
      if (!orbit) {
        if (!system_of_known) {
          system_of_known = hybrid::PreparedSystem(seen_in(known.system, {scale, none, none}));
        }
        orbit = neighbouring_orbit(setting_.system, near, *system_of_known, options_.shooting);
      }
      if (!orbit || !(orbit->residual < tolerances_.cycle.residual)) continue;
      const FoundCycle found = measured(setting_, *orbit, tolerances_);
      if (returns(found, tolerances_.cycle)) result_.cycles.push_back(found);
    }
  }

  // ---- the record -------------------------------------------------------------------------------

  void record(const ShaftStates& start, const Verdict& verdict) {
    Outcome outcome{.start = start,
                    .end = verdict.end,
                    .which = verdict.which,
                    .watched = verdict.watched,
                    .reason = verdict.reason,
                    .rest = {},
                    .time_to_rest = verdict.time_to_rest};
    if (verdict.end == MotionEnd::rest) {
      record_rest(verdict);
      outcome.rest = rest_place(verdict);
    }
    if (verdict.end == MotionEnd::cycle) ++result_.cycles[verdict.which].starts;
    if (verdict.end == MotionEnd::irregular) {
      outcome.which = place_among(result_.irregular, verdict.irregular, tolerances_.irregular);
      if (outcome.which == result_.irregular.size()) result_.irregular.push_back(verdict.irregular);
      ++result_.irregular[outcome.which].starts;
    }
    result_.outcomes.push_back(std::move(outcome));
  }

  static RestPlace rest_place(const Verdict& verdict) {
    if (const auto& approach = verdict.approach) {
      return {.load = approach->final, .uncertainty = approach->size};
    }
    const Standstill& last = verdict.rest.back();
    return {.load = last.load, .motor = last.motor, .uncertainty = verdict.uncertainty};
  }

  void record_rest(const Verdict& verdict) {
    if (!result_.rest) result_.rest = RestFound{};
    RestFound& rest = *result_.rest;
    for (const Standstill& place : verdict.rest) {
      add_rest(rest, place.load, place.motor, setting_, tolerances_.rest);
    }
    ++rest.starts;
    if (verdict.is_creeping) ++rest.creeping_starts;
    rest.swing_ratio = std::fmax(rest.swing_ratio, verdict.swing_ratio);  // fmax ignores NaN
  }

  /// Irregular motion may be a long way to a cycle that lies where it moves (transient chaos). One
  /// start that led to it is watched for longer, and the next if that one comes to its end.
  void watch_transients() {
    std::vector<IrregularFound> lasting;
    bool is_any_over = false;
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      Verdict& verdict = verdicts_[i];
      if (verdict.end != MotionEnd::irregular) continue;
      const IrregularFound& motion = verdict.irregular;
      const bool may_end = any_of(result_.cycles, [&](const FoundCycle& cycle) {
        return may_join(motion, cycle, tolerances_.irregular);
      });
      if (!may_end || place_among(lasting, motion, tolerances_.irregular) < lasting.size()) {
        continue;
      }
      if (!goes_on()) break;
      Verdict later = end_of(starts_[i], budget_.longer_if_transient);
      if (later.is_attracted()) {
        verdict = std::move(later);
        is_any_over = true;
      } else {
        lasting.push_back(motion);
      }
    }
    if (is_any_over) record_anew();
  }

  void record_anew() {
    result_.rest.reset();
    result_.irregular.clear();
    result_.outcomes.clear();
    for (FoundCycle& cycle : result_.cycles) cycle.starts = 0;
    for (std::size_t i = 0; i < verdicts_.size(); ++i) record(starts_[i], verdicts_[i]);
  }

  void measure_torques() {
    for (FoundCycle& cycle : result_.cycles) {
      const Trajectory motion = motion_on(setting_.system, cycle.orbit, 1.0);
      cycle.mesh_torque = largest_mesh_torque(setting_, motion);
      cycle.energy = energy_of(setting_, motion);
    }
  }

  /// Sorts motions by falling amplitude; stable cycles come before others, and motions of the
  /// motor alone last. Removes the scale from the orbits.
  void finish() {
    for (FoundCycle& cycle : result_.cycles) {
      cycle.orbit = unscaled(cycle.orbit, setting_.frame.scale);
    }
    const std::vector<std::size_t> place = sort(result_.cycles, MotionEnd::cycle, [](auto& one) {
      return std::pair(one.stability, -one.amplitude);
    });
    for (Edge& edge : result_.edges) {
      if (edge.cycle) edge.cycle = place[*edge.cycle];
    }
    sort(result_.irregular, MotionEnd::irregular, [](auto& one) {
      return std::pair(one.is_motor_alone,
                       one.is_motor_alone ? -one.motor_amplitude : -one.amplitude);
    });
    take_for_cycles(result_, tolerances_.cycle);
  }

  /// Sorts motions in which starts end by a rising key; gives the new place of each.
  template <class Found, class Key>
  std::vector<std::size_t> sort(std::vector<Found>& motions, MotionEnd end, const Key& key) {
    std::vector<std::size_t> order = indices(motions.size());
    sort_by(order, [&](std::size_t i) { return key(motions[i]); });
    std::vector<Found> sorted;
    std::vector<std::size_t> place(order.size());
    for (const std::size_t i : order) {
      place[i] = sorted.size();
      sorted.push_back(std::move(motions[i]));
    }
    motions = std::move(sorted);
    for (Outcome& outcome : result_.outcomes) {
      if (outcome.end == end) outcome.which = place[outcome.which];
    }
    return place;
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
          classifier_.end_of(setting_.start(between(a, b, middle)), budget_.patience_at_edges)
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
  SearchSetting unscaled_;
  SearchSetting setting_;
  CycleClosing closing_{setting_, options_};
  std::vector<ShaftStates> starts_;
  std::vector<Verdict> verdicts_;
  std::size_t done_ = 0;
  AttractorSearch result_;
  StartClassifier classifier_{setting_, options_, result_, [this] { return goes_on(); }};
};

}  // namespace

std::size_t AttractorSearch::count(MotionEnd end) const {
  return count_of(outcomes, [&](const Outcome& outcome) { return outcome.end == end; });
}

AttractorSearch find_attractors(const ReducedDrive& drive, const AttractorOptions& options,
                                Progress& progress) {
  return Search(drive, options, progress).run();
}

AttractorSearch follow_cycles(const ReducedDrive& drive, const AttractorSearch& known) {
  AttractorOptions options{.most_edges = 0};
  for (const Outcome& outcome : known.outcomes) {
    options.starts.push_back(within_gap(outcome.start, drive));
  }
  return Search(drive, options, no_progress()).follow(known);
}

namespace {

/// Of the decided outcomes that are alike the first, which is the first to end otherwise where rest
/// becomes stable, and the middle one, whose start is farthest from those that lead elsewhere. Of
/// rests the first and the last, which stand farthest apart.
std::vector<Outcome> representatives(const std::vector<Outcome>& all) {
  std::map<std::pair<MotionEnd, std::size_t>, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].end != MotionEnd::undecided) places[{all[i].end, all[i].which}].push_back(i);
  }
  std::vector<Outcome> some;
  for (const auto& [end, of_end] : places) {
    const bool is_rest = end.first == MotionEnd::rest;
    some.push_back(all[of_end.front()]);
    if (of_end.size() > 1)
      some.push_back(all[of_end[is_rest ? of_end.size() - 1 : of_end.size() / 2]]);
  }
  return some;
}

/// How motions end, whichever starts lead there, and of irregular motion whether the motor moves
/// alone. What an undecided start does matters beside one that rests, not beside swings alone.
std::set<std::pair<MotionEnd, bool>> ends_of(const std::vector<Outcome>& outcomes,
                                             const std::vector<IrregularFound>& irregular) {
  std::set<std::pair<MotionEnd, bool>> ends;
  for (const Outcome& outcome : outcomes) {
    ends.emplace(outcome.end,
                 outcome.end == MotionEnd::irregular && irregular[outcome.which].is_motor_alone);
  }
  if (!ends.contains({MotionEnd::rest, false})) ends.erase({MotionEnd::undecided, false});
  return ends;
}

bool is_alike(const FoundCycle& a, const FoundCycle& b) {
  return a.stability == b.stability && a.orbit.events.size() == b.orbit.events.size() &&
         a.is_symmetric == b.is_symmetric;
}

/// Whether motions are as those that are known, and starts end alike.
bool is_as(const AttractorSearch& found, const AttractorSearch& known) {
  return std::equal(found.cycles.begin(), found.cycles.end(), known.cycles.begin(),
                    known.cycles.end(), is_alike) &&
         ends_of(found.outcomes, found.irregular) == ends_of(known.outcomes, known.irregular);
}

}  // namespace

std::optional<AttractorSearch> follow_attractors(const ReducedDrive& drive,
                                                 const AttractorSearch& known, Progress& progress,
                                                 const IsEnough& suffices,
                                                 const AttractorOptions& given) {
  const std::vector<Outcome> wanted = representatives(known.outcomes);
  const bool is_open =
      ends_of(known.outcomes, known.irregular).contains({MotionEnd::undecided, false});
  if (!known.is_complete || wanted.empty() || is_open) return std::nullopt;
  AttractorOptions options = given;
  options.starts.clear();
  options.is_enough = {};
  options.nearby = &known;
  options.most_edges = 0;
  for (const Outcome& outcome : wanted) {
    options.starts.push_back(within_gap(outcome.start, drive));
  }
  AttractorSearch found = find_attractors(drive, options, progress);
  if (suffices && found.count(MotionEnd::undecided) == found.outcomes.size()) {
    constexpr std::size_t most = 3;  // undecided starts take long
    options.starts.clear();
    options.is_enough = [&](const AttractorSearch& search) {
      return suffices(search) || search.outcomes.size() == most;
    };
    found = find_attractors(drive, options, progress);
  }
  const bool serves = is_as(found, known) || (suffices && suffices(found));
  return found.is_complete && serves ? std::optional(std::move(found)) : std::nullopt;
}

}  // namespace gearlash::drive
