// Which guard of a mode is the first to leave its side within a step.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "hybrid/first_exit.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "hybrid/preparation.hpp"

namespace gearlash::hybrid {

/// A step of the motion: where it starts, how well that is known, and its series.
struct StepSeries {
  const PreparedMode& mode;
  const PreparedFlow& flow;
  const State& state;
  const Vector& noise;       ///< uncertainty of each number by rounding
  const Velocity& velocity;  ///< at the start
  double time;               ///< of the start
  double length;
  double table_share;  ///< of the step in that of the tables
  int order;
};

struct StepEnd {
  /// Share of the step at which a guard leaves its side; beyond 1 if none does.
  double share = std::numeric_limits<double>::infinity();
  std::size_t guard = 0;
  double within = 0.0;  ///< bound of the distance from `share`
};

class GuardWatch {
 public:
  /// Each guard's side follows from its direction; without one it is the side that it is on first.
  void enter(const AffineMode& mode);

  /// The first exit of any guard in the next step of the mode. A rough one suffices if it is the
  /// only one.
  StepEnd next_exit(const StepSeries& step);

  /// Whether no guard leaves its side in a state that does not move: each is on its side by more
  /// than rounding, or is 0 within rounding and was the same in `quiet` numbers, in which none left
  /// it. These may be empty.
  bool are_clear(const PreparedMode& mode, const double* numbers, const double* noise,
                 const Vector& quiet) const;

  /// Touches of the last step, including those after its exit.
  const std::vector<Touch>& touches() const { return touches_; }

 private:
  /// Places as shares of the step.
  struct StepExit : FirstExit {
    double within = 0.0;  ///< bound of the distance from `at`
  };
  StepExit exit_of(const StepSeries& step, std::size_t guard, bool roughly);
  std::optional<StepExit> exit_by(const StepSeries& step, const GuardTable& table, double value,
                                  double unknown, double& sign, int last);
  int first_that_counts(const StepSeries& step, const GuardTable& table, double unknown,
                        int last) const;
  void note_touch(const StepSeries& step, std::size_t guard, const StepExit& exit);

  std::vector<double> signs_;  ///< of the guards' sides, 0 while unknown
  std::vector<double> coefficients_;
  double touch_within_ = 0.0;  ///< uncertainty of the guard whose whole series was used last
  std::vector<std::size_t> zero_at_start_;  ///< guards that the previous step brought down to 0
  std::vector<std::size_t> zero_at_end_;    ///< guards that this step brings down to 0
  std::vector<Touch> touches_;
};

}  // namespace gearlash::hybrid
