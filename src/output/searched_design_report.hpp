// The answer to "what must change?" for drives that are searched, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "analysis/design/drive_with_value.hpp"
#include "gearlash/design.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct SearchedParameter {
  FeasibleValues values{};
  std::vector<DriveWithValue> results{};  ///< with the values of nearest_of_each()
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
