#include "closed_form/engaged_flow.hpp"

#include <cmath>

#include "closed_form/decay_integral.hpp"

namespace gearlash {
namespace {

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

/// Sums of positive terms only, except for the speed, which changes sign.
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

}  // namespace gearlash
