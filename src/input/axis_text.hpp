// Axes as they are typed: "controller.proportional=1:10:20:log", "gearbox.backlash=1 arcmin,1 deg",
// "sensor.position=load,motor".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gearlash/grid.hpp"

namespace gearlash {

/// An axis whose values are still text, because their units depend on the drive.
struct AxisText {
  std::string field;   ///< "--x"
  std::string name;    ///< a path, or a short name of the normal form
  std::string values;  ///< FROM:TO:COUNT, FROM:TO:COUNT:log or A,B,C
};

/// Throws InvalidInput, naming `field`, for a text without a name or values.
AxisText split_axis(std::string_view field, std::string_view text);

/// The drive that the axes vary. It is reduced to its normal form, natural frequency kept, if an
/// axis varies a number that only the normal form has, such as `damping`. It is_rounded if an axis
/// gives it a decimal with more digits than a double has.
Drive drive_of_axes(const Drive& drive, const std::vector<AxisText>& axes);

/// Reads numbers, fractions and numbers with units; a bare number is in SI. Words name the choices
/// of a parameter. Throws InvalidInput, naming the field, for a parameter that the drive does not
/// have, for unreadable values, and for faults_of_axis().
///
/// If `left_out` is given, values that the parameter must not have are left out, unless that leaves
/// none, and it takes one line that says so.
Axis read_axis(const AxisText& text, const Drive& drive, std::string* left_out = nullptr);

/// Reads an axis of an option, where a name alone has an axis of its own.
using AxisReader = Axis (*)(std::string_view field, std::string_view text, const Drive& drive,
                            std::string* left_out);

/// An axis as typed, or usual_axis() of a name alone: "controller.proportional". Throws as both do.
Axis read_axis_or_name(std::string_view field, std::string_view text, const Drive& drive,
                       std::string* left_out = nullptr);
/// The same for a design: an axis as typed, or axis_to_search() of a name alone.
Axis read_axis_to_search(std::string_view field, std::string_view text, const Drive& drive,
                         std::string* left_out = nullptr);

/// The values that tune() may try: PATH=FROM:TO, by ratio where both ends are positive; an axis as
/// typed; or usual_axis_to_tune() of a name alone. Throws as these do.
Axis read_axis_to_tune(std::string_view field, std::string_view text, const Drive& drive,
                       std::string* left_out = nullptr);

}  // namespace gearlash
