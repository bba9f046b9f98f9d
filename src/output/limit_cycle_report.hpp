// The answer to "does it hunt?", for a person and for a program.
#pragma once

#include <optional>
#include <string>

#include "analysis/design/drive_sensitivity.hpp"
#include "analysis/design/hunting_margin.hpp"
#include "closed_form/limit_cycle.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct LimitCycleReport {
  NormalizedServo servo = {};
  LimitCycleAnalysis analysis = {};
  ReportUnits units = {};
  Provenance provenance = {};
  bool is_drive = false;  ///< described as a drive, whose closed form this is
  /// What its margins and sensitivities are told of; nothing where they are not asked for.
  std::optional<ChangeableDrive> drive = std::nullopt;
  std::optional<HuntingMargin> margin = std::nullopt;
  std::optional<DriveSensitivity> sensitivity = std::nullopt;
};

/// The verdict in one line, numbers and all: "hunts: ±0.0814 rad (4.67°) at 2.25 Hz", "cannot hunt:
/// growth at rest 0.43 < 1". Without a natural frequency the period is told: "period 6.456 / ω_n".
std::string verdict_line(const LimitCycleReport& report);

/// verdict_line, a table of every property, and what it means for the servo. Ends with a newline.
std::string limit_cycle_text(const LimitCycleReport& report);

/// The contract of docs/command-line.md, ending with a newline. Numbers read back exactly; JSON has
/// no infinity and no NaN: the first is the text "inf", the second (not computed) null.
std::string limit_cycle_json(const LimitCycleReport& report);

}  // namespace gearlash
