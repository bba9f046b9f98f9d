// How far the hunting that a user measured is from each motion found.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "output/answer_report.hpp"

namespace gearlash {

/// A line for each motion that does not fade, and what follows. Empty without a measurement.
std::string measured_text(const AnswerReport& report);

/// The measurement, and the shares by which it exceeds each motion; null without one.
nlohmann::ordered_json measured_json(const AnswerReport& report);

}  // namespace gearlash
