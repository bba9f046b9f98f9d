// The unknowns and equations of a periodic orbit in several phases.
#pragma once

#include <optional>
#include <vector>

#include "hybrid/passage.hpp"
#include "hybrid/periodic_orbit.hpp"

namespace gearlash::hybrid {

/// Unknown are the starts of all phases, each midway between two events. If something moves by
/// itself (references), another unknown is the time of the first phase's start after the anchor,
/// its first sighting:
///   Fᵢ(xᵢ) − xᵢ₊₁ = 0,  the last on the first.
/// A phase ends on a guessed plane across the motion, or with periodic clocks at a time. The last
/// phase's end leaves out what moves by itself. Its start on its own way from the anchor is
/// prescribed instead, and the duration of all phases.
class Shooting {
 public:
  /// For `events` events within the period from `start` on, which is midway between two of them,
  /// with at most this many phases. Empty if the motion has other events, or something moves by
  /// itself and is elsewhere after the period.
  static std::optional<Shooting> about(const PreparedSystem& system, const State& start,
                                       double start_time, double period, std::size_t events,
                                       std::size_t phases);

  /// The same phases and planes, for a slightly different system.
  Shooting of(const PreparedSystem& system) const;

  const Vector& unknowns() const { return unknowns_; }
  void assign(const Vector& unknowns) { unknowns_ = unknowns; }
  /// The largest number of the starts. Mismatches are shares of it.
  double scale() const;

  struct Equations {
    std::vector<Passage> passages;
    Vector residual;
    Matrix slope;  ///< by the unknowns
  };
  /// Empty if a phase does not end as it should.
  std::optional<Equations> evaluate() const;

  /// How far the starts are missed, as a share of scale(); or, if larger, the duration as a share
  /// of the period.
  double mismatch(const Equations& equations) const;

  PeriodicOrbit orbit(const Equations& solved) const;

 private:
  Shooting(const PreparedSystem& system, const State& start, double start_time, double period);

  /// A phase's start (when, in which mode, the plane), and the number of events that follow in the
  /// phase.
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
  bool returns_by_itself_ = true;  ///< after the period
  bool has_clocks_ = false;
  double start_time_;
  double period_;
  Vector anchor_;
  Vector unknowns_;
};

/// Newton's method to rounding. Empty if it does not converge.
std::optional<PeriodicOrbit> solved_by_newton(Shooting& shooting, int most_steps);

bool has_periodic_clocks(const HybridSystem& system);

}  // namespace gearlash::hybrid
