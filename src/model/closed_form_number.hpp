// Which numbers of a drive enter its closed form.
#pragma once

#include <string_view>

#include "gearlash/drive.hpp"

namespace gearlash {

/// Whether the drivetrain of a drive with a closed form depends on a number of it, and whether the
/// drive keeps its closed form as the number changes. Of a normal form also for the numbers of its
/// physical_form(). False for an inertia of the gears that is 0 as by default, and for a path that
/// is no number of the drive.
bool enters_closed_form(const Drive& drive, std::string_view path);

}  // namespace gearlash
