#include "general/attractors/attractors.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <set>

#include "general/attractors/motion_measures.hpp"
#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {
namespace {

using hybrid::Event;
using hybrid::PeriodicOrbit;
using hybrid::State;
using hybrid::StopReason;
using hybrid::Trajectory;
using hybrid::Vector;

// ---- cycles -------------------------------------------------------------------------------------

double largest_multiplier(const PeriodicOrbit& orbit) {
  return orbit.multipliers.empty() ? 0.0 : std::abs(orbit.multipliers.front());
}

Stability stability_of(double multiplier) {
  constexpr double unknown = 1e-6;
  if (std::abs(multiplier - 1.0) <= unknown) return Stability::neutral;
  return multiplier < 1.0 ? Stability::stable : Stability::unstable;
}

void drop_nearest(std::vector<std::complex<double>>& values, double target) {
  if (values.empty()) return;
  values.erase(std::min_element(values.begin(), values.end(), [&](const auto& a, const auto& b) {
    return std::abs(a - target) < std::abs(b - target);
  }));
}

/// Without the multipliers of disturbances that cannot be: of rigid faces that stay together shafts
/// that are not one, and of an encoder that is beside its own grid.
PeriodicOrbit without_spare_multipliers(const SearchSetting& setting, PeriodicOrbit orbit) {
  const bool is_rigid = std::holds_alternative<RigidContact>(setting.drive.contact);
  bool parts = false;
  bool sticks = false;
  const auto look = [&](std::size_t index) {
    const DriveMode& mode = setting.built.modes[index];
    parts = parts || mode.contact == ContactState::apart;
    sticks =
        sticks || mode.motor == FrictionState::sticking || mode.load == FrictionState::sticking;
  };
  look(orbit.start.mode);
  for (const Event& event : orbit.events) look(event.mode_after);
  if (is_rigid && !parts) {
    drop_nearest(orbit.multipliers, 1.0);                 // the difference of positions is kept
    drop_nearest(orbit.multipliers, sticks ? 0.0 : 1.0);  // that of speeds too, but for a stop
  }
  const std::vector<std::string>& names = setting.system.state_names;
  if (std::find(names.begin(), names.end(), "encoder") != names.end()) {
    drop_nearest(orbit.multipliers, 1.0);
  }
  return orbit;
}

/// Over a period, or a part of it.
Trajectory motion_on(const hybrid::HybridSystem& system, const PeriodicOrbit& orbit,
                     double periods) {
  const double from = orbit.start_time;
  return simulate(system, orbit.start, {.from = from, .until = from + periods * orbit.period});
}

bool agree(double a, double b, double scale, double share) {
  return std::abs(a - b) <= share * scale;
}

/// By how much the state after a share of the period differs from that at the start, times a sign;
/// as a share.
double mismatch_after(const SearchSetting& setting, const PeriodicOrbit& orbit, double share,
                      double sign) {
  const Vector& start = orbit.start.numbers;
  const Vector here = motion_on(setting.system, orbit, share).end().numbers;
  return (here - sign * start).cwiseAbs().maxCoeff() / start.cwiseAbs().maxCoeff();
}

constexpr double recurrent = 1e-7;

bool is_prime(int number) {
  for (int factor = 2; factor * factor <= number; ++factor) {
    if (number % factor == 0) return false;
  }
  return true;
}

/// An orbit that goes round a cycle some times, as going round it once. Multipliers are then known
/// by their moduli.
PeriodicOrbit divided(PeriodicOrbit orbit, int times, double mismatch) {
  orbit.period /= times;
  std::erase_if(orbit.events, [&](const Event& event) { return event.time > orbit.period; });
  for (auto& multiplier : orbit.multipliers) {
    multiplier = std::pow(std::abs(multiplier), 1.0 / times);
  }
  orbit.residual = std::max(orbit.residual, mismatch);
  return orbit;
}

double hardest_impact(const SearchSetting& setting, const PeriodicOrbit& orbit) {
  double hardest = 0.0;
  for (const Event& event : orbit.events) {
    if (event.kind != hybrid::EventKind::transition) continue;
    if (setting.built.modes[event.mode].contact != ContactState::apart) continue;
    const bool meets = setting.built.modes[event.mode_after].contact != ContactState::apart;
    const bool bounces =
        setting.load.speed.at(event.before) != setting.load.speed.at(event.after) &&
        setting.motor.speed.at(event.before) != setting.motor.speed.at(event.after);
    if (!meets && !bounces) continue;
    hardest = std::max(hardest, std::abs(setting.motor.speed.at(event.before) -
                                         setting.load.speed.at(event.before)));
  }
  return hardest;
}

FoundCycle measured(const SearchSetting& setting, const PeriodicOrbit& orbit) {
  const Trajectory motion = motion_on(setting.system, orbit, 1.0);
  const Range load = range_of(samples(setting.system, motion, setting.load, 0.0));
  const Range motor = range_of(samples(setting.system, motion, setting.motor, 0.0));
  FoundCycle cycle;
  cycle.orbit = without_spare_multipliers(setting, orbit);
  cycle.multiplier = largest_multiplier(cycle.orbit);
  cycle.stability = stability_of(cycle.multiplier);
  cycle.size = 0.5 * load.width();
  cycle.motor_size = 0.5 * motor.width();
  cycle.center = load.middle();
  cycle.centers.include(cycle.center);
  cycle.sizes.include(cycle.size);
  cycle.frequency = 2.0 * std::numbers::pi / orbit.period;
  cycle.impact_speed = hardest_impact(setting, orbit);
  cycle.is_symmetric = mismatch_after(setting, orbit, 0.5, -1.0) < recurrent;
  return cycle;
}

/// With events where the load turns, for motion that has no others.
hybrid::HybridSystem with_turns(const SearchSetting& setting) {
  hybrid::HybridSystem system = setting.system;
  for (std::size_t i = 0; i < system.modes.size(); ++i) {
    hybrid::Transition turns;
    turns.name = "load turns";
    turns.guard = setting.load.speed;
    turns.direction = hybrid::Direction::either;
    turns.target = i;
    system.modes[i].transitions.push_back(std::move(turns));
  }
  return system;
}

// ---- the search ---------------------------------------------------------------------------------

/// Where a motion went.
struct Verdict {
  MotionEnd end = MotionEnd::undecided;
  std::size_t which = 0;  ///< of the cycles
  double watched = 0.0;
  std::string reason;
  double swing_ratio = std::numeric_limits<double>::quiet_NaN();
  Vector last;               ///< numbers
  IrregularFound irregular;  ///< where it is

