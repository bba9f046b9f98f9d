// How fast the batch could be at best: what it has to evaluate for a servo, at the speed at which
// this machine's vector units evaluate it, beside what it takes.
#pragma once

#include "fastest_times.hpp"

namespace gearlash::benchmarks {

/// Uses the times of the grid race and of the kernel alone, which are entered as well.
ReportPart enter_floor();

}  // namespace gearlash::benchmarks
