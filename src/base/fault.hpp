// Throws collected faults as one InvalidInput.
#pragma once

#include <utility>
#include <vector>

#include "gearlash/fault.hpp"

namespace gearlash {

/// Throws InvalidInput when there is at least one fault.
void require_none(std::vector<Fault> faults);
/// The same with the faults of several things together.
template <class... Lists>
void require_none(std::vector<Fault> faults, const std::vector<Fault>& more,
                  const Lists&... others) {
  faults.insert(faults.end(), more.begin(), more.end());
  require_none(std::move(faults), others...);
}

}  // namespace gearlash
