// Where a simulated motion is.
#pragma once

#include <limits>
#include <vector>

#include "base/lists.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "hybrid/preparation.hpp"

namespace gearlash::hybrid {

struct Present {
  State state{};
  double time = 0.0;
  Vector noise{};  ///< uncertainty of each number by rounding, from the last step
  const PreparedMode* mode = nullptr;
  const PreparedFlow* flow = nullptr;  ///< of the step
  Velocity velocity{};                 ///< at the start of the step

  /// The mode to which a jump leads from the present numbers.
  std::size_t target_among(const std::vector<PreparedAlternative>& alternatives,
                           std::size_t otherwise) const {
    for (const PreparedAlternative& alternative : alternatives) {
      const bool is_taken = all_of(alternative.positive, [&](const SparseForm& form) {
        return form.at(state.numbers.data()) > 0.0;
      });
      if (is_taken) return alternative.target;
    }
    return otherwise;
  }

  /// By the velocity.
  bool is_standing() const {
    return all_of(velocity.values, [](double value) { return value == 0.0; });
  }
};

}  // namespace gearlash::hybrid
