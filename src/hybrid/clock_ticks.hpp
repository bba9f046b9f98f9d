// The next ticks of a system's clocks.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/special_numbers.hpp"
#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

/// Inline, because every step asks.
class ClockTicks {
 public:
  /// Starts with the first ticks that are not before a time. The clocks must live as long.
  ClockTicks(const std::vector<Clock>& clocks, double from) : clocks_(clocks) {
    for (const Clock& clock : clocks) ticks_.push_back(first_tick(clock, from));
  }

  /// Time of the next tick; infinity if there is none.
  double next() const {
    double next = infinity;
    for (const Tick& tick : ticks_) next = std::min(next, tick.time);
    return next;
  }

  std::size_t count() const { return ticks_.size(); }
  /// Time of a clock's first tick.
  double first(std::size_t clock) const { return clocks_[clock].first; }
  /// Whether the clock's ticks are all alike: periodic, and none adds anything.
  bool is_regular(std::size_t clock) const {
    return clocks_[clock].period > 0.0 && clocks_[clock].additions.empty();
  }
  /// Whether all clocks are, or have no more ticks.
  bool are_regular() const {
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      if (!is_regular(i) && std::isfinite(ticks_[i].time)) return false;
    }
    return true;
  }
  /// The shortest time in which every clock that still ticks has ticked, and all tick as before. 0
  /// if there is none. Precondition: are_regular().
  double common_period() const { return shared_period() * static_cast<double>(ticks_of_round()); }
  /// Clock::period of all clocks that still tick. 0 if they have several, or not one of them ticks
  /// with each tick of any other. Precondition: are_regular().
  double shared_period() const {
    const std::size_t of_round = ticks_of_round();
    double period = 0.0;
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      if (!std::isfinite(ticks_[i].time)) continue;
      const bool differs = period != 0.0 && clocks_[i].period != period;
      if (differs || of_round % clocks_[i].every != 0) return 0.0;
      period = clocks_[i].period;
    }
    return period;
  }
  /// The largest Clock::every of those that still tick.
  std::size_t ticks_of_round() const {
    std::size_t most = 1;
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      if (std::isfinite(ticks_[i].time)) most = std::max(most, clocks_[i].every);
    }
    return most;
  }
  /// Passes over this many common periods. Precondition: are_regular().
  void pass_over(std::size_t rounds) {
    const std::size_t of_round = ticks_of_round();
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      if (!std::isfinite(ticks_[i].time)) continue;
      ticks_[i].count += rounds * (of_round / clocks_[i].every);
      ticks_[i].time = time_of(clocks_[i], ticks_[i].count);
    }
  }
  /// Moves all clocks past their ticks before a time. Precondition: are_regular().
  void pass_before(double time) {
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      if (!std::isfinite(ticks_[i].time)) continue;
      ticks_[i] = first_tick(clocks_[i], std::max(time, ticks_[i].time));
    }
  }
  bool is_due(std::size_t clock, double time) const { return ticks_[clock].time <= time; }

  /// Moves past the next tick. Returns what it adds to the state, or null.
  const Vector* pass(std::size_t index) {
    const Clock& clock = clocks_[index];
    const std::size_t count = ticks_[index].count;
    advance(clock, ticks_[index]);
    return count < clock.additions.size() ? &clock.additions[count] : nullptr;
  }

 private:
  struct Tick {
    double time;
    std::size_t count = 0;
  };

  /// Of a clock with a period.
  static double time_of(const Clock& clock, std::size_t count) {
    return clock.first + static_cast<double>(count * clock.every) * clock.period;
  }

  static Tick first_tick(const Clock& clock, double from) {
    Tick tick{clock.period > 0.0 ? clock.first : clock.times.front()};
    if (clock.period > 0.0 && tick.time < from) {
      tick.count = static_cast<std::size_t>((from - clock.first) / clock.period) / clock.every;
      tick.time = time_of(clock, tick.count);
    }
    while (tick.time < from) advance(clock, tick);
    return tick;
  }

  static void advance(const Clock& clock, Tick& tick) {
    ++tick.count;
    if (clock.period > 0.0) {
      tick.time = time_of(clock, tick.count);
    } else {
      tick.time = tick.count < clock.times.size() ? clock.times[tick.count] : infinity;
    }
  }

  const std::vector<Clock>& clocks_;
  std::vector<Tick> ticks_;
};

}  // namespace gearlash::hybrid
