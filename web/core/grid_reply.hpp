// Maps over two parameters and charts over one, as the page draws them.
#pragma once

#include "core.hpp"
#include "gearlash/progress.hpp"
#include "input/drive_file.hpp"
#include "numbers.hpp"

namespace gearlash::web {

/// `request`: {"x": AXIS, "y": AXIS}, axes as on the command line. The map of the amplitude, and
/// the size of its axes' units in SI. Throws InvalidInput for faults of the axes.
Json map_reply(const Json& request, const WrittenDrive& written, Numbers& numbers,
               Progress& progress);

/// `request`: {"x": AXIS or the path of a parameter}. The amplitude of every cycle over it, with
/// the borders between motions; rests are intervals. Throws InvalidInput likewise.
Json chart_reply(const Json& request, const WrittenDrive& written, Numbers& numbers,
                 Progress& progress);

}  // namespace gearlash::web
