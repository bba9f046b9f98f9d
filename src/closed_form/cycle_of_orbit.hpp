// Everything that is reported of a limit cycle with bounces, from the arrival that comes back.
#pragma once

#include <optional>

#include "closed_form/limit_cycle.hpp"
#include "closed_form/return_orbits.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Follows the cycle once round for its amplitudes, times and energies; the multiplier is that of
/// the return map's derivative. Precondition: `dynamics` are those of `servo`.
LimitCycle cycle_of_orbit(const NormalizedServo& servo, const ServoDynamics& dynamics,
                          const ReturnOrbit& orbit);

/// The cycle with bounces next to that of a servo that differs slightly, by Newton's method; empty
/// if that does not converge, or if the cycle has another number of impacts.
std::optional<LimitCycle> bouncing_cycle_beside(const NormalizedServo& servo,
                                                const LimitCycle& near,
                                                const NormalizedServo& servo_near);

}  // namespace gearlash
