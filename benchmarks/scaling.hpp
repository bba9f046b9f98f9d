// How the speed of evaluate() grows with cores and lanes, and what axes cost.
#pragma once

#include "fastest_times.hpp"

namespace gearlash::benchmarks {

ReportPart enter_scaling();

}  // namespace gearlash::benchmarks
