#include "question/loop/ceiling/gap_speed.hpp"

#include <algorithm>

namespace gearlash {
namespace {

/// The part of β that is not braked.
Interval feedback(const GapMotion& motion) {
  return motion.per_speed + Interval(std::max(0.0, motion.slope.high));
}

/// The root of w² (1 − e²) = 2 b (a + β w) as a line in a: √y ≤ (y/s + s)/2 for every s > 0.
GapSpeedLine by_distance(const GapMotion& motion, double likely) {
  const Interval lost = not_negative(1.0 - square(motion.restitution));
  const Interval push = motion.backlash * feedback(motion);
  const Interval guess = sqrt(square(push) + 2.0 * motion.backlash * lost * Interval(likely));
  const Interval root = std::max(guess.high, std::numeric_limits<double>::min());
  return {(push + 0.5 * (square(push) / root + root)) / lost, motion.backlash / root};
}

/// a/(−slope − per_speed).
GapSpeedLine by_braking(const GapMotion& motion) {
  const Interval braking = not_negative(-motion.slope - motion.per_speed);
  return {0.0, 1.0 / braking, true};
}

double at(const GapSpeedLine& line, const Interval& acceleration) {
  return (line.at_rest + line.per_acceleration * acceleration).high;
}

}  // namespace

GapSpeedLine gap_speed_line(const GapMotion& motion, double likely) {
  const GapSpeedLine distance = by_distance(motion, likely);
  const GapSpeedLine braking = by_braking(motion);
  return at(braking, likely) <= at(distance, likely) ? braking : distance;
}

GapSpeed highest_gap_speed(const GapMotion& motion) {
  if (motion.backlash.high == 0.0) return {0.0, false};
  const GapSpeedLine line = gap_speed_line(motion, motion.acceleration.high);
  return {at(line, motion.acceleration), line.is_braked};
}

}  // namespace gearlash
