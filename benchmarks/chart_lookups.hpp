// Charts for programs: how well they interpolate, and how long building and looking up take.
#pragma once

#include "fastest_times.hpp"

namespace gearlash::benchmarks {

ReportPart enter_chart_lookups();

}  // namespace gearlash::benchmarks
