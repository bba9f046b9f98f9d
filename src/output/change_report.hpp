// The effect of a change of a drive's numbers on its limit cycle: margins to hunting,
// sensitivities.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gearlash/design.hpp"
#include "gearlash/sensitivity.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

/// A table of each parameter's change until hunting stops or starts, the smallest combined change,
/// and what a search leaves open.
std::string margin_text(const Drive& drive, const HuntingMargin& margin);
/// Elasticities, the largest first; or one line that says why there are none.
std::string sensitivity_text(const Jacobian& sensitivity);

/// The quantity by which effects are compared: the amplitude, or growth at rest without a limit
/// cycle.
Quantity quantity_of_effect(const Jacobian& sensitivity);
/// The elasticity of a quantity with respect to the parameter of that index; empty if the Jacobian
/// has no such quantity.
std::optional<double> elasticity_of(const Jacobian& sensitivity, Quantity quantity,
                                    std::size_t parameter);
/// The parameters of the Jacobian ordered by effect, the largest first.
std::vector<std::size_t> by_falling_effect(const Jacobian& sensitivity);

}  // namespace gearlash
