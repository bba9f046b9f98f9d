// Drives for proofs: all that may have been written where one was read, or those of a box.
#pragma once

#include <vector>

#include "gearlash/drive.hpp"
#include "model/drive.hpp"
#include "model/held_torques.hpp"
#include "model/reduction.hpp"
#include "model/sound_drive.hpp"

namespace gearlash {

using EnclosedController = drive::LinearControllerOf<Interval>;

/// Sound drives of one form. Their data are the decimals that may have been written where the
/// doubles were read (base/number.hpp, AsWritten); all that is computed of them, up to the matrices
/// of the controller, is computed in intervals, by the same formulas as of doubles
/// (model/reduction.hpp, model/controller_forms.hpp).
class EnclosedDrive {
 public:
  /// With its signals settled.
  EnclosedDrive(const Drive& drive);
  EnclosedDrive(const SoundDrive& drive) : EnclosedDrive(drive.given(), drive.settled()) {}
  /// The numbers of a reduced drive, whose signals are settled, are data themselves.
  EnclosedDrive(const drive::ReducedDrive& drive);

  /// Extends each number to those of other drives of the same form.
  void widen_to(const EnclosedDrive& other);

  /// One of them, in rounded numbers: what the drive consists of.
  const drive::ReducedDrive& form() const { return form_; }
  /// Without the numbers of its signals, which are those of the form: see course().
  const drive::ReducedDriveOf<Interval>& numbers() const { return numbers_; }
  /// From sample to sample of a sampled drive. It may have a state that the form's is without,
  /// where rounding has hidden one.
  const EnclosedController& controller() const { return controller_; }
  const CourseOf<Interval>& course() const { return course_; }
  /// Of a sampled drive.
  const Interval& period() const { return period_; }
  const std::vector<HeldTorqueOf<Interval>>& held_torques() const { return held_torques_; }

 private:
  EnclosedDrive(const Drive& drive, drive::ReducedDrive settled);
  void add_controller();

  drive::ReducedDrive form_;
  drive::ReducedDriveOf<Interval> numbers_;
  CourseOf<Interval> course_;
  EnclosedController controller_;
  Interval period_{0.0};
  std::vector<HeldTorqueOf<Interval>> held_torques_;
};

}  // namespace gearlash
