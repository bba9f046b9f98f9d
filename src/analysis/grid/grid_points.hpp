// The points of a grid: what each combination of values makes of the drive.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/final_servo.hpp"
#include "analysis/grid/axis.hpp"

namespace gearlash {

/// What engine a grid needs.
struct EnginesNeeded {
  bool closed_form = false;
  bool bounces = false;  ///< in closed form, which then searches too
  bool search = false;   ///< the general engine
};

/// A grid without the values of its axes. Where all of them are numbers of the normal form, points
/// are servos at once; else parameters are set by their paths and the drive is looked at.
class GridPoints {
 public:
  /// Precondition: faults(grid) is empty.
  explicit GridPoints(const Grid& grid);

  std::size_t axes() const { return axes_.size(); }
  /// Whether every point is a servo whose numbers stand on the axes.
  bool are_of_normal_form() const { return servo_.has_value(); }
  /// By the ends of the axes.
  const EnginesNeeded& engines() const { return engines_; }

  Drive drive_at(std::span<const double> values) const;
  /// The point in closed form; nothing where it is no drive, or one that must be searched.
  std::optional<FinalServo> servo_at(std::span<const double> values) const;
  /// The same without a check, for grids that are of the normal form.
  NormalizedServo normal_form_at(std::span<const double> values) const;
  const std::optional<FinalServo>& base() const { return servo_; }

 private:
  Drive drive_;
  std::vector<Axis> axes_;  ///< without their values
  /// Of a normal form whose axes are its numbers: the servo that they change.
  std::optional<FinalServo> servo_;
  std::vector<double NormalizedServo::*> members_;
  EnginesNeeded engines_;
};

/// The values of the axes at a point.
std::vector<double> values_at(const Grid& grid, std::size_t index);

/// All combinations of the axes' first and last values.
std::vector<std::vector<double>> corners_of(const Grid& grid);

}  // namespace gearlash
