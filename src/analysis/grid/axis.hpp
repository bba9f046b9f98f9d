// What a chart varies: one input of the servo over its values.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "model/normalized_servo.hpp"

namespace gearlash {

/// The numbers of a NormalizedServo.
enum class Input { damping, inertia_ratio, friction_ratio, backlash, restitution };

inline constexpr std::array all_inputs = {Input::damping, Input::inertia_ratio,
                                          Input::friction_ratio, Input::backlash,
                                          Input::restitution};

/// "damping", "inertia_ratio", … as the fields of NormalizedServo are called.
const char* name_of(Input input);
/// The input of that name; "inertia-ratio" is as good as "inertia_ratio".
std::optional<Input> input_named(std::string_view name);

/// "inertia ratio, load to motor", …
const char* description_of(Input input);
/// "rad" or "1".
const char* unit_of(Input input);

/// The field of that input.
double NormalizedServo::*field_of(Input input);

struct Axis {
  Input input = Input::damping;
  std::vector<double> values;
  bool logarithmic = false;  ///< spaced, and to be drawn, so

  bool operator==(const Axis&) const = default;
};

/// Values on one axis are at most so many, and on all axes of a grid together.
inline constexpr std::size_t most_values_on_an_axis = 1'000'000;
inline constexpr std::size_t most_points_of_a_grid = 10'000'000'000;

enum class Spacing { linear, logarithmic };

/// `count` values from `from` to `to`, both exactly, evenly in value or in logarithm. One value
/// only where both are the same. Throws InvalidInput, naming `field`, for ends that are not finite
/// or not in order, a logarithm of 0 or less, or a count below 2 (1) or above
/// most_values_on_an_axis.
Axis spaced_axis(std::string_view field, Input input, double from, double to, std::size_t count,
                 Spacing spacing);

/// How far along the axis a value stands, from 0 to 1, in value or in logarithm as the axis has it;
/// the value that stands there, between the ends; and the number of the interval between neighbours
/// that a value lies in. Precondition: finite values, two or more.
double position_on(const Axis& axis, double value);
double value_at(const Axis& axis, double position);
std::size_t interval_of(const Axis& axis, double value);

/// What is wrong with an axis: no values, values that are out of the input's range, or that do not
/// rise, each named `field`. Empty when the axis is sound.
std::vector<Fault> validate(const Axis& axis, std::string_view field);

}  // namespace gearlash
