// What the limit cycle depends on, as bars.
#pragma once

#include "analysis/design/drive_sensitivity.hpp"
#include "picture/bar_chart.hpp"

namespace gearlash {

/// The elasticities of the amplitude, or without a limit cycle of growth at rest, the longest on
/// top.
BarChart tornado_of(const DriveSensitivity& sensitivity);

}  // namespace gearlash
