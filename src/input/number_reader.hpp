// Reading a number of a drive from a key of a section, in any of its forms.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gearlash/units.hpp"
#include "input/section_reader.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// The parameter that the key gives, whose name in the registry is `path`: a gain as a torque or a
/// current, an encoder's counts as bits. Records a fault, and returns a placeholder, for what the
/// parameter or the drive cannot have. `wanted` is SectionReader::number()'s.
Measured read_number_of(SectionReader& section, const std::string& key, const Parameter& parameter,
                        std::string_view path, const Drive& drive, const std::string& wanted);

/// Records a fault if the key is given and fits the parameter in none of the drives: those of each
/// kind of motor, where the file's is not known.
void refuse_other_units(SectionReader& section, const std::string& key, const Parameter& parameter,
                        std::string_view path, const std::vector<Drive>& drives);

}  // namespace gearlash
