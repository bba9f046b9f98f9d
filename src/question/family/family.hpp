// A drive and the parameters of it that vary: the drives with other values of them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/proportional_servo.hpp"
#include "question/axis.hpp"

namespace gearlash {

/// The engines that the drives of a family need.
struct EnginesNeeded {
  bool solution = false;  ///< the closed form
  bool bounces = false;   ///< closed form with bounces, which needs a search of its own
  bool search = false;    ///< the general engine
};

/// What a breakaway torque that does not vary by itself does where the Coulomb friction of its
/// shaft varies.
enum class Breakaway : unsigned char { as_given, keeps_its_ratio };

/// The base with these values, one for each axis. It may be unsound. Precondition: each axis is a
/// number or a word of the base.
Drive drive_with(const Drive& base, const std::vector<Axis>& axes, std::span<const double> values,
                 Breakaway breakaway = Breakaway::as_given);

class Family {
 public:
  /// Of each axis the first and the last value count, and all of a word: from them the engines are
  /// determined. Precondition: each is a number or a word of the drive.
  Family(Drive base, const std::vector<Axis>& axes, Breakaway breakaway = Breakaway::as_given);
  explicit Family(const Grid& grid) : Family(grid.drive, grid.axes) {}

  /// The drive without values of the axes.
  const Drive& base() const { return base_; }
  /// The number of parameters that vary.
  std::size_t width() const { return axes_.size(); }
  const EnginesNeeded& engines() const { return engines_; }

  /// drive_with() these values.
  Drive drive_at(std::span<const double> values) const {
    return drive_with(base_, axes_, values, breakaway_);
  }
  /// The same in closed form; empty for an unsound drive, or one that must be searched.
  std::optional<ProportionalServo> servo_at(std::span<const double> values) const;

  /// For a normal form of which only its own numbers vary: what all of its servos share. Empty for
  /// any other family.
  const std::optional<ProportionalServo>& normal_form() const { return normal_form_; }
  /// As servo_at(), unchecked. Precondition: normal_form().
  NormalizedServo normal_form_at(std::span<const double> values) const;

 private:
  friend class FamilyMember;

  Drive base_;
  std::vector<Axis> axes_;  ///< without their values
  Breakaway breakaway_;
  std::optional<ProportionalServo> normal_form_;
  std::vector<double NormalizedServo::*> members_;
  EnginesNeeded engines_;
  /// One of the drives, if all have a closed form and only numbers vary; without settled signals.
  std::optional<Drive> closed_;
};

/// Those of a single drive; none of an unsound one.
inline EnginesNeeded engines_of(const Drive& drive) { return Family(drive, {}).engines(); }

/// One drive of a family after another, of which all have a closed form: each place of a value is
/// looked up once. For one thread at a time.
class FamilyMember {
 public:
  explicit FamilyMember(const Family& family);
  FamilyMember(const FamilyMember&) = delete;
  FamilyMember& operator=(const FamilyMember&) = delete;

  /// Whether servo() answers for this family.
  bool exists() const { return is_whole_; }
  /// Empty for values that give no servo. Precondition: exists().
  std::optional<ProportionalServo> servo(std::span<const double> values);
  /// The drive of the last servo().
  const Drive& drive() const { return *drive_; }

 private:
  std::optional<Drive> drive_;
  std::vector<double*> places_;
  bool is_whole_ = false;
};

/// The values of the axes at a point.
std::vector<double> values_at(const Grid& grid, std::size_t index);

/// All combinations of the ends of ranges; a range of one value has one end.
std::vector<std::vector<double>> corners_of(std::span<const Bounds> ranges);
/// All combinations of the axes' first and last values; of more than twelve axes only the ends of
/// one at a time, beside the first values of the others.
std::vector<std::vector<double>> corners_of(const std::vector<Axis>& axes);

}  // namespace gearlash
