// Simulates a hybrid system without a step size: every event is a first crossing.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "gearlash/progress.hpp"
#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

struct State {
  std::size_t mode = 0;
  Vector numbers;
};

enum class EventKind {
  transition,  ///< a guard left its side
  timed,       ///< a clock ticked
  settling     ///< infinitely many firings of a transition were summed; time is that of the last
};

struct Event {
  double time = 0.0;
  EventKind kind = EventKind::transition;
  std::size_t mode = 0;        ///< before; of a settling, that of the last firing
  std::size_t transition = 0;  ///< among the mode's transitions, or its timed ones
  std::size_t mode_after = 0;
  Vector before;
  Vector after;

  /// Of the transition or the tick.
  const std::string& name(const HybridSystem& system) const;
  /// Whether the same transition was taken between the same modes.
  bool is_alike(const Event& other) const {
    return kind == other.kind && mode == other.mode && transition == other.transition &&
           mode_after == other.mode_after;
  }
};

/// A guard that came to 0 and turned back, within rounding. A small change of the system makes it
/// an event or avoids it (grazing).
struct Touch {
  double time = 0.0;
  std::size_t mode = 0;
  std::size_t transition = 0;
  double within = 0.0;  ///< in the guard's unit: it may have been this far beyond 0
};

enum class StopReason {
  reached_end,
  event_limit,  ///< the requested number of events is reached
  step_limit,   ///< the permitted number of steps is reached
  zeno,  ///< ever faster events, without a Settling, accumulate before `end_time`; culprit() has
         ///< the last one
  chattering,  ///< more events at one instant than there are ways through the modes; culprit() has
               ///< the transition
  diverged,    ///< numbers beyond 1e150
  stopped      ///< by the Progress of the options
};

struct SimulationOptions {
  double from = 0.0;  ///< time of the start, on which clocks depend
  double until = 0.0;
  std::size_t event_limit = 1'000'000;  ///< the motion stops just after this many events
  /// The motion stops after this many steps, of which each keeps the state. Of a motion that is
  /// observed steps are not kept, and not limited.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
  Progress* progress = nullptr;  ///< may stop the motion; nullptr: nothing may
};

/// Receives a motion piece by piece, so that nothing of it need be kept.
class MotionObserver {
 public:
  MotionObserver() = default;
  MotionObserver(const MotionObserver&) = delete;
  MotionObserver& operator=(const MotionObserver&) = delete;
  virtual ~MotionObserver() = default;
  /// The motion went from one state to another, without an event between them, or by ticks that
  /// repeat. Pieces follow each other in time. They are at most as long as a step of the series, so
  /// that a number and its derivative at both ends describe the number well; or what is watched()
  /// keeps its sign.
  virtual void moved(double from, double to, const Vector& before, const Vector& after) = 0;
  /// Forms whose changes of sign the observer must see.
  virtual const std::vector<AffineForm>& watched() const;
};

/// What remains of a motion that was observed.
struct Observed {
  double time = 0.0;  ///< of the end
  State end{};
  StopReason stop_reason = StopReason::reached_end;
  std::string culprit{};   ///< as Trajectory::culprit()
  std::size_t events = 0;  ///< without the ticks of a drive that stands
};

class Preparation;  // how modes are kept ready
class Trajectory;

/// A system prepared for many motions. Its faults are checked once. A mode's series are computed
/// when it is first entered, and kept. Copies share them. Several threads may use it at a time.
class PreparedSystem {
 public:
  PreparedSystem() = default;  ///< empty: to be assigned to
  /// Throws InvalidInput with all faults of the system.
  PreparedSystem(HybridSystem system);
  const HybridSystem& system() const;
  /// The numbers that nothing acts on (references, counts): HybridSystem::exogenous, or those found
  /// in a list of modes.
  const std::vector<bool>& exogenous() const;

 private:
  friend Trajectory simulate(const PreparedSystem& system, const State& start,
                             const SimulationOptions& options);
  friend Observed observe(const PreparedSystem& system, const State& start,
                          const SimulationOptions& options, MotionObserver& observer);
  std::shared_ptr<const Preparation> preparation_;
};

