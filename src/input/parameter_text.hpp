// Reading one value of a parameter from text.
#pragma once

#include <string_view>

#include "input/units.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// The number in SI, as set() takes it for that path. Throws InvalidInput, naming the path, for
/// text that is not a number in the parameter's dimension.
double number_of(const Parameter& parameter, const Drive& drive, std::string_view path,
                 std::string_view text);

/// How its text is read if it has no unit: read_number(), or what knows where its range ends.
NumberText number_text(const Parameter& parameter);

/// Its path, then those of its other forms: all that a file may give it by.
std::vector<std::string_view> paths_of(const Parameter& parameter);

/// "motor" of "motor.inertia".
std::string_view section_of(std::string_view path);

/// The form that gives the parameter's reciprocal; nullptr if there is none.
const OtherForm* inverse_form(const Parameter& parameter);

/// The index of a word among the parameter's choices. Throws InvalidInput, naming the path, for any
/// other word.
std::size_t choice_of(const Parameter& parameter, std::string_view path, std::string_view text);

}  // namespace gearlash
