// The servos of a chart, a map or a sweep, and their limit cycles on all cores.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/grid/axis.hpp"
#include "closed_form/lanes/cycle_batch.hpp"

namespace gearlash {

/// A servo of which some inputs are varied: one point for each combination of the axes' values, the
/// last axis fastest.
struct ServoGrid {
  NormalizedServo servo;  ///< but for what stands on the axes
  std::vector<Axis> axes;
  bool proved = false;  ///< verdicts with plastic contact are proved (keep_proved()), not computed

  std::size_t size() const;
  NormalizedServo at(std::size_t index) const;
  bool may_bounce() const;  ///< whether the restitution is more than 0 anywhere
};

/// Every fault of the axes, of two axes with the same input, of more points than
/// most_points_of_a_grid, and of the servo. `fields` names the axes, as many as there are.
/// Combinations that are refused (a massless load without friction) are points of which nothing is
/// known, not faults.
std::vector<Fault> validate(const ServoGrid& grid, const std::vector<std::string>& fields);

/// How many points from `first` on, `most` at most, are a box of the grid: some values of one axis
/// with all values of the axes after it. Precondition: `first` is 0, or where such a box ended;
/// most > 0.
std::size_t box_length(const ServoGrid& grid, std::size_t first, std::size_t most);

/// Heard from one thread at a time, now and then, with the number of points done; false stops.
using GoingOn = std::function<bool(std::size_t done)>;

/// How a grid is worked out.
struct GridEvaluation {
  std::size_t threads = 0;  ///< 0: as many as the machine has cores
  VectorUnit unit = widest_vector_unit();
  GoingOn going_on = {};
};

struct GridCount {
  BatchCount solved;
  std::size_t refused = 0;   ///< combinations that are no servo: verdict undecided, all else NaN
  std::size_t unproved = 0;  ///< undecided because the proof that was asked for left them open
  bool stopped = false;      ///< before all points were done

  /// Of other points: how they were solved.
  void add(const GridCount& others);
};

/// The limit cycles of `count` points from `first` on, into the columns' rows 0 … count − 1. The
/// same bits for any number of threads. Precondition: validate(grid) is empty, first + count ≤
/// size().
GridCount evaluate(const ServoGrid& grid, std::size_t first, std::size_t count,
                   const CycleColumns& cycles, const GridEvaluation& how = {});

}  // namespace gearlash
