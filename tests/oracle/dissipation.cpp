#include "dissipation.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "propagator.hpp"
#include "reference_simulator.hpp"

namespace gearlash::oracle {
namespace {

/// The region, from its definition.
bool is_in_region(const NormalizedServo& servo) {
  const long double r = servo.inertia_ratio;
  const long double f = servo.friction_ratio;
  const long double motor_rate = 2 * servo.damping * (1 - f) * (1 + r);
  const long double load_rate = 2 * servo.damping * f * (1 + r) / r;
  return 1 / motor_rate + 1 / load_rate <= 2 * servo.damping;
}

RandomCase drawn_case(std::uint64_t seed, std::uint64_t index) {
  std::mt19937_64 random(seed * 1'000'003 + index);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  RandomCase drawn;
  NormalizedServo& servo = drawn.servo;
  do {
    servo.damping = std::exp(uniform(std::log(0.71), std::log(10.0)));
    servo.inertia_ratio = std::exp(uniform(std::log(1e-2), std::log(1e2)));
    servo.friction_ratio = uniform(0.0, 1.0);
  } while (!is_in_region(servo));
  servo.backlash = 0.25;
  const double kind = uniform(0.0, 1.0);
  servo.restitution = kind < 0.1 ? 0.0 : kind < 0.2 ? 1.0 : uniform(0.0, 1.0);
  ServoState& start = drawn.initial;
  start.load_position = uniform(-1.0, 1.0);
  start.motor_position = start.load_position + uniform(-0.125, 0.125);
  start.load_speed = uniform(-1.0, 1.0);
  start.motor_speed = uniform(-1.0, 1.0);
  return drawn;
}

}  // namespace

DissipationCheck check_dissipation(std::uint64_t seed, std::uint64_t index) {
  DissipationCheck check{.drawn = drawn_case(seed, index)};
  const NormalizedServo& servo = check.drawn.servo;
  ReferenceSimulator<ExponentialPropagator> simulator(servo, ExponentialPropagator(servo));
  // Creeping across the gap at y/F_M leaves some b F_M/t of y after a time t.
  const Extended until = 200 * std::max(1.0, servo.damping);
  constexpr std::size_t most_events = 4000;
  const ReferenceRun run =
      simulator.run(check.drawn.initial, {.until = until, .event_limit = most_events});
  check.exhausted = run.exhausted;
  if (run.exhausted) return check;
  const auto largest = [&](Extended from, Extended to) {
    Extended size = 0;
    for (const ReferenceEvent& event : run.events) {
      if (event.time < from || event.time > to) continue;
      size = std::max(size, std::abs(event.after.load_position));
    }
    constexpr int samples = 60;
    for (int i = 0; i <= samples; ++i) {
      size = std::max(size, std::abs(simulator.at(from + (to - from) * i / samples).load_position));
    }
    return static_cast<double>(size);
  };
  check.early = largest(0, until / 100);
  check.late = largest(until * 4 / 5, until);
  check.hunts = !(check.late < 0.1 * std::min(check.early, servo.backlash));
  return check;
}

}  // namespace gearlash::oracle
