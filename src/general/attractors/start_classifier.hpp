// Decides where the motion from a start ends.
#pragma once

#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "general/attractors/creeping.hpp"
#include "general/attractors/cycle_closing.hpp"
#include "general/attractors/irregular_motion.hpp"
#include "general/attractors/motion_watch.hpp"
#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {

/// Where a motion ends.
struct Verdict {
  MotionEnd end = MotionEnd::undecided;
  std::size_t which = 0;  ///< index into the cycles
  double watched = 0.0;
  std::string reason;
  double swing_ratio = std::numeric_limits<double>::quiet_NaN();
  std::vector<Standstill> rest;            ///< where, if `end` is rest
  std::optional<double> uncertainty;       ///< rad, of that place; empty if it creeps
  std::optional<ShrinkingSteps> approach;  ///< by which it is never quite reached
  std::optional<double> time_to_rest;      ///< s, if it was asked for
  bool is_creeping = false;                ///< to rest, or there
  IrregularFound irregular;                ///< if `end` is irregular

  bool is_attracted() const { return end == MotionEnd::rest || end == MotionEnd::cycle; }
  bool is_same_end(const Verdict& other) const {
    return end == other.end && (end != MotionEnd::cycle || which == other.which);
  }
};

/// Steps of a motion that SearchBudget::bytes_kept allows, a thousand at least. A step keeps its
/// time, its mode and all numbers.
std::size_t steps_kept(const SearchSetting& setting, const SearchBudget& budget);

/// Watches starts one after the other. What one led to is known to the next.
class StartClassifier {
 public:
  /// Adds the cycles that it closes to those of `search`, and reads its irregular motions and its
  /// watch time. Asks `goes_on` between stretches. All must live as long.
  StartClassifier(const SearchSetting& setting, const AttractorOptions& options,
                  AttractorSearch& search, std::function<bool()> goes_on)
      : setting_(setting), options_(options), search_(search), goes_on_(std::move(goes_on)) {}

  /// Watches until the motion comes to rest, runs away, joins a motion that is known, repeats its
  /// statistics, or Newton's method closes a cycle that it is on. A motion in which hardly anything
  /// happens is watched `patience` times as long, and time without events hardly counts. Any motion
  /// is watched `longer` times as long; above 1, statistics that repeat are not its end.
  Verdict end_of(const hybrid::State& start, double patience, double longer = 1.0);

  /// s: the last time at which the load was farther than `band`, rad, from its final position, of
  /// the start that was watched last. `verdict`: its end, rest. By its law where the approach has
  /// one. Empty where the motion does not show it.
  std::optional<double> time_to_rest(const Verdict& verdict, double band) const;

 private:
  Verdict watched(Watch& watch, double patience, double longer);
  /// What a start led to.
  struct Known {
    SteadyMotion motion;
    MotionEnd end;      ///< irregular or cycle
    std::size_t which;  ///< index into the cycles
  };

  /// Of a start, with the ticks that are permitted besides.
  std::size_t most_events() const;
  /// Shorter if the motion may join a cycle that is known.
  double first_stretch() const;
  /// The ticks of a sampled drive are too many to be kept.
  Stretch next_stretch(Watch& watch, double until, std::size_t most_if_sampled) const;
  /// Longest time that a start is watched: more if hardly anything happens.
  double longest(const Watch& watch, const Stretch& stretch, double patience) const;
  bool is_decided(const Watch& watch, const Stretch& stretch, Verdict& verdict);
  /// Takes the motion for at rest there, to within what counts as no move.
  void rest_at(const Watch& watch, const hybrid::Vector& numbers, Verdict& verdict) const;
  /// Whether the motion comes to rest without another event, which may take for ever; or would have
  /// done so from the middle of its longest move on: events after that are rounding.
  bool settles(const Watch& watch, const Stretch& stretch, Verdict& verdict);
  /// Whether the motion goes rounds that shrink to rest (shrinking_rounds()), as a shaft that
  /// slides to the reference and sticks and slips a hundred times a second.
  bool fades(const Watch& watch, const Stretch& stretch, Verdict& verdict) const;
  /// What small disturbances of a rest on the border of its mode lead to, if no dry friction holds
  /// it: `undisturbed`, if to rest.
  Verdict disturbed(const hybrid::State& rest, const Verdict& undisturbed);
  /// Whether standstills follow the law of creeping, or the last one has lasted after a long watch.
  bool creeps(const std::vector<Standstill>& stood, const Watch& watch, bool is_long,
              Verdict& verdict) const;
  /// Whether a motion is one that is known, or has repeated its statistics from one
  /// stretch to the next. Motion that repeats may be a cycle.
  bool is_steady(const Watch& watch, const Stretch& stretch, std::optional<SteadyMotion>& before,
                 Verdict& verdict);
  /// What the same motion led to before; null if it is new.
  const Known* known_as(const SteadyMotion& motion) const;
  /// A sampled drive, of which one sine repeats itself.
  bool is_under_sine() const { return setting_.drive.sampling && setting_.common_sine > 0.0; }
  /// Events of a clock.
  std::size_t ticks_in(double time) const;
  SteadyMotion steady(const Watch& watch, const Stretch& stretch,
                      const IrregularFound& found) const;
  /// Whether it runs along with a motion under a sine that is known.
  bool joins(const Stretch& stretch, Verdict& verdict) const;
  /// Whether a motion that was kept, on which no cycle was closed, repeats ever better.
  bool may_still_close(const SteadyMotion& now, const std::optional<SteadyMotion>& before) const;
  /// Whether Newton's method closes a cycle on a sampled drive's motion.
  bool closes(const Watch& watch, const Stretch& stretch, const IrregularFound& found,
              Verdict& verdict);
  /// A sampled drive's motion from here on, over a few periods, kept.
  hybrid::Trajectory recorded(const Watch& watch, const IrregularFound& found,
                              double periods) const;
  /// Whether swings shrink towards a rest that they never reach. Decided only after the linear
  /// loop's settling time.
  bool is_vanishing(const Watch& watch, const Stretch& stretch, Verdict& verdict) const;
  /// Whether a motion ends on a cycle, or in the rest that a creeping cycle is. Unstable cycles
  /// passed by are kept in the result.
  bool is_on_cycle(const hybrid::Trajectory& motion, std::initializer_list<double> all_nearness,
                   Verdict& verdict);
  /// The motion is what its last stretch shows, or that `before` which was steady.
  void give_up(const Watch& watch, const Stretch& stretch,
               const std::optional<SteadyMotion>& before, Verdict& verdict);
  /// Takes the motion as irregular.
  void take(const Watch& watch, const IrregularFound& found, Verdict& verdict,
            const Stretch* stretch = nullptr);

  const SearchSetting& setting_;
  const AttractorOptions& options_;
  const SearchTolerances& tolerances_ = options_.tolerances;
  const SearchBudget& budget_ = options_.budget;
  AttractorSearch& search_;
  std::function<bool()> goes_on_;
  /// Asks that within a stretch.
  class Asked : public Progress {
   public:
    explicit Asked(const std::function<bool()>& goes_on) : goes_on_(goes_on) {}
    bool go_on(double /*share*/, std::size_t /*bytes*/) override { return goes_on_(); }

   private:
    const std::function<bool()>& goes_on_;
  };
  Asked asked_{goes_on_};
  CycleClosing closing_{setting_, options_};
  std::vector<Known> known_;
  Watch last_;                                        ///< of the last start
  bool is_disturbed_ = false;                         ///< the start that is watched
  std::map<std::size_t, Verdict> ends_of_disturbed_;  ///< by the mode of the rest
};

}  // namespace gearlash::drive