class Trajectory {
 public:
  double start_time() const { return start_time_; }
  double end_time() const { return end_time_; }
  const State& end() const { return end_; }
  StopReason stop_reason() const { return stop_reason_; }
  /// "mode: transition" of the last event if stop_reason() is zeno or chattering.
  const std::string& culprit() const { return culprit_; }
  const std::vector<Event>& events() const { return events_; }
  const std::vector<Touch>& touches() const { return touches_; }
  std::size_t steps() const { return steps_.size(); }
  /// Where a step of the series begins. Times rise; those of steps that an event ended at once may
  /// be equal.
  double step_time(std::size_t step) const { return steps_[step].time; }
  Eigen::Map<const Vector> step_start(std::size_t step) const;

  /// At any time from start_time() to end_time() (clamped to it). At an event: the state after it.
  State at(double time) const;
  /// The same, written to `state`: nothing is allocated after a thread's first call.
  void at(double time, State& state) const;

 private:
  friend class Simulation;
  struct Step {
    double time;
    std::size_t mode;
    std::size_t slow;  ///< how many of PreparedMode::slow() are over
  };
  void begin(std::shared_ptr<const Preparation> preparation, double time);

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

/// Calls visit(start, from, to, end) for each stretch between events, including those of no
/// duration. `end` is the state before the event there.
template <class Visit>
void for_each_stretch(const Trajectory& motion, Visit&& visit) {
  State here = motion.at(motion.start_time());
  double time = motion.start_time();
  if (!motion.events().empty() && motion.events().front().time == time) {
    // at() gives the state after the events.
    here = {motion.events().front().mode, motion.events().front().before};
  }
  for (const Event& event : motion.events()) {
    visit(here, time, event.time, event.before);
    here = {event.mode_after, event.after};
    time = event.time;
  }
  visit(here, time, motion.end_time(), motion.end().numbers);
}

/// The motion from `start` on, by the rules of HybridSystem.
///
/// Steps are Taylor series. A proved bound of what they leave out (below rounding) chooses their
/// order and length. A guard is a polynomial on each, and first_exit() finds where it first turns
/// negative. In exact arithmetic no crossing is stepped over.
///
/// In doubles a guard c·x + d may make an excursion beyond 0 that passes unseen if it is less deep
/// than the estimated rounding: 16 epsilons of all terms that a step adds, for the state and again
/// for the guard (estimates of first order). On steps of 2/‖A‖ that is at most 1,070 epsilons
/// (2.4e-13) of |d| + Σ|c_i x_i|. Each x_i counts as the largest number beside its weight, with
/// what the offset b gives it in a step. The largest in 1.5e6 passages was 1.5e-13
/// (docs/explanation/hybrid.md; tests/hybrid/grazing_band_test.cpp). Such a passage is listed as a
/// touch with its possible depth (Touch::within). A state this near a guard as its mode begins
/// counts as on it. The error of earlier steps is not included: it moves the motion, as a change of
/// the start does.
///
/// Let firings of one transition alone, or up to four in turn, have intervals (from turn to turn)
/// that shrink by a steady ratio ρ. Their limit is d ρ/(1 − ρ) after the last, with d the last
/// interval. If that is below 1e-10 of the mode's own time (or of the first interval, if longer),
/// they end there, by the Settling of the last transition. Without a Settling the motion cannot
/// continue beyond that time. It stops when the intervals are too short to be distinguished
/// (StopReason::zeno).
///
/// Throws InvalidInput with all faults of the system, of the start (a mode, finite numbers of the
/// right count) and of the options (from ≤ until, finite). Modes of a source are checked when the
/// motion first enters them.
Trajectory simulate(const HybridSystem& system, const State& start,
                    const SimulationOptions& options);
/// The same, but checks only the start and the options.
Trajectory simulate(const PreparedSystem& system, const State& start,
                    const SimulationOptions& options);

/// The same motion, which `observer` receives. Nothing is kept of it. While nothing moves between
/// ticks, these are repeated without counting as events, until one of them leads to another mode or
/// brings a guard near 0. Ticks that change nothing at all are passed over.
Observed observe(const PreparedSystem& system, const State& start, const SimulationOptions& options,
                 MotionObserver& observer);

}  // namespace gearlash::hybrid
