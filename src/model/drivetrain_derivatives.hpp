// Exact derivatives of the numbers of a drivetrain by each number of its drive.
#pragma once

#include <optional>
#include <string_view>

#include "gearlash/drive.hpp"

namespace gearlash {

/// One derivative for each number of a Drivetrain, of it or by it.
struct DrivetrainSlopes {
  double motor_inertia = 0.0;
  double load_inertia = 0.0;
  double motor_friction = 0.0;
  double load_friction = 0.0;
  double stiffness = 0.0;
  double backlash = 0.0;
  double restitution = 0.0;
};

/// ∂/∂(the parameter) of proportional_drivetrain(drive), by the formulas
///   J_M = (J + J_G) n²,  F_M = (f + E) n² + S d,  K = S g,  S = T n, 1 with gains at the joint, or
///   T n² with gains per motor angle,
/// E the winding's friction (K₁K₂/R, 0, K_N, 0), more by T times the feedback of the motor's speed,
/// and T the torque per output at the motor's shaft (K₁/R, K₁/R, K_e, 1), g and d the controller's
/// output per error and per speed; or of the normal form,
///   J_M = 1/(1 + r), J_L = 1 − J_M, F_M = 2ζω_n(1 − φ), F_L = 2ζω_nφ, K = ω_n².
/// Of a normal form also ∂/∂(a parameter of its physical_form()).
/// Empty for a parameter of which the drivetrain is no function: one that the drive does not have,
/// one whose change would end its closed form, or an inertia of the gears that is 0 as by default.
/// Precondition: the drive has a closed form.
std::optional<DrivetrainSlopes> drivetrain_slopes(const Drive& drive, std::string_view path);

}  // namespace gearlash
