// Parameters of one drive by their paths, for gearlash/parameter.hpp.
#pragma once

#include <string_view>

#include "model/parameters.hpp"

namespace gearlash {

/// The parameter of that path, aliases and indices permitted. Throws InvalidInput if there is none,
/// or if the drive does not have it.
const Parameter& parameter_of(const Drive& drive, std::string_view path);

/// The other form of the parameter that has this path; nullptr if the path is the parameter's own.
const OtherForm* form_named(const Parameter& parameter, std::string_view path);

/// A normal form that is asked for a number of the drive that it stands for becomes that drive, its
/// physical_form(). Any other drive, and any other path, change nothing.
void take_form_with(Drive& drive, std::string_view path);

/// take_form_with(), and adds the optional part of a drive that the parameter belongs to, such as
/// sampling.
void add_section_of(Drive& drive, std::string_view path);

}  // namespace gearlash
