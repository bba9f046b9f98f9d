// The unknowns and equations of a periodic orbit in several phases.
#pragma once

#include <optional>
#include <vector>

#include "hybrid/passage.hpp"
#include "hybrid/periodic_orbit.hpp"

namespace gearlash::hybrid {

/// Unknown are the starts of all phases, midway between two events each, and, where something moves
/// by itself (references), how long after the anchor, where it was first seen, the first phase
/// starts:
///   Fᵢ(xᵢ) − xᵢ₊₁ = 0,  the last on the first.
/// A phase ends on a plane across the motion that was guessed; with periodic clocks at a time. Of
/// the last phase's end what moves by itself is left out; instead it is said where it starts, on
/// its own way from the anchor, and how long all phases take.
class Shooting {
 public:
  /// Of `events` events within the period from `start` on, which is midway between two of them; so
  /// many phases at most. Nothing where the motion has other events.
  static std::optional<Shooting> about(const PreparedSystem& system, const State& start,
                                       double start_time, double period, std::size_t events,
                                       std::size_t phases);

  /// The same phases and planes, of a system that is a little different.
  Shooting of(const PreparedSystem& system) const;

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
  Shooting(const PreparedSystem& system, const State& start, double start_time, double period);

  /// A phase's start: when, in which mode, the plane, and how many events follow in the phase.
  struct Phase {
    double time = 0.0;  ///< from the first phase's start on
    std::size_t mode = 0;
    AffineForm plane;
    std::size_t events = 0;
  };
  void divide(const Trajectory& motion, std::size_t phases);

  void find_exogenous();
  Eigen::Index size() const { return system_.system().size(); }
  bool has_shift() const { return moves_by_itself_ && !has_clocks_; }
  State start_of(std::size_t phase) const;
  double shift() const { return has_shift() ? unknowns_[unknowns_.size() - 1] : 0.0; }
  std::optional<Passage> pass_from(std::size_t phase) const;
  Vector residual_of(const std::vector<Passage>& all) const;
  Matrix slope_of(const std::vector<Passage>& all) const;

  PreparedSystem system_;
  std::size_t first_mode_;  ///< of the first phase
  std::vector<Phase> phases_;
  std::vector<bool> is_exogenous_;
  AffineFlow exogenous_flow_;
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

}  // namespace gearlash::hybrid
