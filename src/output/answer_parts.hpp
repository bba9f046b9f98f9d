// The parts of an answer's report, and its numbers as text.
#pragma once

#include <cstddef>
#include <string>

#include "output/answer_report.hpp"

namespace gearlash {

/// Of tables of details.
inline constexpr int all_digits = 6;

/// rad; that of the normal form of a drive that has one.
double backlash_of(const Drive& drive, const Answer& answer);

/// The cycle that small displacements lead to, where a search has it; else the one seen in
/// practice. nullptr where the headline's motion is no cycle.
const Cycle* first_cycle(const Answer& answer);

/// Whether the load stands on the cycle.
bool is_of_motor_alone(const Cycle& cycle);

/// All tables of cycles, irregular motion, rest, ceiling, servo and gains.
std::string details_text(const AnswerReport& report);

/// The extent of a search in two lines, or what a closed form means.
std::string short_meaning_text(const AnswerReport& report);
/// What follows from the verdict and how certain it is; for a search also its extent.
std::string meaning_text(const AnswerReport& report);

/// A table of the ceiling with its terms, or why there is none. Empty if it was not computed.
std::string ceiling_text(const AnswerReport& report);

/// ", if its torque stays below the limit", where a ceiling needs that.
std::string below_limit_text(const Ceiling& ceiling);

/// How far a measured motion is from each that does not fade. Empty without a measurement.
std::string measured_text(const AnswerReport& report);

/// "1 start", "36 starts".
std::string starts_text(std::size_t count);

}  // namespace gearlash
