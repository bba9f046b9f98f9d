// A drive in which some parameters vary from sample to sample of a production run.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/drive.hpp"
#include "question/family/family.hpp"
#include "question/loop/ceiling/enclosed_ceiling.hpp"
#include "question/series/distribution.hpp"

namespace gearlash {

/// "gearbox.backlash"; "servo.backlash" for a normal form.
std::string_view path_of_backlash(const Drive& drive);
/// The index of the backlash among the varied parameters; empty if it does not vary.
std::optional<std::size_t> place_of_backlash(const TolerancedDrive& drive);
/// The unit of a parameter of the drive; "1" for a pure number.
std::string_view unit_of(const Drive& drive, std::string_view path);

/// The drives that the tolerances permit. A breakaway torque that does not vary by itself keeps its
/// ratio to the Coulomb friction of its shaft. Precondition: each varied parameter is a number of
/// the drive.
Family family_of(const TolerancedDrive& drive);
/// The varied parameters as axes from the lowest to the highest value drawn.
std::vector<Axis> axes_of(const TolerancedDrive& drive);

/// Whether the closed form does not answer for all of them.
bool is_searched(const TolerancedDrive& drive);
/// Whether faces may bounce: a sample then takes milliseconds.
bool may_bounce(const TolerancedDrive& drive);

/// The means of the varied parameters.
std::vector<double> means_of(const TolerancedDrive& drive);
/// The ceiling of all that the tolerances permit: of the load's amplitude, or motor_amplitude.
/// Unlimited normal distributions are cut at three standard deviations; of lots all values between
/// the lowest and the highest count.
EnclosedCeiling ceiling_of_all(const TolerancedDrive& drive, Quantity amplitude,
                               Progress& progress = no_progress());

}  // namespace gearlash