  bool is_attracted() const { return end == MotionEnd::rest || end == MotionEnd::cycle; }
  bool is_same_end(const Verdict& other) const {
    return end == other.end && (end != MotionEnd::cycle || which == other.which);
  }
};

class Search {
 public:
  Search(const Drive& drive, const AttractorOptions& options)
      : options_(options), unscaled_(search_setting(drive)) {
    starts_ = options.starts.empty() ? usual_starts(unscaled_) : options.starts;
    setting_ = scaled(unscaled_, glance());
    result_.coordinates = setting_.coordinates;
    result_.system = unscaled_.system;
    result_.swing_time = setting_.swing_time;
    result_.settling_time = setting_.settling_time;
    const double swings = options.swing_times * setting_.swing_time;
    result_.watch_time = swings + std::min(swings, settlings * setting_.settling_time);
    most_events_ = options.most_events + ticks_awaited();
  }

  AttractorSearch run() {
    for (const ShaftStates& start : starts_) {
      if (!goes_on()) break;
      verdicts_.push_back(watch(setting_.start(start), 20.0));
      record(start, verdicts_.back());
      ++done_;
    }
    if (result_.is_complete) seek_edges();
    if (result_.is_complete && options_.go_on) options_.go_on(1.0);
    finish();
    return std::move(result_);
  }

 private:
  bool goes_on() {
    if (!result_.is_complete) return false;
    const auto all = static_cast<double>(starts_.size() + options_.most_edges);
    if (options_.go_on && !options_.go_on(static_cast<double>(done_) / all)) {
      result_.is_complete = false;
    }
    return result_.is_complete;
  }

