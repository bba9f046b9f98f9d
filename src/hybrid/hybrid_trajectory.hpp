// The motion of a hybrid system: simulation without a step size, every event a first crossing.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

struct State {
  std::size_t mode = 0;
  Vector numbers;
};

enum class EventKind {
  transition,  ///< a guard left its side
  timed,       ///< a clock ticked
  settling     ///< infinitely many firings of a transition were summed: time is that of the last
};

struct Event {
  double time = 0.0;
  EventKind kind = EventKind::transition;
  std::size_t mode = 0;        ///< before
  std::size_t transition = 0;  ///< among the mode's transitions, or its timed ones
  std::size_t mode_after = 0;
  Vector before;
  Vector after;
};

/// A guard that came to 0 and turned back, as far as numbers can tell: a little change of the
/// system makes an event of it, or keeps it away (grazing).
struct Touch {
  double time = 0.0;
  std::size_t mode = 0;
  std::size_t transition = 0;
  double within = 0.0;  ///< in the guard's unit: so far beyond 0 it may have been
};

enum class StopReason {
  reached_end,
  event_limit,  ///< as many events as were asked for
  zeno,        ///< ever faster events, without a Settling, have no end before `end_time`: culprit()
               ///< has the last one
  chattering,  ///< more events at one instant than there are ways through the modes; culprit() has
               ///< the transition
  diverged     ///< numbers beyond 1e150
};

struct SimulationOptions {
  double from = 0.0;  ///< time of the start, on which clocks depend
  double until = 0.0;
  std::size_t event_limit = 1'000'000;  ///< the motion stops just after so many
};

class Preparation;  // how modes are kept ready
class Trajectory;

/// A system made ready for many motions: its faults are looked for once, and a mode's series are
/// worked out when it is first entered, and kept. Copies share them. May be used by several threads
/// at a time.
class PreparedSystem {
 public:
  PreparedSystem() = default;  ///< of nothing: to be assigned to
  /// Throws InvalidInput with all faults of the system.
  explicit PreparedSystem(HybridSystem system);
  const HybridSystem& system() const;
  /// Which numbers follow their own flow alone, the same in every mode, and are changed by no event
  /// (references): HybridSystem::exogenous, or what was found in a list of modes.
  const std::vector<bool>& exogenous() const;

 private:
  friend Trajectory simulate(const PreparedSystem& system, const State& start,
                             const SimulationOptions& options);
  std::shared_ptr<const Preparation> preparation_;
};

class Trajectory {
 public:
  double start_time() const { return start_time_; }
  double end_time() const { return end_time_; }
  const State& end() const { return end_; }
  StopReason stop_reason() const { return stop_reason_; }
  /// "mode: transition", of the last event, where stop_reason() is zeno or chattering.
  const std::string& culprit() const { return culprit_; }
  const std::vector<Event>& events() const { return events_; }
  const std::vector<Touch>& touches() const { return touches_; }
  std::size_t steps() const { return steps_.size(); }

  /// At any time from start_time() to end_time() (clamped to it); at an event, after it.
  State at(double time) const;

 private:
  friend class Simulation;
  struct Step {
    double time;
    std::size_t mode;
    bool is_slow;  ///< fast decays are over
  };
  std::shared_ptr<const Preparation> preparation_;
  std::vector<Step> steps_;
  std::vector<double> starts_;  ///< of the steps: all numbers of one after those of another
  std::vector<Event> events_;
  std::vector<Touch> touches_;
  double start_time_ = 0.0;
  double end_time_ = 0.0;
  State end_;
  StopReason stop_reason_ = StopReason::reached_end;
  std::string culprit_;
};

/// The motion from `start` on, by the rules of HybridSystem.
///
/// Steps are Taylor series whose order and length are chosen by a proved bound of what they leave
/// out (below rounding); a guard is a polynomial on each, and first_exit() finds where it first
/// turns negative. In exact arithmetic no crossing is stepped over.
///
/// In doubles an excursion of a guard c·x + d beyond 0 may pass unseen that is less deep than what
/// rounding is reckoned to have added: 16 epsilons of all terms that a step adds up, for the state
/// and again for the guard (estimates of first order). On steps of 2/‖A‖ that is at most 1,070
/// epsilons (2.4e-13) of |d| + Σ|c_i x_i|, each x_i counted as the largest number beside its
/// weight, with what the offset b gives it in a step; up to 1.5e-13 was seen of 1.5e6 passages
/// (docs/hybrid.md; tests/hybrid/grazing_band_test.cpp). Such a passage is listed as a touch, with
/// how deep it may have been (Touch::within). A state that is so near a guard as its mode begins
/// counts as on it. What earlier steps have added is not in it: it moves the motion, as a change of
/// the start does.
///
/// Firings of one transition alone, or up to four in turn, whose intervals (from turn to turn)
/// shrink by a steady ratio ρ have the limit d ρ/(1 − ρ) after the last, d the last interval. Where
/// what is left is some 1e-10 of the mode's own time (or of the first interval, if longer), they
/// end there, by the Settling of the last transition; without one the motion has no end beyond that
/// time, and stops when the intervals are too short to be told apart (StopReason::zeno).
///
/// Throws InvalidInput with all faults of the system, of the start (a mode, finite numbers of the
/// right count) and of the options (from ≤ until, finite). Modes of a source are looked at as the
/// motion first enters them.
Trajectory simulate(const HybridSystem& system, const State& start,
                    const SimulationOptions& options);
/// The same; only faults of the start and of the options are looked for.
Trajectory simulate(const PreparedSystem& system, const State& start,
                    const SimulationOptions& options);

}  // namespace gearlash::hybrid
