// The derivatives of a periodic orbit by one parameter of its system.
#pragma once

#include <optional>

#include "hybrid/periodic_orbit.hpp"
#include "hybrid/system_slopes.hpp"

namespace gearlash::hybrid {

/// ∂/∂parameter along the orbit, whose start is held on the plane across its motion.
struct OrbitSlopes {
  double period = 0.0;  ///< ∂T/∂parameter
  Vector start;         ///< ∂x/∂parameter
};

/// By the variational equations with saltation. With M the slope of the state after a period by its
/// start, w that by the parameter, and f the velocity at the start,
///   (M − 1) δ + f ∂T = −w,  f·δ = 0.
/// Numbers that nothing acts on (references, counts) are taken not to depend on the parameter.
/// Empty where a guard is met at no speed, the parameter changes the shape of a mode, a quantizer
/// acts, or the equations have no solution (a multiplier is 1). Precondition: no periodic clocks,
/// and nothing moves by itself.
std::optional<OrbitSlopes> orbit_slopes(const PreparedSystem& system, const PeriodicOrbit& orbit,
                                        const SystemSlopes& slopes);

/// ∂/∂parameter of a form's value at a fixed time after the orbit's start, or at one of its events,
/// wherever that moves. At a turn of the form it is that of its extreme.
double slope_of(const AffineForm& form, double time, const PreparedSystem& system,
                const PeriodicOrbit& orbit, const SystemSlopes& slopes, const OrbitSlopes& along);

}  // namespace gearlash::hybrid
