// Repeats the ticks of a system while nothing moves between them.
#pragma once

#include "hybrid/clock_ticks.hpp"
#include "hybrid/guard_watch.hpp"
#include "hybrid/present.hpp"

namespace gearlash::hybrid {

class Standing {
 public:
  Standing(Present& now, ClockTicks& ticks, const GuardWatch& guards, MotionObserver& observer,
           double until)
      : now_(now), ticks_(ticks), guards_(guards), observer_(observer), until_(until) {}

  /// Whether nothing moves, and no guard leaves its side.
  bool stands_clear();

  /// Repeats the ticks of a mode in which nothing moves, while they lead back to it and leave its
  /// guards clear. The clocks fire before the next step. Precondition: none is due.
  /// Returns the number of ticks that were repeated one by one, some thousands at most.
  std::size_t stand();

  /// The present numbers do not move, and no guard left its side there.
  void note_quiet() {
    quiet_mode_ = now_.state.mode;
    quiet_ = now_.state.numbers;
  }

 private:
  /// Rounds of all clocks that each change the numbers in the same way.
  struct Rounds {
    Vector last;
    Vector change;          ///< in the last round
    Vector begin;           ///< before the first of those alike
    std::size_t alike = 0;  ///< rounds with the same change, within rounding

    void add(const Vector& numbers, const Vector& rounding);
    void begin_again() {
      begin = last;
      alike = 0;
    }
    /// How many rounds may follow those alike: an error of the mean change then adds up to no more
    /// than one change. 0 if a number changes neither steadily and clearly by more than rounding
    /// nor by rounding alone.
    double most_to_pass(const Vector& rounding) const;
    /// The mean of many has less rounding than one. 0 for a number that has moved by no more than
    /// rounding in all of them.
    Vector mean_change(const Vector& rounding) const {
      const Vector all = last - begin;
      return (all.array().abs() > rounding.array()).select(all / static_cast<double>(alike), 0.0);
    }
  };

  bool repeat_ticks(double time);
  void note_rounding(const AffineReset& reset, const PreparedReset& prepared);
  double rounds_before_a_change(const Vector& change, double period) const;
  void pass_over(Rounds& rounds, double period, double at_most);

  Present& now_;
  ClockTicks& ticks_;
  const GuardWatch& guards_;
  MotionObserver& observer_;
  double until_;
  Vector before_;  ///< numbers at the start of a piece that is observed
  Vector ticked_;
  Vector rounding_;          ///< of each number by the resets of a round
  Vector earlier_rounding_;  ///< in the round before
  Vector scratch_;
  Vector quiet_;  ///< numbers at which nothing moved and no guard left its side; or empty
  std::size_t quiet_mode_ = 0;
};

}  // namespace gearlash::hybrid
