// What an answer is made of, as bars: the terms of its ceiling, its sensitivities.
#pragma once

#include <optional>

#include "gearlash/sensitivity.hpp"
#include "output/answer_report.hpp"
#include "picture/plot.hpp"

namespace gearlash {

/// The terms of the load's ceiling, the largest on top. Precondition: there are terms.
Plot ceiling_plot(const AnswerReport& report);

/// The elasticities of the amplitude, or of growth at rest without a limit cycle, the longest on
/// top. Nothing if none is finite.
std::optional<Plot> tornado_plot(const Jacobian& sensitivity);

}  // namespace gearlash
