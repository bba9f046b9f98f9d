// A drive of which single parameters are changed, as a designer changes them: in iron.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "closed_form/cycle_bounds.hpp"
#include "model/datasheet.hpp"

namespace gearlash {

/// What a designer may change by itself, all else being as it is. Of a data sheet they are its own
/// numbers; of a normalised servo shares of what it has at present: of all inertia, of the critical
/// friction 2ω_n(J_M + J_L), of the gear ratio and of the gain.
enum class DesignParameter {
  backlash,        ///< b
  gear_ratio,      ///< n: J_M and F_M go as n², K as n; b stays, being that of the load's shaft
  error_gain,      ///< K₃: K goes with it
  load_friction,   ///< F_L
  motor_friction,  ///< f_m at the motor's shaft; of a normalised servo all of F_M
  tachometer,      ///< added volts per speed of the motor's shaft, fed back: more F_M
  load_inertia,    ///< J_L
  motor_inertia,   ///< J_m at the motor's shaft
  restitution      ///< e
};
inline constexpr std::size_t parameter_count = 9;
inline constexpr std::array<DesignParameter, parameter_count> all_parameters = {
    DesignParameter::backlash,      DesignParameter::gear_ratio,     DesignParameter::error_gain,
    DesignParameter::load_friction, DesignParameter::motor_friction, DesignParameter::tachometer,
    DesignParameter::load_inertia,  DesignParameter::motor_inertia,  DesignParameter::restitution};

/// "backlash", "gear_ratio", …
const char* name_of(DesignParameter parameter);
std::optional<DesignParameter> parameter_named(std::string_view name);
/// "gear ratio", "added tachometer feedback", …
const char* description_of(DesignParameter parameter);

/// One derivative for each number of a Drivetrain: of it, or by it.
struct DrivetrainSlopes {
  double motor_inertia = 0.0;
  double load_inertia = 0.0;
  double motor_friction = 0.0;
  double load_friction = 0.0;
  double stiffness = 0.0;
  double backlash = 0.0;
  double restitution = 0.0;
};

/// A data sheet, or a normalised servo, and what becomes of it when a parameter is changed.
class ChangeableDrive {
 public:
  /// Both throw InvalidInput with every fault.
  explicit ChangeableDrive(const Datasheet& datasheet);
  explicit ChangeableDrive(const NormalizedServo& servo, double natural_frequency = 1.0);

  bool is_normalized() const { return is_normalized_; }
  const Drivetrain& drivetrain() const { return drivetrain_; }

  /// In SI units, or as a share.
  double present_value(DesignParameter parameter) const {
    return present_values_[static_cast<std::size_t>(parameter)];
  }
  /// "rad", "V/rad", "N m s/rad", "V s/rad", "kg m2", or "1" where it is a number.
  const char* unit_of(DesignParameter parameter) const;
  /// Values worth looking at: a thousandth to a thousand times the present one; friction and
  /// feedback, which may be 0 at present, from 0 to where they alone damp the servo ten times
  /// critically; restitution from 0 to 1. Less where that is not permitted (validate(Drivetrain)).
  Bounds range(DesignParameter parameter) const;

  /// The drive with another value of one parameter, or of two; it need not be sound.
  Drivetrain with(DesignParameter parameter, double value) const;
  Drivetrain with(DesignParameter parameter, double value, DesignParameter other,
                  double other_value) const;

  /// All drives with a parameter within bounds, as the data have them.
  DriveBox box(DesignParameter parameter, const Bounds& values) const;
  /// The drive as it is.
  DriveBox box() const { return box_between(drivetrain_, drivetrain_, data_error_); }

  /// How the drive's numbers change with a parameter: the derivatives of with() at its present
  /// value.
  DrivetrainSlopes slopes(DesignParameter parameter) const;

 private:
  void change(Drivetrain& drive, DesignParameter parameter, double value) const;

  Drivetrain drivetrain_;
  std::array<double, parameter_count> present_values_{};
  bool is_normalized_ = false;
  double load_friction_unit_ = 1.0;   ///< F_L for one of the parameter, N m s/rad
  double motor_friction_unit_ = 1.0;  ///< F_M for one of the parameter
  double tachometer_unit_ = 1.0;      ///< F_M for one of the parameter
  double motor_inertia_unit_ = 1.0;   ///< J_M for one of the parameter
  double electrical_friction_ = 0.0;  ///< the part of F_M that is not the motor's friction
  DataError data_error_;
};

}  // namespace gearlash
