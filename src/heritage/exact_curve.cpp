#include "exact_curve.hpp"

#include <cmath>
#include <limits>

#include "gearlash/chart/hunting_end.hpp"
#include "gearlash/cycle/limit_cycle.hpp"

namespace gearlash::heritage {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

bool has_gap(const NormalizedServo& servo) {
  return validate(servo).empty() && servo.backlash > 0.0;
}

}  // namespace

std::optional<double> exact_size(const NormalizedServo& servo) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle* cycle = largest_stable(analysis);
  return cycle != nullptr ? std::optional(cycle->size) : std::nullopt;
}

ExactCurve exact_curve(const std::vector<double>& places,
                       const std::function<NormalizedServo(double place)>& servo_at) {
  const auto size_at = [&](double place) { return exact_size(servo_at(place)).value_or(nothing); };
  const auto end_between = [&](double hunting, double quiet) {
    return ChartPoint{hunting_end(servo_at, hunting, quiet), 0.0};
  };
  ExactCurve curve;
  const ChartPoint* before = nullptr;  // the neighbour, where it has a gap
  curve.line.reserve(2 * places.size());
  for (const double place : places) {
    const NormalizedServo servo = servo_at(place);
    if (!has_gap(servo)) {
      curve.line.push_back({place, servo.backlash == 0.0 ? 0.0 : nothing});
      before = nullptr;
      continue;
    }
    const double size = size_at(place);
    if (before != nullptr && std::isnan(size) != std::isnan(before->y)) {
      const ChartPoint end =
          std::isnan(size) ? end_between(before->x, place) : end_between(place, before->x);
      curve.ends.push_back(end);
      curve.line.push_back(end);
    }
    curve.line.push_back({place, size});
    before = &curve.line.back();
  }
  return curve;
}

}  // namespace gearlash::heritage
