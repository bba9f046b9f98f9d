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
  const Vector& noise;       ///< what rounding has left unknown of each number
  const Velocity& velocity;  ///< at the start
  double time;               ///< of the start
  double length;
  double table_share;  ///< of the step in that of the tables
  double remainder;    ///< of the series
  int order;
};

struct StepEnd {
  /// Of the step, where a guard leaves its side; beyond 1 where none does.
  double share = std::numeric_limits<double>::infinity();
  std::size_t guard = 0;
  double within = 0.0;  ///< how far from `share` it may be
};

class GuardWatch {
 public:
  /// Each guard is to leave the side that its direction says, or the one that it is on first.
  void enter(const AffineMode& mode);

  /// The first exit of all in the next step of the mode. One that is known roughly is enough where
  /// there is no other beside it.
  StepEnd next_exit(const StepSeries& step);

  /// Within the step, or beyond its end.
  const std::vector<Touch>& touches() const { return touches_; }

 private:
  /// As a share of the step.
  struct StepExit : FirstExit {
    double within = 0.0;  ///< how far from `at` it may be
  };
  StepExit exit_of(const StepSeries& step, std::size_t guard, bool roughly);
  std::optional<StepExit> exit_by(const StepSeries& step, const GuardTable& table, double value,
                                  double unknown, double& sign, int last);
  int first_that_counts(const StepSeries& step, const GuardTable& table, double unknown,
                        int last) const;
  void note_touch(const StepSeries& step, std::size_t guard, const StepExit& exit);

  std::vector<double> signs_;  ///< of the sides that guards are to leave, 0 while unknown
  std::vector<double> coefficients_;
  double touch_within_ = 0.0;  ///< how well the guard is known of which the last terms were asked
  std::vector<std::size_t> zero_at_start_;  ///< guards that the step before brought down to 0
  std::vector<std::size_t> zero_at_end_;    ///< and those that this one does
  std::vector<Touch> touches_;
};

}  // namespace gearlash::hybrid
