// Throws collected faults as one InvalidInput.
#pragma once

#include "gearlash/fault.hpp"

namespace gearlash {

/// Throws InvalidInput when there is at least one fault.
void require_none(std::vector<Fault> faults);

}  // namespace gearlash
