// The ceiling in reports.
#pragma once

#include <string>

#include "output/answer_report.hpp"

namespace gearlash {

/// A table of the ceiling with its terms, or why there is none. Empty if it was not computed.
std::string ceiling_text(const AnswerReport& report);

/// The widest backlash that provably meets the specification, or why none does. Empty without one.
std::string specification_text(const AnswerReport& report);

}  // namespace gearlash
