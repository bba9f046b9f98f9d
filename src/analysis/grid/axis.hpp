// Axes: how their values are spaced, and where a value stands among them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/grid.hpp"
#include "model/normalized_servo.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// Values on one axis are at most so many, and on all axes of a grid together.
inline constexpr std::size_t most_values_on_an_axis = 1'000'000;
inline constexpr std::size_t most_points_of_a_grid = 10'000'000'000;

/// A number of the normal form, by the short name that it has on axes.
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
/// The one of that path; nullptr for any other.
const NormalFormNumber* normal_form_number(std::string_view path);

enum class Spacing { linear, logarithmic };

/// As linear() and logarithmic(), with faults that name `field`.
Axis spaced_axis(std::string_view field, std::string path, double from, double to,
                 std::size_t count, Spacing spacing);

/// The parameter that the axis varies; nullptr where the drive does not have it. A part of the
/// drive that is not given (sampling, say) is taken to be there.
const Parameter* parameter_of(const Axis& axis, const Drive& drive);

/// Sets the drive's parameter to a value of the axis. Precondition: parameter_of(axis, drive).
void set_on(const Axis& axis, Drive& drive, double value);

/// How far along the axis a value stands, from 0 to 1, in value or in logarithm as the axis has it;
/// the value that stands there, between the ends; and the number of the interval between neighbours
/// that a value lies in. Precondition: finite values, two or more.
double position_on(const Axis& axis, double value);
double value_at(const Axis& axis, double position);
std::size_t interval_of(const Axis& axis, double value);

/// What is wrong with an axis of this drive: a path of no number or word, no values, values that
/// are not permitted, or that do not rise (of a word: that come twice), each named `field`.
std::vector<Fault> faults_of_axis(const Axis& axis, const Drive& drive, std::string_view field);

/// "damping" for servo.damping, … and "restitution" for contact.restitution, as before there were
/// paths; else the path with "_" in place of points and brackets: how columns and dimensions are
/// called.
std::string column_name(std::string_view path);

/// The path of such a short name ("inertia-ratio" is as good as "inertia_ratio") in this drive;
/// any other text as it is.
std::string path_named(std::string_view name, const Drive& drive);

/// "rad", "V/rad", …; "1" of a bare number, "" of a word.
std::string unit_of(const Axis& axis, const Drive& drive);

/// The value as a reader sees it: a number, or the word.
std::string text_of(const Axis& axis, const Drive& drive, double value);

}  // namespace gearlash
