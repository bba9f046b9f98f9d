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
  /// The period of all clocks that still tick. 0 if they have several. Precondition: are_regular().
  double common_period() const {
    double period = 0.0;
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      if (!std::isfinite(ticks_[i].time)) continue;
      if (period != 0.0 && clocks_[i].period != period) return 0.0;
      period = clocks_[i].period;
    }
    return period;
  }
  /// Passes over this many ticks of every clock. Precondition: are_regular().
  void pass_over(std::size_t count) {
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      if (!std::isfinite(ticks_[i].time)) continue;
      ticks_[i].count += count;
      ticks_[i].time = clocks_[i].first + static_cast<double>(ticks_[i].count) * clocks_[i].period;
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

  static Tick first_tick(const Clock& clock, double from) {
    Tick tick{clock.period > 0.0 ? clock.first : clock.times.front()};
    if (clock.period > 0.0 && tick.time < from) {
      tick.count = static_cast<std::size_t>((from - clock.first) / clock.period);
      tick.time = clock.first + static_cast<double>(tick.count) * clock.period;
    }
    while (tick.time < from) advance(clock, tick);
    return tick;
  }

  static void advance(const Clock& clock, Tick& tick) {
    ++tick.count;
    const auto count = static_cast<double>(tick.count);
    if (clock.period > 0.0) {
      tick.time = clock.first + count * clock.period;
    } else {
      tick.time = tick.count < clock.times.size() ? clock.times[tick.count] : infinity;
    }
  }

  const std::vector<Clock>& clocks_;
  std::vector<Tick> ticks_;
};

}  // namespace gearlash::hybrid
