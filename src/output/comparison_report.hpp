// One drive with its sensor before and after the gap, side by side.
#pragma once

#include <optional>
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

/// How a report is written: the unit of its angles, and what made it.
struct ReportStyle {
  AngleUnit angle{};
  Provenance provenance{};
};

/// The drive with its sensor at each of these places; an encoder keeps its counts per turn on
/// either shaft. Throws InvalidInput where no place is named. Precondition: a sound drive.
ComparisonReport compare_sensors(const Drive& drive, const std::vector<SensorPlace>& places,
                                 const drive::Step& step, const ReportStyle& style,
                                 Progress& progress = no_progress());

/// The step to compare: usual_step(), in size and duration as far as they are not given. Throws
/// InvalidInput, naming the fields, for a size of 0 and a duration that is not positive.
struct StepFields {
  const char* size = "step";
  const char* until = "until";
};
drive::Step step_of_comparison(const Drive& drive, std::optional<double> size,
                               std::optional<double> until, const StepFields& fields = {});

/// One column for each case: hunting, static error at the load, step response. Ends with a newline.
std::string comparison_text(const ComparisonReport& report);

/// The JSON that docs/reference/command-line.md specifies.
std::string comparison_json(const ComparisonReport& report);

}  // namespace gearlash
