// The parts of an answer's report, and its numbers as text.
#pragma once

#include <cstddef>
#include <string>

#include "output/answer_report.hpp"

namespace gearlash {

/// Numbers with units: angles in the author's; times and what follows from them in units of 1/ω_n
/// without a natural frequency.
struct AnswerUnits {
  explicit AnswerUnits(const AnswerReport& report, int with_digits = 6)
      : angle_unit(report.drive.angle_unit),
        is_normalized(report.is_normalized),
        digits(with_digits) {}

  std::string number(double value) const { return significant(value, digits); }
  std::string angle(double radians) const { return angle_text(radians, angle_unit, digits); }
  /// "0.1 … 0.2 rad", or one number where the ends hardly differ.
  std::string angles(const Bounds& range) const;
  /// "±0.1 rad".
  std::string swing(double amplitude) const { return swing_text(amplitude, angle_unit, digits); }
  std::string time(double seconds) const { return time_text(seconds, is_normalized, digits); }
  std::string in(double value, const char* normalized, const char* otherwise) const {
    return number(value) + (is_normalized ? normalized : otherwise);
  }

  AngleUnit angle_unit;
  bool is_normalized;
  int digits;
};

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

/// Of angles, rounded down: "1.2 arcmin".
std::string lower_bound_text(double radians, const AnswerReport& report);
/// ", if its torque stays below the limit", where a ceiling needs that.
std::string below_limit_text(const Ceiling& ceiling);

/// How far a measured motion is from each that does not fade. Empty without a measurement.
std::string measured_text(const AnswerReport& report);

/// "1 start", "36 starts".
std::string starts_text(std::size_t count);

}  // namespace gearlash
