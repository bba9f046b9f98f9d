// Derivatives of cycles whose faces bounce, and of their growth at rest (0 < e ≤ 1).
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
  BouncingGradient size, period, multiplier;
};

/// The motion of the cycle is run again, event by event, with derivatives by the parameters p and
/// by the arrival x that it starts from (return_map.hpp); each event's time follows from the
/// condition that ends its phase. With F(x, p) the k-th arrival, dx/dp = (I − ∂F/∂x)⁻¹ ∂F/∂p; the
/// multiplier is an eigenvalue of ∂F/∂x, which is carried along likewise (disturbances.hpp), and
/// has no derivatives (NaN) where it is double. Nothing where the cycle cannot be run again.
/// Precondition: two masses, b > 0, e > 0; a cycle of analyse_limit_cycles(servo).
std::optional<BouncingSlopes> bouncing_slopes(const NormalizedServo& servo,
                                              const LimitCycle& cycle);

/// ∂ ln μ₀/∂p, likewise; nothing where bounces cannot be followed to their end.
std::optional<BouncingGradient> bouncing_log_growth_gradient(const NormalizedServo& servo);

}  // namespace gearlash
