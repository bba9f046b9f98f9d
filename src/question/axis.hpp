// Axes: the spacing of their values, and the position of a value among them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/grid.hpp"
#include "model/normalized_servo.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// The largest number of values on one axis, and of points of a grid.
inline constexpr std::size_t most_values_on_an_axis = 1'000'000;
inline constexpr double most_points_of_a_grid = 1e9;

/// A number of the normal form and its short name for axes.
struct NormalFormNumber {
  const char* name;
  std::string_view path;
  double NormalizedServo::*member;
};
inline constexpr std::array<NormalFormNumber, 5> normal_form_numbers = {
    {{"damping", "servo.damping", &NormalizedServo::damping},
     {"inertia_ratio", "servo.inertia_ratio", &NormalizedServo::inertia_ratio},
     {"friction_ratio", "servo.friction_ratio", &NormalizedServo::friction_ratio},
     {"backlash", "servo.backlash", &NormalizedServo::backlash},
     {"restitution", "contact.restitution", &NormalizedServo::restitution}}};
/// The number with that path; nullptr for any other path.
const NormalFormNumber* normal_form_number(std::string_view path);
/// The path of a drive that is a normal form, or of any other: of the backlash it differs.
std::string_view path_of(const NormalFormNumber& number, bool is_normal_form);

enum class Spacing { linear, logarithmic };

/// As linear() and logarithmic(); faults name `field`.
Axis spaced_axis(std::string_view field, std::string path, double from, double to,
                 std::size_t count, Spacing spacing);

/// The smallest product of one of the digits, which rise, and a power of ten that is not below the
/// number, or below it by no more than this share.
double round_number_from(double number, std::span<const double> digits, double rounding = 0.0);

/// The parameter that the axis varies; nullptr if the drive does not have it. An absent part of the
/// drive (sampling, say) is treated as present.
const Parameter* parameter_of(const Axis& axis, const Drive& drive);

/// The number, or the choice's, that the drive has; empty where it is not given and has no default.
/// Precondition: parameter_of(axis, drive).
std::optional<double> present_value(const Axis& axis, const Drive& drive);

/// usual_axis() of gearlash/design.hpp; faults name `field`.
Axis usual_axis(std::string_view field, const Drive& drive, std::string_view parameter);

/// Sets the drive's parameter to a value of the axis. Precondition: parameter_of(axis, drive).
void set_on(const Axis& axis, Drive& drive, double value);
/// The same with a value for each axis. The numbers of a normal form are set first: others make it
/// the drive that it stands for.
void set_on(const std::vector<Axis>& axes, Drive& drive, std::span<const double> values);

/// `position_on`: how far along the axis a value lies, from 0 to 1, in value or in logarithm as the
/// axis is spaced. `value_at`: its inverse, limited to the ends. `interval_of`: the index of the
/// interval between neighboring values that contains a value. Precondition: two or more finite
/// values.
double position_on(const Axis& axis, double value);
double value_at(const Axis& axis, double position);
std::size_t interval_of(const Axis& axis, double value);

/// The faults of an axis of this drive, each named `field`: a path that is not a number or word of
/// the drive, no values, values that are not permitted, and values that do not rise (for a word:
/// that repeat).
std::vector<Fault> faults_of_axis(const Axis& axis, const Drive& drive, std::string_view field);

/// Leaves out the values that the parameter must not have, if it may have others. Returns what it
/// left out and why, "0 (gearbox.backlash must be positive)"; empty if nothing. Precondition:
/// parameter_of(axis, drive).
std::string cut_to_permitted(Axis& axis, const Drive& drive);

/// Likewise the values with which the drive, its other parameters as they are, would have faults.
std::string cut_to_sound(Axis& axis, const Drive& drive);

/// Whether the value is at an end of the axis, within a thousandth, and the parameter may lie
/// beyond. Precondition: two or more numbers.
bool is_at_open_end(const Axis& axis, const Drive& drive, double value);

/// The name of a column or dimension: "damping" for servo.damping, … and "restitution" for
/// contact.restitution, the names before paths existed; any other path with "_" in place of points
/// and brackets.
std::string column_name(std::string_view path);

/// The path of a short name in this drive ("inertia-ratio" and "inertia_ratio" are the same); any
/// other text unchanged.
std::string path_named(std::string_view name, const Drive& drive);

/// "rad", "V/rad", …; "1" for a pure number, "" for a word.
std::string unit_of(const Axis& axis, const Drive& drive);

/// The value as text for a reader: a number or the word.
std::string text_of(const Axis& axis, const Drive& drive, double value);

}  // namespace gearlash
