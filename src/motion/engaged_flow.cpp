#include "gearlash/motion/engaged_flow.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "gearlash/motion/decay_integral.hpp"

namespace gearlash {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The responses C + ζS, C − ζS and S of the header.
struct Responses {
  double position;
  double speed;
  double impulse;
};

Responses underdamped(double damping, double time) {
  const double frequency = std::sqrt((1.0 - damping) * (1.0 + damping));
  const double angle = frequency * time;
  const double decay = std::exp(-damping * time);
  const double cosine = decay * std::cos(angle);
  const double sine = angle == 0.0 ? time : std::sin(angle) / frequency;
  const double impulse = decay * sine;
  return {cosine + damping * impulse, cosine - damping * impulse, impulse};
}

/// Sums of positive terms only (but for the speed, which changes sign).
Responses overdamped(double damping, double time) {
  const double half_split = std::sqrt((damping - 1.0) * (damping + 1.0));
  const double fast = damping + half_split;
  const double slow = 1.0 / fast;
  const double slow_decay = std::exp(-slow * time);
  const double impulse = slow_decay * time * decay(2.0 * half_split * time).integral;
  return {slow_decay + slow * impulse, std::exp(-fast * time) - slow * impulse, impulse};
}

}  // namespace

EngagedFlow::State EngagedFlow::at(double time) const {
  const Responses r = damping < 1.0 ? underdamped(damping, time) : overdamped(damping, time);
  return {position * r.position + speed * r.impulse, speed * r.speed - position * r.impulse};
}

double first_zero(double damping, double value, double slope) {
  if (damping < 1.0) {
    const double frequency = std::sqrt((1.0 - damping) * (1.0 + damping));
    if (value == 0.0) return slope == 0.0 ? infinity : std::numbers::pi / frequency;
    const double cosine_part = std::copysign(1.0, value) * -(slope + damping * value);
    return std::atan2(std::abs(value) * frequency, cosine_part) / frequency;
  }
  const double half_split = std::sqrt((damping - 1.0) * (damping + 1.0));
  const double fast = damping + half_split;
  const double quotient = -value / (slope + fast * value);
  if (!(quotient > 0.0) || std::isinf(quotient)) return infinity;
  if (half_split == 0.0) return quotient;
  return std::log1p(2.0 * half_split * quotient) / (2.0 * half_split);
}

}  // namespace gearlash
