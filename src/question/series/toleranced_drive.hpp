// A drive in which some parameters vary from sample to sample of a production run.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/drive.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/enclosed_ceiling.hpp"
#include "question/series/distribution.hpp"

namespace gearlash {

/// "gearbox.backlash"; "servo.backlash" for a normal form.
std::string_view path_of_backlash(const Drive& drive);
/// The index of the backlash among the varied parameters; empty if it does not vary.
std::optional<std::size_t> place_of_backlash(const TolerancedDrive& drive);
/// The unit of a parameter of the drive; "1" for a pure number.
std::string_view unit_of(const Drive& drive, std::string_view path);

/// Whether the closed form does not answer for the drive, or for a parameter that varies.
bool is_searched(const TolerancedDrive& drive);

/// Whether faces may bounce: a sample then takes milliseconds.
bool may_bounce(const TolerancedDrive& drive);
/// faults(), and that the drive must have a closed form, as its varied parameters must.
std::vector<Fault> faults_of_toleranced_servo(const TolerancedDrive& drive);

/// The means of the varied parameters.
std::vector<double> means_of(const TolerancedDrive& drive);
/// The drive with `values` of the varied parameters, in their order. A breakaway torque that does
/// not vary by itself keeps its ratio to the Coulomb friction of its shaft. It may be unsound.
/// Throws InvalidInput where one is no number of the drive.
Drive searched_drive_with(const TolerancedDrive& drive, std::span<const double> values);

/// The ceiling of all that the tolerances permit: of the load's amplitude, or motor_amplitude.
/// Unlimited normal distributions are cut at three standard deviations; of lots all values between
/// the lowest and the highest count.
EnclosedCeiling ceiling_of_all(const TolerancedDrive& drive, Quantity amplitude,
                               Progress& progress = no_progress());

namespace detail {

/// A drawn drive with its backlash separated, because amplitudes are proportional to it.
struct DrivePerBacklash {
  ClosedFormServo drive{};  ///< with a backlash of 1 rad, if it has any
  double backlash = 0.0;    ///< rad
};

/// A drive whose varied parameters are set repeatedly; each place is looked up once. Precondition:
/// the parameters are numbers of the drive.
class DrawnDrive {
 public:
  explicit DrawnDrive(const TolerancedDrive& toleranced);
  DrawnDrive(const DrawnDrive&) = delete;
  DrawnDrive& operator=(const DrawnDrive&) = delete;

  /// The drive with these values, one per varied parameter.
  const Drive& with(std::span<const double> values);
  /// The drive with its backlash separated; empty where the values give no servo.
  std::optional<DrivePerBacklash> per_backlash(std::span<const double> values);

 private:
  Drive drive_;
  std::vector<double*> places_;
  double* backlash_;
};

}  // namespace detail
}  // namespace gearlash
