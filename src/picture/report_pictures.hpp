// Pictures of reports: what an answer is made of, drives side by side, a production run.
#pragma once

#include "gearlash/picture.hpp"
#include "gearlash/sensitivity.hpp"
#include "output/answer_report.hpp"
#include "output/comparison_report.hpp"

namespace gearlash {

// They throw InvalidInput where there is nothing to draw.

/// The terms of the load's ceiling, the largest on top.
Plot ceiling_plot(const AnswerReport& report);

/// The elasticities of the amplitude, or of growth at rest without a limit cycle, the longest on
/// top.
Plot tornado_plot(const Jacobian& sensitivity);

/// The load over time, one curve for each drive, until the last one stays or ends.
Plot comparison_plot(const ComparisonReport& report);

/// The share of samples over amplitude; or, for PictureKind::yield, that of samples with at most an
/// amplitude.
Plot tolerance_plot(PictureKind kind, const ToleranceStudy& study, const AngleUnit& angle);

}  // namespace gearlash
