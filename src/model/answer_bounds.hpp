// What is proved of the answers of all drives of a box.
#pragma once

#include <optional>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/quantity.hpp"

namespace gearlash {

struct QuantityBounds {
  Quantity quantity{};
  Bounds bounds{};  ///< SI; of a motion: of the drives that hunt
};

struct AnswerBounds {
  bool may_rest = true;      ///< some of the drives may always come to rest
  bool may_hunt = true;      ///< some may hunt
  bool may_run_away = true;  ///< some may run away
  std::vector<QuantityBounds> quantities{};

  /// Empty if nothing is proved of the quantity.
  std::optional<Bounds> of(Quantity quantity) const {
    for (const QuantityBounds& one : quantities) {
      if (one.quantity == quantity) return one.bounds;
    }
    return std::nullopt;
  }
};

}  // namespace gearlash
