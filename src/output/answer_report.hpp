// The report of an answer, as text and as JSON, for both engines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/sensitivity.hpp"
#include "input/units.hpp"
#include "output/report_units.hpp"

namespace gearlash {

/// Hunting as a user saw it.
struct MeasuredHunting {
  double amplitude = 0.0;  ///< rad, half the peak-to-peak of the load
  double frequency = 0.0;  ///< Hz
};

struct AnswerReport {
  Drive drive{};
  Answer answer{};
  AngleUnit angle{};  ///< of text; JSON is in SI
  /// The normal form without a natural frequency: text has times in units of 1/ω_n.
  bool is_normalized = false;
  Provenance provenance{};
  std::optional<HuntingMargin> margin{};  ///< on request, as is `sensitivity`
  std::optional<Jacobian> sensitivity{};
  /// rad: an amplitude of the load for which the widest backlash is to be stated that provably
  /// keeps it. Needs the ceiling.
  std::optional<double> specification{};
  std::optional<MeasuredHunting> measured{};  ///< to be compared with every motion found
};

/// A report without margins and sensitivities.
AnswerReport report_of(const Drive& drive, const Answer& answer, const AngleUnit& angle,
                       const Provenance& provenance);
/// The same in radians, made by this version.
AnswerReport report_of(const Drive& drive, const Answer& answer);

/// Whether the motor swings within the gap and the load stands still.
bool is_of_motor_alone(const Cycle& cycle);

/// The answer in one line with its numbers: "hunts: ±0.0819 rad (4.69°) at 2.26 Hz", "cannot hunt:
/// growth at rest 0.43 < 1".
std::string headline(const AnswerReport& report);

/// The headline; every cycle, rest and irregular motion with its numbers; the drive; and the
/// meaning of the answer. Ends with a newline.
std::string answer_text(const AnswerReport& report);

/// "gearlash/limit-cycle/2", specified in docs/reference/command-line.md, in SI. Ends with a
/// newline.
std::string answer_json(const AnswerReport& report);

/// One cycle of the report, and one irregular motion.
nlohmann::ordered_json json_cycle(const Cycle& cycle);
nlohmann::ordered_json json_irregular(const IrregularMotion& motion);

}  // namespace gearlash
