// The meaning of an answer, in sentences.
#pragma once

#include <string>

#include "output/answer_report.hpp"

namespace gearlash {

/// What follows from the verdict and how certain it is; for a search also its extent.
std::string meaning_text(const AnswerReport& report);

/// "1 start", "36 starts".
std::string starts_text(std::size_t count);

}  // namespace gearlash
