// What a change of a drive's numbers does to its limit cycle: margins to hunting and sensitivities.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/design/drive_sensitivity.hpp"
#include "gearlash/design.hpp"
#include "output/report_units.hpp"

namespace gearlash {

/// A table of how far each parameter may go until hunting stops, or starts, and the least change of
/// all together.
std::string margin_text(const ChangeableDrive& drive, const HuntingMargin& margin,
                        const AngleUnit& angle);
/// Elasticities, the largest first; or why there are none, in a line.
std::string sensitivity_text(const DriveSensitivity& sensitivity);

nlohmann::ordered_json margin_json(const ChangeableDrive& drive, const HuntingMargin& margin);
nlohmann::ordered_json sensitivity_json(const DriveSensitivity& sensitivity);

/// That by which effects are compared: the amplitude, or without a limit cycle growth at rest.
Quantity quantity_of_effect(const DriveSensitivity& sensitivity);
/// Of one of the Jacobian's quantities by its parameter of that index.
std::optional<double> elasticity_of(const DriveSensitivity& sensitivity, Quantity quantity,
                                    std::size_t parameter);
/// The parameters of the Jacobian by their effect, the largest first.
std::vector<std::size_t> by_falling_effect(const DriveSensitivity& sensitivity);

}  // namespace gearlash
