// What must change so that a drive meets a target: the values that do, and what they cost.
#pragma once

#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/progress.hpp"
#include "question/change/target.hpp"

namespace gearlash {

/// What a drive does with another value of one parameter.
struct DriveWithValue {
  double value = 0.0;
  Answer answer{};  ///< with its loop and step, and all that the target asks for
};

struct DesignedParameter {
  FeasibleValues values{};
  std::vector<DriveWithValue> results{};  ///< with the values of nearest_of_each()
};

struct Design {
  DriveWithValue present{};  ///< its value is none
  /// Whether the present drive meets the target: proved for its data as far as bounds go, where the
  /// closed form answers with plastic contact. Some: it stands on a limit to within rounding, or it
  /// is not known.
  Judgement met = Judgement::some;
  /// Where the work was stopped the last of them is not searched to its end.
  std::vector<DesignedParameter> parameters{};
};

/// values() of each axis, and what the drive does with the nearest of them. Every step is the usual
/// one of the present drive. Throws InvalidInput as values().
Design design(const Drive& drive, const std::vector<Axis>& axes, const Target& target,
              Progress& progress = no_progress());

}  // namespace gearlash
