#include "thesis/exact_curve.hpp"

#include "base/special_numbers.hpp"
#include "picture/hunting_curve.hpp"

namespace gearlash::thesis {
namespace {

bool has_gap(const NormalizedServo& servo) { return faults(servo).empty() && servo.backlash > 0.0; }

}  // namespace

std::optional<double> exact_amplitude(const NormalizedServo& servo) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle* cycle = largest_stable(analysis);
  return cycle != nullptr ? std::optional(cycle->amplitude) : std::nullopt;
}

NamedCurve exact_curve(const std::vector<double>& places,
                       const std::function<NormalizedServo(double place)>& servo_at) {
  std::vector<CurveServo> servos;
  servos.reserve(places.size());
  for (const double place : places) {
    const NormalizedServo servo = servo_at(place);
    if (has_gap(servo)) {
      const std::optional<double> amplitude = exact_amplitude(servo);
      servos.push_back({place, amplitude.value_or(not_a_number), amplitude.has_value()});
    } else {
      servos.push_back({place, servo.backlash == 0.0 ? 0.0 : not_a_number});
    }
  }
  return curve_to_hunting_ends(servos, servo_at, 0.0);
}

}  // namespace gearlash::thesis