  /// Of a sampled drive: those of the time that a start is watched do not count as events, up to a
  /// multiple of what does.
  std::size_t ticks_awaited() const {
    if (!setting_.drive.sampling) return 0;
    constexpr double most = 10.0;
    const double ticks = 2.0 * result_.watch_time / setting_.drive.sampling->period;
    return static_cast<std::size_t>(
        std::min(ticks, most * static_cast<double>(options_.most_events)));
  }

  /// A first motion, to learn how large numbers become.
  Trajectory glance() const {
    const ShaftStates& start = starts_[starts_.size() / 2];
    constexpr double short_while = 5.0;  // swings
    return simulate(unscaled_.system, unscaled_.start(start),
                    {.until = short_while * unscaled_.swing_time, .event_limit = 5000});
  }

  // ---- one start --------------------------------------------------------------------------------

  /// What is known of a motion while it is watched.
  struct Watch {
    State here;
    double time = 0.0;
    std::size_t events = 0;
    std::vector<Range> all;  ///< of each number
    std::vector<Sample> load;
    std::vector<Sample> motor;
    bool starts_at_rest = false;
  };

  Verdict watch(const State& start, double patience) {
    Watch watch{start, 0.0, 0, {}, {}, {}, setting_.load.speed.at(start.numbers) == 0.0};
    double length = 10.0 * setting_.swing_time;
    while (true) {
      const double until = setting_.between_ticks(watch.time + length);
      const Trajectory motion =
          simulate(setting_.system, watch.here,
                   {.from = watch.time,
                    .until = until,
                    .event_limit = std::max<std::size_t>(1, most_events_ - watch.events)});
      watch.time = motion.end_time();
      watch.events += motion.events().size();
      watch.here = motion.end();
      Verdict verdict;
      verdict.watched = watch.time;
      verdict.last = watch.here.numbers;
      if (is_decided(watch, motion, verdict)) return verdict;
      if (watch.events >= most_events_ || watch.time >= longest(watch, motion, patience)) {
        give_up(watch, motion, verdict);
        return verdict;
      }
      length *= 2.0;
    }
  }

  /// Motion in which hardly anything happens is waited for.
  double longest(const Watch& watch, const Trajectory& motion, double patience) const {
    constexpr std::size_t hardly_any = 12;
    const auto recent = [&](const std::vector<Sample>& turns) {
      return count_of_swings(turns, motion.start_time());
    };
    const std::vector<Sample> turns = turns_of(watch);
    // Swings that still shrink may end in rest.
    const std::size_t count = recent(turns);
    constexpr double shrunk = 0.8;
    const bool shrinks = count > 2 && swing(turns, 0) < shrunk * swing(turns, count - 2);
    const bool is_slow = std::max(recent(turns), recent(extremes(watch.motor))) < hardly_any ||
                         is_small(turns) || shrinks;
    return (is_slow ? patience : 1.0) * result_.watch_time * (1.0 - 1e-9);
  }

  bool is_decided(Watch& watch, const Trajectory& motion, Verdict& verdict) {
    const std::vector<Range> here = ranges(motion, motion.start_time());
    if (watch.all.empty()) watch.all = here;
    for (std::size_t i = 0; i < here.size(); ++i) {
      watch.all[i].include(here[i].lowest);
      watch.all[i].include(here[i].highest);
    }
    if (motion.stop_reason() == StopReason::diverged || has_run_away(motion)) {
      verdict.end = MotionEnd::diverges;
      return true;
    }
    if (motion.stop_reason() == StopReason::zeno ||
        motion.stop_reason() == StopReason::chattering) {
      verdict.reason = "events without end: " + motion.culprit();
      return true;
    }
    const auto add = [&](std::vector<Sample>& all, const Watched& watched) {
      const auto seen = samples(setting_.system, motion, watched, 0.05 * setting_.swing_time);
      all.insert(all.end(), seen.begin(), seen.end());
    };
    add(watch.load, setting_.load);
    add(watch.motor, setting_.motor);
    if (setting_.coordinates == Coordinates::in_place) return false;
    if (is_at_rest(watch, motion)) {
      verdict.end = MotionEnd::rest;
      return true;
    }
    // What settles as the linear loop does is awaited.
    constexpr double small = 0.1;
    const bool is_small_by_now =
        lately(motion, setting_.load, motion.end_time() - motion.start_time()).width() <
        small * setting_.small_length;
    const double awaited = std::min(result_.watch_time, settlings * setting_.settling_time);
    if (is_small_by_now && watch.time > awaited) {
      if (const auto ratio = ratio_of_vanishing(turns_of(watch))) {
        verdict.end = MotionEnd::rest;
        verdict.swing_ratio = *ratio;
        return true;
      }
    }
    return is_on_cycle(motion, {1e-6, 1e-3}, verdict);
  }

