// Derivatives of bouncing cycles and of their growth at rest (0 < e ≤ 1).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "closed_form/limit_cycle.hpp"
#include "closed_form/servo_dynamics.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// By damping, the load's share of the inertia, friction ratio and restitution.
using BouncingGradient = Eigen::Vector4d;

struct BouncingSlopes {
  BouncingGradient amplitude, period, multiplier;
};

/// The motion of the cycle is repeated event by event, with derivatives by the parameters p and by
/// its starting arrival x (return_map.hpp). The condition that ends a phase determines each event's
/// time. With F(x, p) the k-th arrival, dx/dp = (I − ∂F/∂x)⁻¹ ∂F/∂p. The multiplier is an
/// eigenvalue of ∂F/∂x, which is carried along likewise (disturbances.hpp). It has no derivatives
/// (NaN) if it is double. Empty if the cycle cannot be repeated. Precondition: two masses, b > 0, e
/// > 0; a cycle of analyse_limit_cycles(servo).
std::optional<BouncingSlopes> bouncing_slopes(const NormalizedServo& servo,
                                              const LimitCycle& cycle);

/// ∂ ln μ₀/∂p, likewise. Empty if the bounces cannot be followed to their end.
std::optional<BouncingGradient> bouncing_log_growth_gradient(const NormalizedServo& servo);

}  // namespace gearlash
