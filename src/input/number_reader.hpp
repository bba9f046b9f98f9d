// Reading a number of a drive from a key of a section, in any of its forms.
#pragma once

#include <string>
#include <string_view>

#include "input/section_reader.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// The parameter that the key gives, whose name in the registry is `path`: a gain as a torque or a
/// current, an encoder's counts as bits. Records a fault, and returns a placeholder, for what the
/// parameter or the drive cannot have. `wanted` is SectionReader::number()'s.
Measured read_number_of(SectionReader& section, const std::string& key, const Parameter& parameter,
                        std::string_view path, const Drive& drive, const std::string& wanted);

}  // namespace gearlash
