// The cycles and irregular motion of a drive as a picture in the phase plane.
#pragma once

#include <string>

#include "general/attractors/attractors.hpp"
#include "picture/motion_picture.hpp"

namespace gearlash {

/// The motion from that start. `most_events` counts ticks too.
Motion motion_from(const drive::ReducedDrive& reduced, const drive::ShaftStates& start,
                   double until, std::size_t most_events);

/// Draws the results of a search in `reduced`, which is `drive` with its signals settled. Positions
/// are measured from the reference.
MotionPicture attractor_picture(const std::string& title, const Drive& drive,
                                const drive::ReducedDrive& reduced,
                                const drive::AttractorSearch& search);

/// The motion from one of the search's starts to what is seen in practice (hunting, else running
/// away, else rest), over time. Its subtitle has the start.
MotionPicture hunting_picture(const std::string& title, const Drive& drive,
                              const drive::ReducedDrive& reduced,
                              const drive::AttractorSearch& search);

}  // namespace gearlash
