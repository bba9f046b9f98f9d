// The sensitivities of the limit cycle as bars.
#pragma once

#include "gearlash/sensitivity.hpp"
#include "picture/bar_chart.hpp"

namespace gearlash {

/// The elasticities of the amplitude, or of growth at rest without a limit cycle, the longest on
/// top.
BarChart tornado_of(const Jacobian& sensitivity);

}  // namespace gearlash
