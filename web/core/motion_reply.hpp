// Motions as the page shows them: over time, and as two gears.
#pragma once

#include "picture/motion_picture.hpp"
#include "replies.hpp"

namespace gearlash::web {

/// The first motion of the picture. One with too many events to draw has a reason instead.
ShownMotion motion_reply(const std::string& name, const MotionPicture& picture);

}  // namespace gearlash::web
