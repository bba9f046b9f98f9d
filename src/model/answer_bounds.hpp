// What is proved of the answers of all drives of a box.
#pragma once

#include <map>
#include <optional>

#include "gearlash/bounds.hpp"
#include "gearlash/quantity.hpp"

namespace gearlash {

struct AnswerBounds {
  bool may_rest = true;                     ///< some of the drives may always come to rest
  bool may_hunt = true;                     ///< some may hunt
  bool may_run_away = true;                 ///< some may run away
  std::map<Quantity, Bounds> quantities{};  ///< SI; of a motion: of the drives that hunt

  /// Empty if nothing is proved of the quantity.
  std::optional<Bounds> of(Quantity quantity) const {
    const auto found = quantities.find(quantity);
    return found == quantities.end() ? std::nullopt : std::optional(found->second);
  }
};

}  // namespace gearlash
