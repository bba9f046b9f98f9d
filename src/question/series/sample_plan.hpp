// The faults of a plan to draw samples.
#pragma once

#include "gearlash/tolerance.hpp"

namespace gearlash {

/// Every fault of a plan's ranges, and of more than SamplePlan::most_samples.
std::vector<Fault> faults(const SamplePlan& sampling);

}  // namespace gearlash
