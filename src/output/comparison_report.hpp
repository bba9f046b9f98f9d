// Drives side by side, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gearlash/comparison.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "question/axis.hpp"

namespace gearlash {

/// What a comparison shows if nothing else is asked for.
std::vector<Quantity> usual_quantities_compared();

/// "gearlash/compare/3": drives side by side.
struct ComparisonReport {
  std::vector<ComparedDrive> drives{};  ///< at least one
  /// What the table has; each answer has all.
  std::vector<Quantity> quantities = usual_quantities_compared();
  std::optional<Axis> axis{};  ///< of values of one parameter, one for each drive
  Provenance provenance{};     ///< how it was made
};

/// Whether no drive has a time scale: times are in 1/ω_n.
bool is_normalized(const ComparisonReport& report);
/// rad: the step that all make; empty where none was made.
std::optional<double> step_of(const ComparisonReport& report);

/// The drives with each value of an axis, named by it: "load", "12 arcmin".
std::vector<NamedDrive> named_along(const Axis& axis, const Drive& drive);

/// The headline of each drive, as limit-cycle has it, on a line of its own after the name.
std::string comparison_headlines(const ComparisonReport& report);

/// The headlines, a table with one column for each drive, and what else to know. Ends with a
/// newline.
std::string comparison_text(const ComparisonReport& report);

/// The report as JSON, in SI. Ends with a newline.
std::string comparison_json(const ComparisonReport& report);

}  // namespace gearlash
