// What a drive ends in, for a person and for a program.
#pragma once

#include <string>

#include "analysis/drive_verdict.hpp"
#include "general/attractors/attractors.hpp"
#include "input/drive_file.hpp"
#include "output/report_units.hpp"
#include "picture/picture.hpp"

namespace gearlash {

struct AttractorReport {
  DriveFile file;
  drive::AttractorSearch search;
  Provenance provenance = {};
};

/// "hunts: ±0.0814 rad (4.67°) at 2.25 Hz", "comes to rest from all 40 starts".
std::string verdict_line(const AttractorReport& report);

/// verdict_line, every cycle, rest and irregular motion with its measures, and what was searched.
/// Ends with a newline.
std::string attractor_text(const AttractorReport& report);

/// As docs/command-line.md lays down; cycles have the keys that those of servos have.
std::string attractor_json(const AttractorReport& report);

/// The cycles in the phase plane, load and motor.
std::string draw_attractor(const AttractorReport& report, PictureFormat format);

}  // namespace gearlash
