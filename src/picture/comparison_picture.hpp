// The step responses of drives side by side.
#pragma once

#include "output/comparison_report.hpp"
#include "picture/plot.hpp"

namespace gearlash {

/// The load over time, one curve for each drive, until the last one stays or ends.
Plot comparison_plot(const ComparisonReport& report);

}  // namespace gearlash