  bool is_on_cycle(const Trajectory& motion, std::initializer_list<double> nearness,
                   Verdict& verdict) {
    const auto which = cycle_of(motion, nearness);
    if (!which) return false;
    verdict.end = MotionEnd::cycle;
    verdict.which = *which;
    return true;
  }

  bool has_run_away(const Trajectory& motion) const {
    if (setting_.coordinates == Coordinates::in_place) return false;
    constexpr double far = 1e6;
    return std::abs(setting_.load.value.at(motion.end().numbers)) > far * setting_.large_length;
  }

  /// Whether no number has moved in the last half by more than a share of all that it has.
  bool is_at_rest(const Watch& watch, const Trajectory& motion) const {
    constexpr double little = 1e-9;
    const std::vector<Range> last = ranges(motion, 0.5 * (motion.start_time() + motion.end_time()));
    const double positions =
        std::max({watch.all[motor_position].width(), watch.all[load_position].width(),
                  setting_.drive.backlash / setting_.frame.scale[load_position]});
    const double speeds = std::max({watch.all[motor_speed].width(), watch.all[load_speed].width(),
                                    positions * setting_.frame.scale[load_position] /
                                        (setting_.frame.scale[load_speed] * setting_.swing_time)});
    for (std::size_t i = 0; i < static_cast<std::size_t>(setting_.own); ++i) {
      const bool is_position = i == motor_position || i == load_position;
      const bool is_speed = i == motor_speed || i == load_speed;
      const double scale = is_position ? positions : is_speed ? speeds : watch.all[i].width();
      if (last[i].width() > little * scale) return false;
    }
    return true;
  }

  /// After a time, but for those that are next to nothing.
  std::size_t count_of_swings(const std::vector<Sample>& turns, double from) const {
    constexpr double negligible = 1e-6;
    std::size_t count = 0;
    for (std::size_t i = 1; i < turns.size(); ++i) {
      const double size = std::abs(turns[i].value - turns[i - 1].value);
      if (turns[i].time > from && size > negligible * setting_.small_length) ++count;
    }
    return count;
  }

  double swing(const std::vector<Sample>& turns, std::size_t from_last) const {
    const std::size_t last = turns.size() - 1 - from_last;
    return std::abs(turns[last].value - turns[last - 1].value);
  }

  /// Whether swings are much smaller than the gap, and shrink.
  bool is_small(const std::vector<Sample>& turns) const {
    constexpr double share = 0.05;
    return turns.size() > 2 && swing(turns, 0) < share * setting_.small_length &&
           swing(turns, 0) < swing(turns, 1);
  }

  /// Where the load turned, with the start from rest, and the end where it stands.
  std::vector<Sample> turns_of(const Watch& watch) const {
    std::vector<Sample> turns = extremes(watch.load);
    if (watch.starts_at_rest) turns.insert(turns.begin(), watch.load.front());
    constexpr double standing = 1e-6;
    const double speed = std::abs(setting_.load.speed.at(watch.here.numbers));
    const double swing_so_far =
        turns.empty() ? 0.0 : std::abs(watch.load.back().value - turns.back().value);
    if (speed * setting_.swing_time < standing * swing_so_far) turns.push_back(watch.load.back());
    return turns;
  }

