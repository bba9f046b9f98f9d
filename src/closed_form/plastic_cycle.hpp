// The one symmetric limit cycle of a servo with plastic contact, with its properties.
#pragma once

#include "closed_form/limit_cycle.hpp"
#include "closed_form/unit_half_cycle.hpp"

namespace gearlash {

/// The symmetric cycle of a balanced half cycle, with all its properties; its amplitude is
/// b / |u(t₂) − u(0)| of the unit flight. Half-map slope, whose square is the multiplier:
/// R′ = 1 − |Δu| (J_M y + F_M P)/Q(y, P). Precondition: b > 0.
LimitCycle plastic_cycle(const ServoDynamics& dynamics, const UnitHalfCycle& balanced);

}  // namespace gearlash
