// Maps over two parameters and charts over one, as the page draws them.
#pragma once

#include "drive_reply.hpp"
#include "gearlash/progress.hpp"

namespace gearlash::web {

/// `request`: {"x": AXIS, "y": AXIS}, axes as on the command line. The map of the amplitude. Throws
/// InvalidInput for faults of the axes.
MapReply map_reply(const Json& request, const WrittenDrive& written, Progress& progress);

/// `request`: {"x": AXIS or the path of a parameter}. The amplitude of every cycle over it, with
/// the borders between motions; rests are intervals. Throws InvalidInput likewise.
MapReply chart_reply(const Json& request, const WrittenDrive& written, Progress& progress);

}  // namespace gearlash::web