  /// Small swings whose limit, by Aitken's extrapolation of any three, is 0: many, or some that
  /// shrink fast.
  std::optional<double> ratio_of_vanishing(const std::vector<Sample>& turns) const {
    constexpr double nothing = 0.03;
    constexpr std::size_t enough = 7;
    constexpr double shrunk = 0.1;
    const bool is_dry =
        setting_.drive.motor.friction.is_dry() || setting_.drive.load.friction.is_dry();
    if (is_dry || !is_small(turns)) return std::nullopt;  // what is dry comes to rest
    for (std::size_t count = 2; count < turns.size(); ++count) {
      const double first = swing(turns, count - 1);
      const double second = swing(turns, count - 2);
      if (!(second < first)) return std::nullopt;
      if (count > 2) {
        const double third = swing(turns, count - 3);
        const double change = third - second;
        const double limit = third - change * change / (change - (second - first));
        if (!(change < 0.0) || !(std::abs(limit) < nothing * third)) return std::nullopt;
      }
      if (count >= enough || swing(turns, 0) < shrunk * first) {
        return swing(turns, 0) / swing(turns, 1);
      }
    }
    return std::nullopt;
  }

  // ---- closing cycles ---------------------------------------------------------------------------

  std::optional<PeriodicOrbit> closed(const Trajectory& motion, double nearness) const {
    hybrid::ShootingOptions shooting = options_.shooting;
    shooting.nearness = nearness;
    if (!motion.events().empty()) return closing_orbit(setting_.system, motion, shooting);
    const hybrid::HybridSystem turning = with_turns(setting_);
    const Trajectory again = simulate(turning, motion.at(motion.start_time()),
                                      {.from = motion.start_time(),
                                       .until = motion.end_time(),
                                       .event_limit = options_.most_events});
    return closing_orbit(turning, again, shooting);
  }

  /// Whether an orbit could go round a cycle so many times: with events in each round, and whole
  /// periods of the clock. What stands still is repeated after any time, however short.
  bool may_go_round(const PeriodicOrbit& orbit, int times) const {
    if (orbit.events.size() < static_cast<std::size_t>(times)) return false;
    if (!setting_.drive.sampling) return true;
    const double ticks = orbit.period / (times * setting_.drive.sampling->period);
    constexpr double rounding = 1e-6;
    return agree(ticks, std::round(ticks), 1.0, rounding);
  }

  /// The cycle itself, where an orbit goes round it several times.
  PeriodicOrbit shortest(const PeriodicOrbit& orbit) const {
    for (int times = 2; times < 100; ++times) {
      if (!is_prime(times) || !may_go_round(orbit, times)) continue;
      const double mismatch = mismatch_after(setting_, orbit, 1.0 / times, 1.0);
      if (!(mismatch < recurrent)) continue;
      constexpr double near = 1e-6;
      const auto shorter = closed(motion_on(setting_.system, orbit, 2.5), near);
      if (shorter && shorter->period < 0.75 * orbit.period) return shortest(*shorter);
      // Rounding may make and unmake events, of faces that come to rest; then Newton's method,
      // which counts them, closes one round and not another.
      return shortest(divided(orbit, times, mismatch));
    }
    return orbit;
  }

  /// The one that the end of a motion is on: it is not left again, and as large as what was seen.
  std::optional<std::size_t> cycle_of(const Trajectory& motion,
                                      std::initializer_list<double> all_nearness) {
    if (const auto which = known_cycle_of(motion)) return which;
    for (const double nearness : all_nearness) {
      const auto found = closed_cycle(motion, nearness);
      if (!found) continue;
      const std::size_t which = place_of(*found);
      if (found->stability != Stability::unstable) return which;
    }
    return std::nullopt;
  }

