// A map of searched drives beside as many verdicts of the same drives, each by itself.
#pragma once

#include "fastest_times.hpp"

namespace gearlash::benchmarks {

ReportPart enter_map_of_searched();

}  // namespace gearlash::benchmarks
