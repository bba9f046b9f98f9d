// The derivatives of a limit cycle by the numbers of its drivetrain, and of its drive.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "analysis/design/changeable_drive.hpp"
#include "closed_form/cycle_sensitivity.hpp"
#include "gearlash/sensitivity.hpp"

namespace gearlash {

/// What has derivatives.
inline constexpr std::array differentiable = {Quantity::amplitude, Quantity::period,
                                              Quantity::frequency, Quantity::multiplier,
                                              Quantity::growth_at_rest};

/// One quantity, in SI, and its derivatives by the numbers of a drivetrain.
struct QuantitySlopes {
  Quantity quantity{};
  double value = 0.0;
  DrivetrainSlopes slopes{};
};

struct DrivetrainSensitivity {
  SensitivityOutcome outcome = SensitivityOutcome::no_cycle;
  std::vector<QuantitySlopes> quantities{};  ///< those that exist

  /// nullptr: it does not exist.
  const QuantitySlopes* find(Quantity quantity) const;
};

/// cycle_sensitivity() of the normalised servo and, by the chain rule, with J = J_M + J_L,
/// F = F_M + F_L,
///   ζ = F/(2√(KJ)),  r = J_L/J_M,  φ = F_L/F,  ω_n = √(K/J);  a period lasts 1/ω_n of its number.
/// Throws InvalidInput.
DrivetrainSensitivity drivetrain_sensitivity(const Drivetrain& drive);

/// Growth at rest alone, by the numbers of a drivetrain: growth_sensitivity(). Throws InvalidInput.
QuantitySlopes drivetrain_growth(const Drivetrain& drive);

struct DriveSensitivity {
  SensitivityOutcome outcome = SensitivityOutcome::no_cycle;
  Jacobian jacobian{};  ///< by quantities of `differentiable`, all of them as a rule
};

/// Of all quantities by the numbers of these names. Throws InvalidInput where there is none of a
/// name.
DriveSensitivity drive_sensitivity(const ChangeableDrive& drive,
                                   const std::vector<std::string>& names);

/// By every parameter that the closed form is a function of; of a normal form by what a design
/// looks at.
DriveSensitivity drive_sensitivity(const ChangeableDrive& drive);

}  // namespace gearlash
