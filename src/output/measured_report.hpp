// How far the hunting that a user measured is from each motion found.
#pragma once

#include <string>

#include "output/answer_report.hpp"

namespace gearlash {

/// A line for each motion that does not fade, and what follows. Empty without a measurement.
std::string measured_text(const AnswerReport& report);

}  // namespace gearlash
