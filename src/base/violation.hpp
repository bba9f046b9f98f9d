// Violations, and what is done with several of them.
#pragma once

#include "gearlash/fault.hpp"

namespace gearlash {

/// Throws InvalidInput when there is at least one violation.
void require_none(std::vector<Violation> violations);

}  // namespace gearlash
