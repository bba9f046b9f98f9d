// Finds the guard of a mode that first leaves its side within a step.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "hybrid/first_exit.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "hybrid/preparation.hpp"

namespace gearlash::hybrid {

/// A step of the motion: its start, the uncertainty of that, and its series.
struct StepSeries {
  const PreparedMode& mode;
  const PreparedFlow& flow;
  const State& state;
  const Vector& noise;       ///< uncertainty of each number by rounding
  const Velocity& velocity;  ///< at the start
  double time;               ///< of the start
  double length;
  double table_share;  ///< of the step in that of the tables
  double remainder;    ///< of the series
  int order;
};

struct StepEnd {
  /// Share of the step at which a guard leaves its side; beyond 1 if none does.
  double share = std::numeric_limits<double>::infinity();
  std::size_t guard = 0;
  double within = 0.0;  ///< bound of the error of `share`
};

class GuardWatch {
 public:
  /// Each guard is to leave the side that its direction names, or the side on which it is first.
  void enter(const Mode& mode);

  /// The first exit of all guards in the next step of the mode. A rough one is enough if there is
  /// no other near it.
  StepEnd next_exit(const StepSeries& step);

  /// Within the step, or beyond its end.
  const std::vector<Touch>& touches() const { return touches_; }

 private:
  /// As a share of the step.
  struct StepExit : FirstExit {
    double within = 0.0;  ///< bound of the error of `at`
  };
  StepExit exit_of(const StepSeries& step, std::size_t guard, bool roughly);
  std::optional<StepExit> exit_by(const StepSeries& step, const GuardTable& table, double value,
                                  double unknown, double& sign, int last);
  int first_that_counts(const StepSeries& step, const GuardTable& table, double unknown,
                        int last) const;
  void note_touch(const StepSeries& step, std::size_t guard, const StepExit& exit);

  std::vector<double> signs_;  ///< of the sides that guards are to leave, 0 while unknown
  std::vector<double> coefficients_;
  double touch_within_ = 0.0;               ///< uncertainty of the guard whose last terms were used
  std::vector<std::size_t> zero_at_start_;  ///< guards that the step before brought down to 0
  std::vector<std::size_t> zero_at_end_;    ///< and those that this one does
  std::vector<Touch> touches_;
};

}  // namespace gearlash::hybrid
