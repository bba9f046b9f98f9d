#include "textbook_gains.hpp"

namespace gearlash::oracle {

PlainDrive with_textbook_gains(const PlainDrive& drive) {
  const double of_difference = drive.has_tachometer ? 0.0 : 0.5 * drive.period;
  const double small_time = drive.delay + 0.5 * drive.period + of_difference;
  const double speed_loop = 4.0 * small_time;
  PlainDrive tuned = drive;
  tuned.controller.proportional = (drive.motor.inertia + drive.load.inertia) / (2.0 * small_time);
  tuned.controller.integral = tuned.controller.proportional / (4.0 * small_time);
  tuned.controller.tracking_time = 4.0 * small_time;
  tuned.controller.position = 1.0 / (4.0 * speed_loop);
  return tuned;
}

}  // namespace gearlash::oracle