  /// A stable one that has the motion's last event, in nearly the same state.
  std::optional<std::size_t> known_cycle_of(const Trajectory& motion) const {
    if (motion.events().empty() || setting_.drive.sampling) return std::nullopt;
    const Event& last = motion.events().back();
    constexpr double near = 1e-4;
    for (std::size_t i = 0; i < result_.cycles.size(); ++i) {
      if (result_.cycles[i].stability != Stability::stable) continue;
      for (const Event& event : result_.cycles[i].orbit.events) {
        if (event.kind == last.kind && event.mode == last.mode &&
            event.transition == last.transition && event.mode_after == last.mode_after &&
            (event.after - last.after).cwiseAbs().maxCoeff() <=
                near * event.after.cwiseAbs().maxCoeff()) {
          return i;
        }
      }
    }
    return std::nullopt;
  }

  std::optional<FoundCycle> closed_cycle(const Trajectory& motion, double nearness) const {
    constexpr double largest_residual = 1e-9;
    const auto orbit = closed(motion, nearness);
    if (!orbit || !(orbit->residual < largest_residual)) return std::nullopt;
    const FoundCycle cycle = measured(setting_, shortest(*orbit));
    constexpr double least = 1e-9;  // of the smallest length: below is rest
    if (!(extent_of(cycle) > least * setting_.small_length)) return std::nullopt;
    const Range load = lately(motion, setting_.load, cycle.period());
    const Range motor = lately(motion, setting_.motor, cycle.period());
    const auto is_as = [&](double seen, double wanted) {
      constexpr double share = 0.02;
      return agree(seen, wanted, extent_of(cycle), share);
    };
    const bool is_on_it = is_as(0.5 * load.width(), cycle.size) &&
                          is_as(0.5 * motor.width(), cycle.motor_size) &&
                          is_as(load.middle(), cycle.center);
    return is_on_it ? std::optional(cycle) : std::nullopt;
  }

  /// The load may stand while the motor hunts within the gap.
  static double extent_of(const FoundCycle& cycle) {
    return std::max(cycle.size, cycle.motor_size);
  }

  /// Over a little more than the last period of a motion.
  Range lately(const Trajectory& motion, const Watched& watched, double period) const {
    Range range;
    for (const Sample& sample :
         samples(setting_.system, motion, watched, 0.05 * setting_.swing_time)) {
      if (sample.time >= motion.end_time() - 1.01 * period) range.include(sample.value);
    }
    return range;
  }

  /// Among those that are known, or as a new one.
  std::size_t place_of(const FoundCycle& cycle) {
    for (std::size_t i = 0; i < result_.cycles.size(); ++i) {
      FoundCycle& known = result_.cycles[i];
      if (!is_one_with(known, cycle)) continue;
      known.centers.include(cycle.center);
      known.sizes.include(cycle.size);
      return i;
    }
    result_.cycles.push_back(cycle);
    return result_.cycles.size() - 1;
  }

  /// Whether two are one cycle, mirror images, or of one family of neutral ones.
  static bool is_one_with(FoundCycle& known, const FoundCycle& cycle) {
    if (known.stability != cycle.stability) return false;
    const double period = cycle.period();
    if (cycle.stability == Stability::neutral) return agree(known.period(), period, period, 1e-6);
    constexpr double same = 1e-8;
    if (!agree(known.period(), period, period, same) ||
        !agree(known.size, cycle.size, extent_of(cycle), same) ||
        !agree(known.motor_size, cycle.motor_size, extent_of(cycle), same)) {
      return false;
    }
    if (agree(known.center, cycle.center, extent_of(cycle), same)) return true;
    const bool is_image = agree(known.center, -cycle.center, extent_of(cycle), same);
    known.has_mirror_image = known.has_mirror_image || is_image;
    return is_image;
  }

  // ---- motion that does not close ---------------------------------------------------------------

