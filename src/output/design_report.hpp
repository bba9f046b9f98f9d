// The answer to "what must change?", for a person and for a program.
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
  std::vector<FeasibleValues> answers;  ///< of the parameters asked for
  AngleUnit angle = {};                 ///< of text
  bool is_normalized = false;           ///< text then has no frequencies
  Provenance provenance = {};
};

/// A table with a line for every interval of values that meets the target, what it changes besides,
/// and why others cannot. Limits are rounded towards the side that meets it. Ends with a newline.
std::string design_text(const DesignReport& report);

/// "gearlash/design/2" (docs/schemas), in SI, ending with a newline; numbers read back exactly.
std::string design_json(const DesignReport& report);

}  // namespace gearlash
