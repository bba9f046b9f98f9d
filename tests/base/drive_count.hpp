// How many random drives a property is tried on.
#pragma once

#include <cstdlib>

namespace gearlash::test {

/// GEARLASH_DRIVES=2000 asks for more (docs/explanation/verification.md).
inline int drive_count(int usual) {
  const char* asked = std::getenv("GEARLASH_DRIVES");
  return asked == nullptr ? usual : std::atoi(asked);
}

}  // namespace gearlash::test
