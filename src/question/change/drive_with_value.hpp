// What a drive does with another value of one parameter, and what that costs.
#pragma once

#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

struct DriveWithValue {
  double value = 0.0;
  Answer answer{};  ///< with its loop and step, and all that the target asks for
};

/// Without an axis the drive is as it is. The step is the usual one of the drive without the value.
/// Throws InvalidInput if it is unsound with that value.
DriveWithValue with_value(const Drive& base, const Axis* axis, double value, const Target& target,
                          Progress& progress = no_progress());

}  // namespace gearlash
