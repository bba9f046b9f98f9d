// Passes over rounds of ticks that repeat one affine map while the motion goes on.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "hybrid/clock_ticks.hpp"
#include "hybrid/present.hpp"

namespace gearlash::hybrid {

/// Between two instants a period P apart a motion that stays in one mode, and whose instruments
/// read the same, follows z⁺ = M z + c. From a round with the change d = z₁ − z₀ follow
///   zₙ₊₁ − z₁ = M Sₙ d,   Sₙ = Σ_{i<n} Mⁱ,
/// and no number differs from what it was at the same instant of that round by more than
///   |Φ| Bₙ |d|,   Bₙ = Σ_{i<n} |Mⁱ|,
/// with Φ what leads there from the round's start. So n rounds are passed over if no guard, reading
/// or alternative can change by that bound; guards also move between the ticks.
class Repeating {
 public:
  /// All of these must live as long. `events`: of the motion so far; the last ones are enough.
  Repeating(Present& now, ClockTicks& ticks, const std::vector<Event>& events,
            MotionObserver& observer, double until)
      : now_(now), ticks_(ticks), events_(events), observer_(observer), until_(until) {}

  /// Takes note of the last event.
  void note();
  /// Passes over as many rounds as surely repeat. False if none do, or if it is too early to try,
  /// which it is for longer while something moves. Precondition: no clock is due.
  bool pass_over(bool stands);
  /// Whether a standstill is too young to be tried.
  bool is_young() const { return run_ < first_try_standing; }

 private:
  /// 2^level rounds.
  struct Level {
    Matrix power;  ///< M^n
    Matrix sum;    ///< Sₙ
    Matrix sizes;  ///< at least Bₙ
  };

  /// A round of ticks of a mode, in their order from one that ends it.
  struct Round {
    std::vector<std::size_t> transitions{};  ///< the mode's timed ones
    Matrix map{};
    /// By forms: guards and what the observer watches in each interval, then the readings and the
    /// alternatives at its end.
    Matrix deviations{};  ///< |form Φ|, at least
    Matrix reaches{};     ///< of guards, per |velocity| at the interval's start, at least
    std::vector<Level> levels{};
    Vector margins{};    ///< of the forms, in the last round
    Vector by_a_jump{};  ///< how far they may change, at most
  };

  std::optional<std::size_t> length_of_round() const;
  Round* round_of(std::size_t length);
  Round made(const std::vector<std::size_t>& transitions) const;
  std::vector<double> lengths_of(const std::vector<std::size_t>& transitions) const;
  bool find_margins(Round& round);
  const Level& level(Round& round, std::size_t index) const;
  void jump(const Level& by, std::size_t rounds, const Matrix& map);

  Present& now_;
  ClockTicks& ticks_;
  const std::vector<Event>& events_;
  MotionObserver& observer_;
  double until_;
  std::map<std::size_t, Round> rounds_;  ///< by modes
  std::size_t run_ = 0;                  ///< ticks in a row that kept the mode
  std::size_t next_try_ = first_try;
  std::size_t level_ = 0;  ///< of the last jump
  // Kept so that a try takes no new memory.
  std::vector<std::size_t> transitions_{};
  Vector change_{};  ///< in the last round
  Vector moved_{};   ///< its size, with rounding
  Vector speed_{};
  Vector product_{};
  Vector before_{};
  static constexpr std::size_t first_try = 32;
  static constexpr std::size_t first_try_standing = 4;
};

}  // namespace gearlash::hybrid
