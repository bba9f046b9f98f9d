// The derivatives of a limit cycle with respect to the parameters of its drivetrain and its drive.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "closed_form/cycle_derivatives.hpp"
#include "gearlash/sensitivity.hpp"
#include "model/drivetrain.hpp"
#include "model/drivetrain_derivatives.hpp"

namespace gearlash {

/// The quantities that have derivatives.
inline constexpr std::array differentiable = {Quantity::amplitude, Quantity::period,
                                              Quantity::frequency, Quantity::multiplier,
                                              Quantity::growth_at_rest};

/// One quantity, in SI, and its derivatives with respect to the parameters of a drivetrain.
struct QuantitySlopes {
  Quantity quantity{};
  double value = 0.0;
  DrivetrainSlopes slopes{};
};

struct DrivetrainSensitivity {
  SensitivityOutcome outcome = SensitivityOutcome::no_cycle;
  std::vector<QuantitySlopes> quantities{};  ///< only those that exist

  /// nullptr if the quantity does not exist.
  const QuantitySlopes* find(Quantity quantity) const;
};

/// cycle_sensitivity() of the normalized servo, carried to the drivetrain by the chain rule.
/// Periods are in units of 1/ω_n. With J = J_M + J_L and F = F_M + F_L,
///   ζ = F/(2√(KJ)),  r = J_L/J_M,  φ = F_L/F,  ω_n = √(K/J).
/// Throws InvalidInput.
DrivetrainSensitivity drivetrain_sensitivity(const Drivetrain& drive);

/// Growth at rest alone, with its derivatives: growth_sensitivity(). Throws InvalidInput.
QuantitySlopes drivetrain_growth(const Drivetrain& drive);

/// Derivatives of all quantities with respect to the named numbers. Precondition: a closed form.
/// Throws InvalidInput for a number that does not enter it.
Jacobian drive_sensitivity(const Drive& drive, const std::vector<std::string>& names);

/// Derivatives with respect to every parameter that enters the closed form; for a normal form, with
/// respect to usual_parameters(). Precondition: a closed form.
Jacobian drive_sensitivity(const Drive& drive);

}  // namespace gearlash
