// What must change: how fast designs, sensitivities and tolerances are worked out.
#pragma once

#include "fastest_times.hpp"

namespace gearlash::benchmarks {

/// Of the thesis's sample problem: a study of ten million toleranced pieces on all cores, of which
/// single calls of analyse_limit_cycles() are the yardstick; certified searches over one parameter;
/// margins; and sensitivities.
ReportPart enter_design_race();

}  // namespace gearlash::benchmarks
