// Pictures of reports: what an answer is made of, drives side by side, a production run.
#pragma once

#include <optional>
#include <string_view>

#include "gearlash/sensitivity.hpp"
#include "output/answer_report.hpp"
#include "output/comparison_report.hpp"
#include "output/tolerance_report.hpp"
#include "picture/plot.hpp"

namespace gearlash {

/// The terms of the load's ceiling, the largest on top. Precondition: there are terms.
Plot ceiling_plot(const AnswerReport& report);

/// The elasticities of the amplitude, or of growth at rest without a limit cycle, the longest on
/// top. Nothing if none is finite.
std::optional<Plot> tornado_plot(const Jacobian& sensitivity);

/// The load over time, one curve for each drive, until the last one stays or ends.
Plot comparison_plot(const ComparisonReport& report);

/// `kind`: "distribution", the share of samples over amplitude; "yield", that of samples with at
/// most an amplitude; or "indices", each parameter's share of the amplitude's variance. Throws
/// InvalidInput if no sample hunts, because then there is nothing to draw.
Plot tolerance_plot(const ToleranceReport& report, std::string_view kind);

}  // namespace gearlash
