// Seeded draws whose seed stands beside each failure.
#pragma once

#include <gtest/gtest.h>

#include "base/seeded_draws.hpp"

namespace gearlash {

class TracedDraws : public SeededDraws {
 public:
  explicit TracedDraws(std::uint64_t seed)
      : SeededDraws(seed), trace_(__FILE__, __LINE__, testing::Message() << "seed " << seed) {}

 private:
  testing::ScopedTrace trace_;
};

}  // namespace gearlash
