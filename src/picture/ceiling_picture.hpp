// The terms of a ceiling as bars.
#pragma once

#include "output/answer_report.hpp"
#include "picture/bar_chart.hpp"

namespace gearlash {

/// The terms of the load's ceiling, the largest on top. Precondition: there are terms.
BarChart ceiling_bars(const AnswerReport& report);

}  // namespace gearlash
