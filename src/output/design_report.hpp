// The answer to "what must change?", as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "gearlash/design.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "output/parameter_text.hpp"
#include "question/change/design.hpp"
#include "question/change/target.hpp"

namespace gearlash {

/// "gearlash/design/3": what must change so that a drive meets a target.
struct DesignReport {
  Drive drive{};              ///< its parameters
  std::string target_text{};  ///< as its author wrote it
  Target target{};            ///< what it asks for
  Design design{};            ///< the answer
  Provenance provenance{};    ///< how it was made

  [[nodiscard]] std::vector<ParameterFacts> parameters()
      const;  ///< of the design; their values of words are indices into the choices
};

/// A table with a line for every interval of values that meets the target, its side effects, what
/// happens at its ends, what is proved, and the reason why other parameters cannot meet it. Limits
/// are rounded to the side that meets the target. Ends with a newline.
std::string design_text(const DesignReport& report);

/// The report as JSON, in SI. Numbers read back exactly. Ends with a newline.
std::string design_json(const DesignReport& report);

}  // namespace gearlash
