// The points of a grid: the drive for each combination of values.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "question/axis.hpp"
#include "question/final_servo.hpp"

namespace gearlash {

/// The engines that a grid needs.
struct EnginesNeeded {
  bool closed_form = false;
  bool bounces = false;  ///< closed form with bounces, which needs a search of its own
  bool search = false;   ///< the general engine
};

/// A grid without the values of its axes. If all axes are numbers of the normal form, points become
/// servos directly; otherwise parameters are set by their paths and the drive is examined.
class GridPoints {
 public:
  /// Precondition: faults(grid) is empty.
  explicit GridPoints(const Grid& grid);

  /// Whether every point is a servo with its own numbers on the axes.
  bool are_of_normal_form() const { return servo_.has_value(); }
  /// Determined from the ends of the axes.
  const EnginesNeeded& engines() const { return engines_; }

  /// The grid's own, without values of the axes.
  const Drive& drive() const { return drive_; }
  Drive drive_at(std::span<const double> values) const;
  /// The point in closed form; empty for an invalid drive or one that must be searched.
  std::optional<FinalServo> servo_at(std::span<const double> values) const;
  /// As servo_at(), unchecked, for grids of the normal form.
  NormalizedServo normal_form_at(std::span<const double> values) const;
  const std::optional<FinalServo>& base() const { return servo_; }

 private:
  Drive drive_;
  std::vector<Axis> axes_;  ///< without their values
  /// For a normal form whose axes are its numbers: the servo that they change.
  std::optional<FinalServo> servo_;
  std::vector<double NormalizedServo::*> members_;
  EnginesNeeded engines_;
};

/// The values of the axes at a point.
std::vector<double> values_at(const Grid& grid, std::size_t index);

/// All combinations of the axes' first and last values.
std::vector<std::vector<double>> corners_of(const Grid& grid);

}  // namespace gearlash
