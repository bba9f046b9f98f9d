// Reading one value of a parameter from text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/units.hpp"
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

/// One way to give a number under one of its parameter's names.
struct NumberForm {
  std::optional<Dimension> dimension{};  ///< none: without a unit
  double factor = 1.0;  ///< by which what is read is multiplied, then as `form` says
  const OtherForm* form = nullptr;
  std::string refusal{};  ///< why this drive cannot take it; empty if it can
};

/// The ways to give the number by that name, the usual one first: in its own dimension; a current
/// of a motor with a torque constant, where it is a torque; its reciprocal ("1 kHz" for a period).
std::vector<NumberForm> number_forms(const Parameter& parameter, const Drive& drive,
                                     std::string_view path);

/// The parameter, from the number of another form of it. Throws InvalidInput, naming the path, for
/// a number that is none of that form.
double value_of_form(const OtherForm& form, double number, const Drive& drive,
                     std::string_view path);

/// The index of a word among the parameter's choices. Throws InvalidInput, naming the path, for any
/// other word.
std::size_t choice_of(const Parameter& parameter, std::string_view path, std::string_view text);

}  // namespace gearlash
