// The unknowns and equations of a periodic orbit in several phases.
#pragma once

#include <optional>
#include <vector>

#include "gearlash/hybrid/periodic_orbit.hpp"
#include "passage.hpp"

namespace gearlash::hybrid {

/// Unknown are the starts of all phases and, where something moves by itself (references), how long
/// after the anchor, where it was first seen, the first phase starts:
///   Fᵢ(xᵢ) − xᵢ₊₁ = 0,  the last on the first.
/// Of the last phase's end what moves by itself is left out; instead it is said where it starts, on
/// its own way from the anchor, and how long all phases take.
class Shooting {
 public:
  /// `counts` events in each phase, from `start` on.
  Shooting(const HybridSystem& system, const State& start, double start_time, double period,
           std::vector<std::size_t> counts);

  /// Puts the starts of the phases where the motion from the first one passes; false where it does
  /// not come so far.
  bool follow();

  const Vector& unknowns() const { return unknowns_; }
  void assign(const Vector& unknowns) { unknowns_ = unknowns; }
  /// The largest number of the starts, which mismatches are shares of.
  double scale() const;

  struct Equations {
    std::vector<Passage> passages;
    Vector residual;
    Matrix slope;  ///< by the unknowns
  };
  /// Nothing where a phase does not end as it should.
  std::optional<Equations> evaluate() const;

  PeriodicOrbit orbit(const Equations& solved) const;

 private:
  bool has_shift() const { return moves_by_itself_ && !has_clocks_; }
  State start_of(std::size_t phase) const;
  double shift() const { return has_shift() ? unknowns_[unknowns_.size() - 1] : 0.0; }
  std::optional<Passage> pass_from(std::size_t phase, double after) const;
  Vector residual_of(const std::vector<Passage>& all) const;
  Matrix slope_of(const std::vector<Passage>& all) const;

  const HybridSystem& system_;
  std::vector<std::size_t> counts_;
  std::vector<std::size_t> modes_;  ///< at the starts
  std::vector<bool> is_exogenous_;
  Matrix exogenous_flow_;
  bool moves_by_itself_ = false;
  bool has_clocks_ = false;
  double start_time_;
  double period_;
  Vector anchor_;
  Vector unknowns_;
};

/// Newton's method to rounding; nothing where it does not converge.
std::optional<PeriodicOrbit> solved_by_newton(Shooting& shooting, int most_steps);

bool has_periodic_clocks(const HybridSystem& system);

/// So many events, shared out over at most so many phases; a phase ends at a tick where
/// `ticks_alone`, and never between a firing and its settling.
std::vector<std::size_t> shared_out(const std::vector<Event>& events, std::size_t phases,
                                    bool ticks_alone);

}  // namespace gearlash::hybrid
