// Seeded draws whose seed stands beside each failure.
#pragma once

#include <gtest/gtest.h>

#include "base/seeded_draws.hpp"

namespace gearlash {

class TracedDraws : public SeededDraws {
 public:
  /// The place is that of the caller.
  explicit TracedDraws(std::uint64_t seed, const char* file = __builtin_FILE(),
                       int line = __builtin_LINE())
      : SeededDraws(seed), trace_(file, line, testing::Message() << "seed " << seed) {}

 private:
  testing::ScopedTrace trace_;
};

}  // namespace gearlash
