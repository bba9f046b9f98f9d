// What a production run will do, for a person and for a program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/design/worst_corner.hpp"
#include "gearlash/tolerance.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct ToleranceReport {
  TolerancedDrive drive;
  std::string target_text;  ///< as its author wrote it; empty where there was none
  double demanded_yield = 0.0;
  ToleranceStudy study = {};
  SensitivityStudy sensitivities = {};
  WorstCorner worst = {};
  std::optional<WidestBacklash> backlash = {};  ///< where a yield was demanded and can be had
  AngleUnit angle = {};                         ///< of text
  Provenance provenance = {};
};

/// Probabilities with their error bars, quantiles, what decides, and the worst sample. Ends with a
/// newline.
std::string tolerance_text(const ToleranceReport& report);

/// "gearlash/tolerance/2" (docs/schemas), in SI, ending with a newline; numbers read back exactly.
std::string tolerance_json(const ToleranceReport& report);

}  // namespace gearlash
