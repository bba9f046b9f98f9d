// The answer to "what must change?", as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "gearlash/design.hpp"
#include "output/report_units.hpp"
#include "question/change/design.hpp"
#include "question/change/target.hpp"

namespace gearlash {

struct DesignReport {
  Drive drive{};
  std::string target_text{};  ///< as its author wrote it
  Target target{};
  Design design{};
  AngleUnit angle{};  ///< of text
  Provenance provenance{};
};

/// A table with a line for every interval of values that meets the target, its side effects, what
/// happens at its ends, what is proved, and the reason why other parameters cannot meet it. Limits
/// are rounded to the side that meets the target. Ends with a newline.
std::string design_text(const DesignReport& report);

/// "gearlash/design/2" (docs/schemas), in SI. Numbers read back exactly. Ends with a newline.
std::string design_json(const DesignReport& report);

}  // namespace gearlash
