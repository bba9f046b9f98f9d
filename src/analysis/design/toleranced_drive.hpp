// A drive of which some numbers differ from sample to sample of a production run.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/design/distribution.hpp"
#include "gearlash/drive.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

/// "gearbox.backlash", or of a normal form "servo.backlash".
std::string_view path_of_backlash(const Drive& drive);
/// Which of the drive's varied parameters is its backlash, if any is.
std::optional<std::size_t> place_of_backlash(const TolerancedDrive& drive);
/// The unit of a parameter of the drive, "1" where it is a bare number.
std::string_view unit_of(const Drive& drive, std::string_view path);

/// The servo that the drive is with `values` of the varied parameters, in their order. Throws
/// InvalidInput where it is none, and std::invalid_argument where there are not as many values.
ClosedFormServo drive_with(const TolerancedDrive& drive, std::span<const double> values);

namespace detail {

/// A drawn drive whose backlash is taken apart: amplitudes are in proportion to it.
struct DrivePerBacklash {
  ClosedFormServo drive{};  ///< with a backlash of 1 rad, if it has any
  double backlash = 0.0;    ///< rad
};

/// A drive of which the varied parameters are written again and again, each place looked up once.
/// Precondition: the parameters are the drive's, and numbers.
class DrawnDrive {
 public:
  explicit DrawnDrive(const TolerancedDrive& toleranced);
  DrawnDrive(const DrawnDrive&) = delete;
  DrawnDrive& operator=(const DrawnDrive&) = delete;

  /// The drive with these values, as many as there are varied parameters.
  const Drive& with(std::span<const double> values);
  /// Its backlash taken apart; nothing where the values make no servo.
  std::optional<DrivePerBacklash> per_backlash(std::span<const double> values);

 private:
  Drive drive_;
  std::vector<double*> places_;
  double* backlash_;
};

}  // namespace detail
}  // namespace gearlash
