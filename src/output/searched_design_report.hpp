// The answer to "what must change?" for drives that are searched, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/linear_loop.hpp"
#include "analysis/step_response.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "output/report_units.hpp"

namespace gearlash {

/// What a drive does with one value of a parameter.
struct DriveWithValue {
  double value = 0.0;
  Answer answer{};
  drive::StepResponse response{};
  std::optional<drive::LoopFigures> loop{};  ///< empty for a relay
};

struct SearchedParameter {
  FeasibleValues values{};
  /// With the value of each interval that is nearest to the present one; without intervals, with
  /// the closest value.
  std::vector<DriveWithValue> results{};
};

struct SearchedDesignReport {
  Drive drive{};
  std::string target_text{};  ///< as its author wrote it
  Target target{};
  DriveWithValue present{};  ///< its value is none
  std::vector<SearchedParameter> parameters{};
  AngleUnit angle{};  ///< of text
  Provenance provenance{};
};

/// As design_text() and design_json().
std::string design_text(const SearchedDesignReport& report);
std::string design_json(const SearchedDesignReport& report);

}  // namespace gearlash
