// Starts, the ways from them, and the borders of basins, in the phase plane of a searched drive.
#pragma once

#include <optional>

#include "general/attractors/attractors.hpp"
#include "picture/motion_picture.hpp"
#include "question/map/basins.hpp"

namespace gearlash {

/// The plane that a portrait of these cycles shows: all of them that are not far larger than the
/// hunting, and the steps from which on the drive hunts or runs away, if they are not far larger
/// either. Without cycles, those steps, else five of the largest of gap, encoder step and the error
/// that friction holds. Empty if the reference is not constant: starts are then no plane.
std::optional<StartPlane> plane_to_draw(const MotionPicture& cycles,
                                        const drive::ReducedDrive& reduced,
                                        const drive::AttractorSearch& search);

/// Whether starts lead to different ends, so that there are borders.
bool has_several_basins(const drive::AttractorSearch& search);

/// Limits the picture to the plane, and adds the motions from the search's starts in it.
/// `basins`: nullptr if all starts lead to the same end.
void add_portrait(MotionPicture& picture, const drive::ReducedDrive& reduced,
                  const drive::AttractorSearch& search, const StartPlane& plane,
                  const Basins* basins);

}  // namespace gearlash
