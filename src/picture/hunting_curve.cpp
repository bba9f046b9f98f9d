#include "picture/hunting_curve.hpp"

#include "question/map/hunting_boundary.hpp"

namespace gearlash {

NamedCurve curve_to_hunting_ends(const std::vector<CurveServo>& servos,
                                 const std::function<NormalizedServo(double place)>& servo_at,
                                 double limit) {
  NamedCurve curve;
  curve.line.reserve(servos.size());
  for (std::size_t i = 0; i < servos.size(); ++i) {
    const CurveServo& servo = servos[i];
    if (i > 0 && servo.hunts && servos[i - 1].hunts && servo.hunts != servos[i - 1].hunts) {
      const CurveServo& hunting = *servo.hunts ? servo : servos[i - 1];
      const CurveServo& quiet = *servo.hunts ? servos[i - 1] : servo;
      const MapPoint end{hunting_end(servo_at, hunting.place, quiet.place), limit};
      curve.ends.push_back(end);
      curve.line.push_back(end);
    }
    curve.line.push_back({servo.place, servo.value});
  }
  return curve;
}

}  // namespace gearlash
