// The limits of a plan to draw samples.
#pragma once

#include "gearlash/tolerance.hpp"

namespace gearlash {

inline constexpr std::size_t most_samples = 100'000'000;  // 1.6 GB

/// Every fault of a plan's ranges, and of more than most_samples.
std::vector<Fault> validate(const SamplePlan& sampling);

}  // namespace gearlash
