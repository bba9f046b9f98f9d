#include "random_servo.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <sstream>

namespace gearlash::oracle {
namespace {

class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t index) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(index),
                           static_cast<std::uint32_t>(index >> 32)};
    engine_.seed(sequence);
  }

  double between(double low, double high) {  // its own formula: std's may differ by library
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }

 private:
  std::mt19937_64 engine_;
};

double on_grid(double angle) { return std::ldexp(std::nearbyint(std::ldexp(angle, 30)), -30); }

double random_damping(Dice& dice) {
  const double share = dice.between(0, 1);
  const double value = dice.between(0, 1.5);
  if (share < 0.05) return 0.0;
  if (share < 0.10) return 1.0;
  if (share < 0.15) return 1.0 + (value - 0.75) * dice.log_between(1e-15, 1e-3);
  return value;
}

double random_inertia_ratio(Dice& dice) {
  const double share = dice.between(0, 1);
  const double value = dice.log_between(1e-6, 1e6);
  if (share < 0.05) return 0.0;
  if (share < 0.10) return std::numeric_limits<double>::infinity();
  return value;
}

double random_friction_ratio(Dice& dice) {
  const double share = dice.between(0, 1);
  const double value = dice.between(0, 1);
  if (share < 0.08) return 0.0;
  if (share < 0.16) return 1.0;
  return value;
}

double random_restitution(Dice& dice) {
  const double share = dice.between(0, 1);
  const double value = dice.between(0, 1);
  if (share < 0.3) return 0.0;
  if (share < 0.4) return 1.0;
  return value;
}

NormalizedServo random_servo(Dice& dice) {
  NormalizedServo servo;
  do {
    servo.damping = random_damping(dice);
    servo.inertia_ratio = random_inertia_ratio(dice);
    servo.friction_ratio = random_friction_ratio(dice);
    servo.backlash = on_grid(dice.log_between(1e-3, 1));
    servo.restitution = random_restitution(dice);
  } while (!faults(servo).empty());
  return servo;
}

/// Speeds that the laws of massless sides do not contradict.
void random_gap_start(Dice& dice, RandomCase& drawn) {
  const NormalizedServo& servo = drawn.servo;
  ServoState& start = drawn.initial;
  const double gap = on_grid(servo.backlash * dice.between(-0.45, 0.45));
  start.motor_position = start.load_position + gap;
  start.load_speed = dice.between(-1, 1);
  start.motor_speed = start.load_speed + servo.backlash * dice.between(-3, 3);
  if (servo.inertia_ratio == 0.0) start.load_speed = 0.0;
  if (std::isinf(servo.inertia_ratio)) {
    const double motor_friction = 2.0 * servo.damping * (1.0 - servo.friction_ratio);
    start.motor_speed = -(start.load_position - drawn.reference) / motor_friction;
  }
}

void random_engaged_start(Dice& dice, RandomCase& drawn) {
  ServoState& start = drawn.initial;
  const double side = dice.between(0, 1) < 0.5 ? -1.0 : 1.0;
  start.motor_position = start.load_position + side * drawn.servo.backlash / 2.0;
  start.load_speed = dice.between(-1, 1);
  start.motor_speed = start.load_speed;
}

}  // namespace

RandomCase random_case(std::uint64_t seed, std::uint64_t index) {
  Dice dice(seed, index);
  RandomCase drawn;
  drawn.servo = random_servo(dice);
  drawn.reference = on_grid(dice.between(-1, 1));
  drawn.initial.load_position = on_grid(dice.between(-0.5, 0.5));
  if (dice.between(0, 1) < 0.5) {
    random_engaged_start(dice, drawn);
  } else {
    random_gap_start(dice, drawn);
  }
  return drawn;
}

std::string describe(const RandomCase& drawn) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "damping " << drawn.servo.damping << ", inertia_ratio " << drawn.servo.inertia_ratio
       << ", friction_ratio " << drawn.servo.friction_ratio << ", backlash " << drawn.servo.backlash
       << ", restitution " << drawn.servo.restitution << ", reference " << drawn.reference
       << ", start (motor " << drawn.initial.motor_position << ", " << drawn.initial.motor_speed
       << "; load " << drawn.initial.load_position << ", " << drawn.initial.load_speed << ")";
  return text.str();
}

}  // namespace gearlash::oracle
