// The drives along one number that enters their servo.
#pragma once

#include <optional>
#include <string>

#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "model/answer_bounds.hpp"
#include "model/proportional_servo.hpp"
#include "question/change/target.hpp"

namespace gearlash {

struct DriveBox;

/// A drive in which one number changes, all others fixed: a family whose drives are all answered in
/// closed form.
class ServoLine {
 public:
  /// Empty if the drive has no settled_servo(), or if the number does not enter it: one that is no
  /// number of the drive, or whose change would make it another kind of drive. Precondition: a
  /// sound drive.
  static std::optional<ServoLine> along(const Drive& drive, const std::string& path);

  /// NaN if it is not given.
  double present() const { return present_; }
  Drive drive_at(double value) const;
  /// Empty where the drive is unsound.
  std::optional<ProportionalServo> at(double value) const;
  /// What analyse_limit_cycles() gives; undecided where the drive is unsound: next to a shaft
  /// without friction, a small friction on the other shaft is less than a servo may have.
  Answer answer_at(double value) const;
  /// The same, computed only as far as the target needs it. With bounces, the search for cycles
  /// takes milliseconds and is skipped where the growth at rest rules the drive out: the verdict is
  /// then `hunts` or `undecided`, without cycles.
  Answer answer_at(double value, const Target& target) const;
  /// NaN where the drive is unsound.
  double growth_at(double value) const;
  /// A box that contains all drives within bounds, with the error of the data. Precondition: both
  /// ends are sound.
  DriveBox box(const Bounds& values) const;
  /// What is proved of them. The flight time is guessed from the drive in the middle, else at an
  /// end.
  AnswerBounds bounds(const Bounds& values) const;

  /// 0.001 to 1000 times the present value. Numbers that only add friction, which may be 0: from 0
  /// to the value that alone damps the servo at ten times critical. Shares: 0 to 1. Narrower where
  /// the drive permits less.
  Bounds range() const;

  /// Whether amplitudes are proportional to the number, and nothing else depends on it.
  bool is_backlash() const;
  /// A restitution, a friction ratio.
  bool is_share() const;
  /// Whether faces bounce somewhere on the line.
  bool has_bounces() const;

 private:
  ServoLine(Drive drive, std::string path);
  bool is_sound_at(double value) const;

  Drive drive_;  ///< without its signals, which do not affect hunting
  Axis axis_;
  std::string_view parameter_;  ///< its path
  Drivetrain drivetrain_;
  double present_;
};

/// The answer of the same drive with another backlash: its motions are proportional to it, their
/// energies to its square. Precondition: an answer of a servo, with a backlash.
Answer with_backlash(Answer answer, double backlash);

}  // namespace gearlash
