// The style and the parts that both pictures of a motion share.
#pragma once

#include <string>
#include <vector>

#include "picture/drawn_motion.hpp"
#include "picture/motion_picture.hpp"

namespace gearlash {

/// Marks of impacts. One that would cover the one before it is left out.
Layer impact_marks(const MapCurve& impacts, const Bounds& x, const Bounds& y, double size);

/// The curves of one motion of the picture. Throws InvalidInput if there are too many to read.
std::vector<DrawnPiece> legible_curve(const MotionPicture& picture, const Motion& motion);

/// The drive in one line: "backlash 10 arcmin, sensor on the load, …".
std::string numbers_line(const MotionPicture& picture);

}  // namespace gearlash