  void give_up(const Watch& watch, const Trajectory& motion, Verdict& verdict) {
    // A motion that is slow to come onto its cycle.
    const bool may_close = setting_.coordinates != Coordinates::in_place;
    if (may_close && is_on_cycle(motion, {1e-2}, verdict)) return;
    const double from = motion.start_time();
    const auto seen_last = [&](const std::vector<Sample>& all) {
      std::vector<Sample> last;
      for (const Sample& sample : all) {
        if (sample.time >= from) last.push_back(sample);
      }
      return last;
    };
    constexpr std::size_t enough = 8;
    const std::vector<Sample> of_load = seen_last(watch.load);
    const std::vector<Sample> of_motor = seen_last(watch.motor);
    // Within the gap the motor may hunt by itself, and the load stand.
    const bool is_motor_alone =
        extremes(of_load).size() < enough && count_of_swings(extremes(of_motor), from) >= enough;
    const Watched& watched = is_motor_alone ? setting_.motor : setting_.load;
    const std::vector<Sample>& last = is_motor_alone ? of_motor : of_load;
    const std::vector<Sample> turns = extremes(last);
    if (setting_.coordinates != Coordinates::in_place && turns.size() < enough) {
      verdict.reason = watch.events >= most_events_ ? "as many events as were permitted"
                                                    : "still on its way at the end";
      return;
    }
    if (is_small(turns)) {
      verdict.reason = "swings shrink at the end, towards what is not certain";
      return;
    }
    if (setting_.coordinates != Coordinates::in_place && !is_steady(last)) {
      verdict.reason = "swings still grow or shrink at the end";
      return;
    }
    verdict.end = MotionEnd::irregular;
    IrregularFound& found = verdict.irregular;
    const Range range = range_of(of_load);
    found.size = 0.5 * range.width();
    found.motor_size = 0.5 * range_of(of_motor).width();
    found.center = range.middle();
    found.is_motor_alone = is_motor_alone;
    found.watched = motion.end_time() - from;
    const auto passings = upward_passings(motion, watched, last, range_of(last).middle(), from);
    std::vector<double> periods;
    for (std::size_t i = 0; i + 1 < passings.size(); ++i) {
      periods.push_back(passings[i + 1] - passings[i]);
    }
    const Spread period = spread_of(periods);
    found.period = period.mean;
    found.period_deviation = period.deviation;
    std::vector<double> half_swings;
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) half_swings.push_back(0.5 * swing(turns, i));
    const Spread half_swing = spread_of(half_swings);
    found.half_swing = half_swing.mean;
    found.half_swing_deviation = half_swing.deviation;
    found.mismatch = least_mismatch(turns);
    if (place_among_known(found) == result_.irregular.size()) {
      found.exponent = largest_exponent(setting_.system, motion, setting_.own);
    }
  }

  /// Whether both halves go about equally far.
  static bool is_steady(const std::vector<Sample>& samples) {
    const double middle = 0.5 * (samples.front().time + samples.back().time);
    Range first;
    Range second;
    for (const Sample& sample : samples) {
      (sample.time < middle ? first : second).include(sample.value);
    }
    constexpr double share = 0.2;
    return agree(first.width(), second.width(), std::max(first.width(), second.width()), share);
  }

  /// Of a motion that is much the same; their number where there is none.
  std::size_t place_among_known(const IrregularFound& found) const {
    constexpr double share = 0.1;
    std::size_t i = 0;
    for (; i < result_.irregular.size(); ++i) {
      const IrregularFound& known = result_.irregular[i];
      const double extent = std::max(found.size, found.motor_size);
      // Where the motor hunts alone the load may stand anywhere.
      const bool is_centered =
          found.is_motor_alone || agree(known.center, found.center, extent, share);
      if (known.is_motor_alone == found.is_motor_alone && is_centered &&
          agree(known.size, found.size, extent, share) &&
          agree(known.half_swing, found.half_swing, extent, share)) {
        break;
      }
    }
    return i;
  }

  // ---- what came of it --------------------------------------------------------------------------

  void record(const ShaftStates& start, const Verdict& verdict) {
    Outcome outcome{start, verdict.end, verdict.which, verdict.watched, verdict.reason};
    if (verdict.end == MotionEnd::rest) record_rest(verdict);
    if (verdict.end == MotionEnd::cycle) ++result_.cycles[verdict.which].starts;
    if (verdict.end == MotionEnd::irregular) {
      outcome.which = place_among_known(verdict.irregular);
      if (outcome.which == result_.irregular.size()) result_.irregular.push_back(verdict.irregular);
      ++result_.irregular[outcome.which].starts;
    }
    result_.outcomes.push_back(std::move(outcome));
  }

