#include "picture/motion_style.hpp"

#include <fmt/format.h>

#include <cmath>

#include "gearlash/fault.hpp"
#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

Layer impact_marks(const MapCurve& impacts, const Bounds& x, const Bounds& y, double size) {
  constexpr double smallest_distance = 0.004;  // of the axes; less than a mark
  Layer layer{.kind = LayerKind::marks, .name = impacts.empty() ? "" : "impact", .size = size};
  for (const MapPoint& point : impacts) {
    const bool covers =
        !layer.points.empty() &&
        std::abs(point.x - layer.points.back().x) < smallest_distance * (x.high - x.low) &&
        std::abs(point.y - layer.points.back().y) < smallest_distance * (y.high - y.low);
    if (!covers) layer.points.push_back(point);
  }
  return layer;
}

std::vector<DrawnPiece> legible_curve(const MotionPicture& picture, const Motion& motion) {
  if (motion.events().size() > most_events_drawn) {
    refuse("--until", fmt::format("a motion with {} events", motion.events().size()),
           fmt::format("must be shorter to be drawn, {} events at most", most_events_drawn));
  }
  const double longest = most_periods_drawn * picture.period;
  if (motion.end_time() > longest) {
    refuse("--until", significant(motion.end_time(), 6) + " s",
           fmt::format("must be at most {} s to be drawn", significant(longest, 6)));
  }
  std::vector<double> leaps;
  const Signal reference = picture.drive.reference.value_or(Signal{});
  if (const auto* step = std::get_if<StepSignal>(&reference)) leaps.push_back(step->time);
  return drawn_motion(motion, picture.drive.angle_unit, picture.period, leaps);
}

std::string numbers_line(const MotionPicture& picture) {
  Drive drive = picture.drive;
  drive.reference.reset();
  drive.load_torque.reset();
  const drive::ReducedDrive reduced = reduce(drive);
  std::string line = "backlash " + angle_text(reduced.backlash, picture.drive.angle_unit, 4);
  if (const auto closed = proportional_servo(drive)) {
    const NormalizedServo& servo = closed->servo;
    line = fmt::format("damping {}, inertia ratio {}, friction ratio {}, {}",
                       significant(servo.damping, 3), significant(servo.inertia_ratio, 3),
                       significant(servo.friction_ratio, 3), line);
    if (servo.restitution > 0.0) line += ", restitution " + significant(servo.restitution, 3);
    if (is_normalized(drive)) return line;
    return line +
           fmt::format(", natural frequency {} rad/s", significant(closed->natural_frequency, 4));
  }
  if (drive.gearbox.ratio != 1.0) line += ", gear ratio " + significant(drive.gearbox.ratio, 4);
  line += drive.sensor.position == SensorPlace::both
              ? ", sensors on both shafts"
              : std::string(", sensor on the ") + name_of(drive.sensor.position);
  if (drive.sampling) {
    line += fmt::format(", sampled every {} ms", significant(1e3 * drive.sampling->period, 4));
  }
  if (reduced.sensing.resolution > 0.0) {
    line += ", encoder step " + angle_text(reduced.sensing.resolution, picture.drive.angle_unit, 3);
  }
  return line;
}

}  // namespace gearlash
