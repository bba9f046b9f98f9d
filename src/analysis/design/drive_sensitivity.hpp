// How the limit cycle of a drive changes with each number that its designer can choose: exact
// derivatives and elasticities.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "analysis/design/changeable_drive.hpp"
#include "closed_form/cycle_sensitivity.hpp"
#include "model/datasheet.hpp"

namespace gearlash {

enum class CycleMeasure {
  size,           ///< rad at the load's shaft, half peak-to-peak
  period,         ///< s
  frequency,      ///< Hz
  multiplier,     ///< Floquet's, over a period
  growth_at_rest  ///< μ₀
};
inline constexpr std::size_t cycle_measure_count = 5;
inline constexpr std::array<CycleMeasure, cycle_measure_count> all_cycle_measures = {
    CycleMeasure::size, CycleMeasure::period, CycleMeasure::frequency, CycleMeasure::multiplier,
    CycleMeasure::growth_at_rest};

/// "size", "period", …, "growth_at_rest".
const char* name_of(CycleMeasure quantity);

/// One of something for each quantity.
template <class Value>
struct ByCycleMeasure {
  std::array<Value, cycle_measure_count> values{};

  Value& operator[](CycleMeasure quantity) { return values[static_cast<std::size_t>(quantity)]; }
  const Value& operator[](CycleMeasure quantity) const {
    return values[static_cast<std::size_t>(quantity)];
  }
};

/// By the numbers of a drivetrain. Numbers that do not exist (outcome) are NaN.
struct DrivetrainSensitivity {
  SensitivityOutcome outcome = SensitivityOutcome::no_cycle;
  ByCycleMeasure<double> values;
  ByCycleMeasure<DrivetrainSlopes> slopes;
};

/// cycle_sensitivity() of the normalised servo and, by the chain rule, with J = J_M + J_L,
/// F = F_M + F_L,
///   ζ = F/(2√(KJ)),  r = J_L/J_M,  φ = F_L/F,  ω_n = √(K/J);  a period lasts 1/ω_n of its number.
/// Throws InvalidInput.
DrivetrainSensitivity drivetrain_sensitivity(const Drivetrain& drive);

/// Growth at rest alone, by the numbers of a drivetrain: growth_sensitivity(). Throws InvalidInput.
struct DrivetrainGrowth {
  double value = std::numeric_limits<double>::quiet_NaN();
  DrivetrainSlopes slopes;
};
DrivetrainGrowth drivetrain_growth(const Drivetrain& drive);

/// By one number p of the drive, of a quantity q.
struct Sensitivity {
  double slope = std::numeric_limits<double>::quiet_NaN();  ///< ∂q/∂p, SI units
  double elasticity = std::numeric_limits<double>::quiet_NaN();  ///< ∂ ln q/∂ ln p = (p/q) ∂q/∂p:
                                                                 ///< per cent for one per cent; 0
                                                                 ///< where p = 0
};

struct ParameterSensitivity {
  std::string name;      ///< "gear_ratio", or of a data sheet's numbers "gearbox.ratio"
  double present = 0.0;  ///< p, in SI units or as a share (ChangeableDrive)
  ByCycleMeasure<Sensitivity> of;
};

struct DriveSensitivity {
  SensitivityOutcome outcome = SensitivityOutcome::no_cycle;
  ByCycleMeasure<double> values;
  std::vector<ParameterSensitivity> parameters;

  /// nullptr if there is none of that name.
  const ParameterSensitivity* find(const std::string& name) const;
};

/// By every DesignParameter, in the order of all_parameters, named by name_of(DesignParameter).
DriveSensitivity drive_sensitivity(const ChangeableDrive& drive);

/// By every number of the data sheet, all others as they are, named as the file names them:
/// "motor.inertia", "motor.resistance", …, "gearbox.ratio", "contact.restitution". Throws
/// InvalidInput.
DriveSensitivity datasheet_sensitivity(const Datasheet& datasheet);

}  // namespace gearlash
