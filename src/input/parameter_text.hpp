// One value of a parameter as text.
#pragma once

#include <string_view>

#include "model/parameters.hpp"

namespace gearlash {

/// A number in SI, as set() takes it under that path. Throws InvalidInput, naming the path, for
/// text that is none in the parameter's dimension.
double number_of(const Parameter& parameter, const Drive& drive, std::string_view path,
                 std::string_view text);

/// The number of a word among the parameter's choices. Throws InvalidInput likewise.
std::size_t choice_of(const Parameter& parameter, std::string_view path, std::string_view text);

}  // namespace gearlash
