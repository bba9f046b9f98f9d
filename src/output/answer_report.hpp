// The one report of an answer: in text and in JSON, whichever engine answered.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "analysis/design/drive_sensitivity.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "gearlash/drive.hpp"
#include "input/units.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct AnswerReport {
  Drive drive{};
  Answer answer{};
  AngleUnit angle{};  ///< of text; JSON is in SI
  /// The normal form without a natural frequency: text has times in units of 1/ω_n.
  bool is_normalized = false;
  Provenance provenance{};
  /// On request: what margins and sensitivities are of.
  std::optional<ChangeableDrive> changeable{};
  std::optional<HuntingMargin> margin{};
  std::optional<DriveSensitivity> sensitivity{};
};

/// A report without margins and sensitivities.
AnswerReport report_of(const Drive& drive, const Answer& answer, const AngleUnit& angle,
                       const Provenance& provenance);
/// In radians, and made by this version.
AnswerReport report_of(const Drive& drive, const Answer& answer);

/// Whether the motor swings within the gap while the load stands.
bool is_of_motor_alone(const Cycle& cycle);

/// The answer in one line, numbers and all: "hunts: ±0.0819 rad (4.69°) at 2.26 Hz", "cannot hunt:
/// growth at rest 0.43 < 1".
std::string headline(const AnswerReport& report);

/// The headline, every cycle, rest and irregular motion with their numbers, what the drive is, and
/// what the answer means. Ends with a newline.
std::string answer_text(const AnswerReport& report);

/// The contract of docs/command-line.md ("gearlash/limit-cycle/2"), in SI. Ends with a newline.
std::string answer_json(const AnswerReport& report);

/// One of its cycles.
nlohmann::ordered_json json_cycle(const Cycle& cycle);

}  // namespace gearlash
