#include "motion_reply.hpp"

#include "model/reduced_drive.hpp"
#include "picture/motion_style.hpp"

namespace gearlash::web {

ShownMotion motion_reply(const std::string& name, const MotionPicture& picture) {
  const Motion& motion = picture.motions.front().motion;
  ShownMotion shown{.name = name,
                    .time_unit = is_normalized(picture.drive) ? "1/ω_n" : "s",
                    .gap = picture.angle.from_radians(reduce(picture.drive).backlash)};
  try {
    shown.plot = drawn(time_plot(picture));
    for (const DrawnPiece& piece : legible_curve(picture, motion)) {
      for (const DrawnPoint& point : piece.points) {
        shown.load.push_back({point.time, point.load_position - point.reference});
        shown.motor.push_back({point.time, point.motor_position - point.reference});
      }
    }
  } catch (const InvalidInput& error) {
    shown.reason = error.what();
    return shown;
  }
  for (const MotionEvent& event : motion.events()) {
    shown.events.push_back({event.time, std::string(event.what), std::string(event.mode_after)});
  }
  return shown;
}

}  // namespace gearlash::web
