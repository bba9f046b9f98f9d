// What a change of a drive's numbers does to its limit cycle: margins to hunting and sensitivities.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/design/drive_sensitivity.hpp"
#include "analysis/design/hunting_margin.hpp"
#include "output/report_units.hpp"
#include "picture/bar_chart.hpp"

namespace gearlash {

/// A table of how far each parameter may go until hunting stops, or starts, and the least change of
/// all together.
std::string margin_text(const ChangeableDrive& drive, const HuntingMargin& margin,
                        const ReportUnits& units);
/// Elasticities, the largest of the size first; or why there are none, in a line.
std::string sensitivity_text(const DriveSensitivity& sensitivity);

nlohmann::ordered_json margin_json(const ChangeableDrive& drive, const HuntingMargin& margin);
nlohmann::ordered_json sensitivity_json(const DriveSensitivity& sensitivity);

/// The elasticities of the size as bars, the longest on top.
BarChart tornado_of(const DriveSensitivity& sensitivity);

}  // namespace gearlash
