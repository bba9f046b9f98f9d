// Turns of recurring events: which, how often, and the duration of each.
#pragma once

#include <array>
#include <vector>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

/// A turn is up to four events. It recurs if each of them equals the one a turn earlier.
class RecurringEvents {
 public:
  /// The events must live as long.
  explicit RecurringEvents(const std::vector<Event>& events) : events_(events) {}

  /// Records the last event.
  void note() {
    for (std::size_t turn = 1; turn <= longest_turn; ++turn) {
      std::size_t& count = recurrences_[turn - 1];
      const bool recurs = events_.size() > turn && events_.back().kind == EventKind::transition &&
                          events_.back().is_alike(events_[events_.size() - 1 - turn]);
      count = recurs ? count + 1 : 0;
    }
  }

  /// Only this many of the last events are still there.
  void limit(std::size_t most) {
    for (std::size_t turn = 1; turn <= longest_turn; ++turn) {
      recurrences_[turn - 1] = std::min(recurrences_[turn - 1], most - 2 * turn);
    }
  }

  /// Duration of the turn that ended this many turns ago.
  double duration(std::size_t turn, std::size_t ago) const {
    const std::size_t last = events_.size() - 1 - ago * turn;
    return events_[last].time - events_[last - turn].time;
  }

  /// Number of whole turns of the sequence before the last event. Precondition: it has recurred.
  std::size_t turns_before(std::size_t turn) const { return (recurrences_[turn - 1] - 1) / turn; }

  /// The shortest turn of events that has recurred often enough, or 0.
  std::size_t recurring_turn(std::size_t enough) const {
    for (std::size_t turn = 1; turn <= longest_turn; ++turn) {
      if (recurrences_[turn - 1] >= (enough - 1) * turn) return turn;
    }
    return 0;
  }

  /// Whether the turns before this instant, at which events do not end, were each shorter than the
  /// one before.
  bool have_come_ever_faster() const {
    const std::size_t turn = recurring_turn(4);
    if (turn == 0) return false;
    const std::size_t turns = turns_before(turn);
    std::size_t shorter = 0;
    for (std::size_t ago = 0; ago < turns; ++ago) {
      if (duration(turn, ago) == 0.0) continue;
      if (!(duration(turn, ago) < duration(turn, ago + 1))) break;
      ++shorter;
    }
    return shorter >= 3;
  }

 private:
  static constexpr std::size_t longest_turn = 4;

  const std::vector<Event>& events_;
  std::array<std::size_t, longest_turn> recurrences_{};  ///< by the length of a turn, from 1 on
};

}  // namespace gearlash::hybrid
