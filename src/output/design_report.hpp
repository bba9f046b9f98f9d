// The answer to "what must change?", as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "analysis/design/changeable_drive.hpp"
#include "gearlash/design.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct DesignReport {
  ChangeableDrive drive;
  std::string target_text;  ///< as its author wrote it
  Target target;
  std::vector<FeasibleValues> answers;  ///< one for each requested parameter
  AngleUnit angle = {};                 ///< of text
  bool is_normalized = false;           ///< text then has no frequencies
  Provenance provenance = {};
};

/// A table with a line for every interval of values that meets the target, its side effects, and
/// the reason why other parameters cannot meet it. Limits are rounded to the side that meets the
/// target. Ends with a newline.
std::string design_text(const DesignReport& report);

/// "gearlash/design/2" (docs/schemas), in SI. Numbers read back exactly. Ends with a newline.
std::string design_json(const DesignReport& report);

}  // namespace gearlash
