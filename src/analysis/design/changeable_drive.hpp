// A drive of which single numbers are changed, as a designer changes them, all others fixed.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "closed_form/cycle_bounds.hpp"
#include "gearlash/drive.hpp"
#include "model/drivetrain_slopes.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// A number that may be changed by itself: a parameter of the drive by its path; feedback of the
/// motor's speed that is added, "tachometer"; and of a normal form also shares of what it has at
/// present, "gear_ratio", "error_gain", "load_friction", "motor_friction", "load_inertia",
/// "motor_inertia": of all inertia, of the critical friction 2ω_n(J_M + J_L), of ratio and gain.
struct ChangeableNumber {
  enum class Kind { parameter, share, feedback };

  std::string name{};         ///< "gearbox.ratio", "gear_ratio", "tachometer"
  std::string older_name{};   ///< that is understood, too
  std::string description{};  ///< "motor turns per load turn"
  std::string unit{};         ///< SI, "1" where it is a bare number
  double present = 0.0;
  Kind kind = Kind::parameter;
  const Parameter* parameter = nullptr;  ///< of a share, in physical_form()
  double scale = 1.0;                    ///< of the parameter, or of feedback, for one of it

  bool is_backlash() const { return older_name == "backlash"; }
  bool is_restitution() const { return older_name == "restitution"; }
};

/// A drive with a closed form, and what becomes of it when a number is changed.
class ChangeableDrive {
 public:
  /// Throws InvalidInput with every fault, or where the drive has no closed form.
  explicit ChangeableDrive(const Drive& drive);

  /// Without its signals, on which hunting does not depend.
  const Drive& drive() const { return drive_; }
  const Drivetrain& drivetrain() const { return drivetrain_; }

  /// All of them: what a design looks at first, then the others.
  const std::vector<ChangeableNumber>& numbers() const { return numbers_; }
  /// The names that a design looks at unless others are given.
  std::vector<std::string> usual_names() const;
  /// By its name, an alias of it (model/parameters.hpp) or its name of 0.1; nullptr: there is none.
  const ChangeableNumber* find(std::string_view name) const;
  /// The same. Throws InvalidInput where there is none.
  const ChangeableNumber& number(std::string_view name) const;

  double present_value(std::string_view name) const { return number(name).present; }
  /// Values worth looking at: a thousandth to a thousand times the present one; numbers that add
  /// friction alone, which may be 0 at present, from 0 to where they alone damp the servo ten times
  /// critically; shares from 0 to 1. Less where that is not permitted (validate(Drivetrain)).
  Bounds range(std::string_view name) const;

  /// The drive with another value of one number, or of two; it need not be sound.
  Drivetrain with(std::string_view name, double value) const;
  Drivetrain with(std::string_view name, double value, std::string_view other,
                  double other_value) const;

  /// All drives with a number within bounds, as the data have them. Precondition: both ends are
  /// sound.
  DriveBox box(std::string_view name, const Bounds& values) const;
  /// The drive as it is.
  DriveBox box() const { return box_between(drivetrain_, drivetrain_, data_error_); }

  /// How the drivetrain changes with a number: the derivatives of with() at its present value.
  DrivetrainSlopes slopes(std::string_view name) const;

 private:
  struct Change {
    const ChangeableNumber& number;
    double value;
  };
  /// A drivetrain, and the sum of the sizes of what its motor's friction is the sum of.
  struct Changed {
    Drivetrain drivetrain;
    double friction_terms = 0.0;
  };
  Changed changed(std::initializer_list<Change> changes) const;
  bool is_sound(const Changed& changed) const;
  void add_parameter(std::string_view path);
  void add_shares();
  void add_feedback(double scale);

  Drive drive_;
  Drivetrain drivetrain_;
  std::vector<ChangeableNumber> numbers_;
  std::size_t usual_ = 0;  ///< how many of them a design looks at first
  DataError data_error_;
};

/// How far the drivetrain may be from what the drive's data say. Precondition: the drive has a
/// closed form, and this drivetrain.
DataError data_error_of(const Drive& drive, const Drivetrain& drivetrain);

}  // namespace gearlash
