// One drive with its sensor before and after the gap, side by side.
#pragma once

#include <string>
#include <vector>

#include "analysis/step_response.hpp"
#include "model/reduced_drive.hpp"
#include "output/answer_report.hpp"

namespace gearlash {

struct SensorCase {
  SensorPlace place = SensorPlace::load;
  AnswerReport report{};
  StepResponse response;
};

struct ComparisonReport {
  std::vector<SensorCase> cases;  ///< at least one
  Provenance provenance = {};
};

/// One column for each case: hunting, static error at the load, step response. Ends with a newline.
std::string comparison_text(const ComparisonReport& report);

/// The JSON that docs/reference/command-line.md specifies.
std::string comparison_json(const ComparisonReport& report);

}  // namespace gearlash
