// What a drive does with another value of one parameter, and what that costs.
#pragma once

#include <optional>

#include "analysis/linear_loop.hpp"
#include "analysis/step_response.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/grid.hpp"

namespace gearlash {

struct DriveWithValue {
  double value = 0.0;
  Answer answer{};
  drive::StepResponse response{};
  std::optional<drive::LoopFigures> loop{};  ///< empty for a relay
};

/// Without an axis the drive is as it is. Throws InvalidInput if it is unsound with that value.
DriveWithValue with_value(Drive drive, const Axis* axis, double value, const drive::Step& step);

}  // namespace gearlash