  void record_rest(const Verdict& verdict) {
    if (!result_.rest) result_.rest = RestFound{};
    RestFound& rest = *result_.rest;
    const double load = setting_.load.value.at(verdict.last);
    rest.load.include(load);
    rest.error.include(-load);
    rest.motor.include(setting_.motor.value.at(verdict.last));
    ++rest.starts;
    rest.swing_ratio = std::fmax(rest.swing_ratio, verdict.swing_ratio);  // the other of a NaN
  }

  /// Stable ones first, by falling size; in numbers without scale.
  void finish() {
    std::vector<std::size_t> order(result_.cycles.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const FoundCycle& one = result_.cycles[a];
      const FoundCycle& other = result_.cycles[b];
      if (one.stability != other.stability) return one.stability < other.stability;
      return one.size > other.size;
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
  }

  // ---- edges ------------------------------------------------------------------------------------

  static std::pair<int, std::size_t> name_of(const Verdict& verdict) {
    return {verdict.end == MotionEnd::rest ? 0 : 1, verdict.which};
  }

  /// Between neighbours in the list that are attracted elsewhere, each two attractors once.
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

  static ShaftStates between(const ShaftStates& a, const ShaftStates& b, double share) {
    const auto mix = [&](double one, double other) { return one + share * (other - one); };
    return {mix(a.motor_position, b.motor_position), mix(a.motor_speed, b.motor_speed),
            mix(a.load_position, b.load_position), mix(a.load_speed, b.load_speed)};
  }

  /// Bisection, until the two starts are next to each other; now and then it is tried whether the
  /// motion already hovers long enough to be closed.
  std::optional<std::size_t> cycle_between(std::size_t first, const Verdict& end_of_first) {
    const ShaftStates& a = starts_[first];
    const ShaftStates& b = starts_[first + 1];
    double low = 0.0;
    double high = 1.0;
    for (int step = 1; step <= 52; ++step) {
      const double middle = 0.5 * (low + high);
      if (!(low < middle && middle < high)) break;
      if (step % 13 == 0) {
        if (const auto found = hovered_at(setting_.start(between(a, b, middle)))) return found;
      }
      if (!goes_on()) return std::nullopt;
      const bool is_as_first =
          watch(setting_.start(between(a, b, middle)), 2.0).is_same_end(end_of_first);
      (is_as_first ? low : high) = middle;
    }
    return std::nullopt;
  }

  /// An unstable cycle that a motion comes near for a while.
  std::optional<std::size_t> hovered_at(const State& start) {
    constexpr double longest = 40.0;  // swings
    constexpr double step = 1.0;
    constexpr double near = 1e-2;
    for (double time = step; time <= longest; time += step) {
      const Trajectory motion =
          simulate(setting_.system, start,
                   {.until = setting_.between_ticks(time * setting_.swing_time),
                    .event_limit = options_.most_events});
      if (motion.stop_reason() != StopReason::reached_end) return std::nullopt;
      const auto found = closed_cycle(motion, near);
      if (found && found->stability == Stability::unstable) return place_of(*found);
    }
    return std::nullopt;
  }

  static constexpr double settlings = 30.0;  // e⁻³⁰ is some 1e-13

  const AttractorOptions& options_;
  std::size_t most_events_ = 0;  ///< of a start, with the ticks of a clock
  SearchSetting unscaled_;
  SearchSetting setting_;
  std::vector<ShaftStates> starts_;
  std::vector<Verdict> verdicts_;
  std::size_t done_ = 0;
  AttractorSearch result_;
};

}  // namespace

void Extent::include(double value) {
  lowest = std::min(lowest, value);
  highest = std::max(highest, value);
}

std::size_t AttractorSearch::count(MotionEnd end) const {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(),
                    [&](const Outcome& outcome) { return outcome.end == end; }));
}

AttractorSearch find_attractors(const Drive& drive, const AttractorOptions& options) {
  return Search(drive, options).run();
}

}  // namespace gearlash::drive
