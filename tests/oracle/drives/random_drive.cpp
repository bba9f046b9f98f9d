#include "random_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

namespace gearlash::oracle {
namespace {

/// Formulas of its own: those of the standard library's distributions differ by library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }
  /// The logarithm is even; rounded, so that the last bits of a machine's exp do not count.
  double log_between(double low, double high) {
    return rounded(std::exp(between(std::log(low), std::log(high))));
  }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  template <class T, std::size_t n>
  T one_of(const std::array<T, n>& all) {
    return all[static_cast<std::size_t>(between(0.0, static_cast<double>(n)))];
  }

  /// To 24 bits.
  static double rounded(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(mantissa, 24)), exponent - 24);
  }

 private:
  std::mt19937_64 engine_;
};

constexpr double arcmin = std::numbers::pi / 10'800.0;

/// At the motor's shaft, as the rest is scaled from it.
struct Scale {
  double inertia = 0.0;          ///< kg m², motor and load
  double load_inertia = 0.0;     ///< kg m², at the load's shaft
  double rated_torque = 0.0;     ///< N m
  double compliance_rate = 0.0;  ///< rad/s with the motor held; 0: rigid
};

Friction dry_friction(Dice& dice, double torque, double inertia) {
  Friction friction;
  friction.viscous = inertia * dice.log_between(0.1, 2.0);
  friction.coulomb = torque;
  const double factor = dice.between(1.02, 1.5);
  if (dice.chance(0.7)) friction.breakaway = torque * factor;
  return friction;
}

Scale draw_mechanics(Dice& dice, Drive& drive) {
  const double motor_inertia = dice.log_between(1e-5, 3e-3);
  const double ratio = std::nearbyint(dice.log_between(5.0, 160.0));
  const double inertia_ratio = dice.log_between(0.2, 10.0);
  Scale scale;
  scale.load_inertia = inertia_ratio * motor_inertia * ratio * ratio;
  scale.inertia = motor_inertia * (1.0 + inertia_ratio);
  scale.rated_torque = motor_inertia * dice.log_between(3000.0, 15'000.0);
  const double dry = scale.rated_torque * dice.log_between(0.01, 0.1);
  const double motor_share = dice.between(0.2, 0.95);
  drive.motor.inertia = motor_inertia;
  drive.motor.limit = 3.0 * scale.rated_torque;
  drive.motor.friction = dry_friction(dice, motor_share * dry, motor_inertia);
  drive.gearbox = {.ratio = ratio, .backlash = arcmin * dice.log_between(0.5, 10.0)};
  drive.load.inertia = scale.load_inertia;
  drive.load.friction = dry_friction(dice, (1.0 - motor_share) * dry * ratio, scale.load_inertia);
  const double load_torque = scale.rated_torque * ratio * dice.between(-0.4, 0.4);
  if (dice.chance(0.25)) drive.load_torque = load_torque;
  return scale;
}

void draw_contact(Dice& dice, Drive& drive, Scale& scale) {
  const double kind = dice.between(0.0, 1.0);
  const double restitution = dice.between(0.05, 0.7);
  const double rate = 2.0 * std::numbers::pi * dice.log_between(10.0, 80.0);
  const double damping = dice.log_between(0.01, 0.1);
  const bool is_full = dice.chance(0.2);
  if (kind < 0.4) return;  // plastic
  if (kind < 0.65) {
    drive.contact = RigidContact{restitution};
    return;
  }
  scale.compliance_rate = rate;
  CompliantContact faces{.stiffness = scale.load_inertia * rate * rate,
                         .damping = 2.0 * damping * scale.load_inertia * rate};
  if (is_full) faces.law = ContactDamping::full;
  drive.contact = faces;
}

double counts(Dice& dice) { return std::ldexp(1.0, static_cast<int>(dice.between(10.0, 21.0))); }

void draw_sensor(Dice& dice, Drive& drive) {
  constexpr std::array places = {SensorPlace::motor, SensorPlace::motor, SensorPlace::load,
                                 SensorPlace::both};
  drive.sensor.position = dice.one_of(places);
  drive.sensor.encoder.counts_per_turn = counts(dice);
  const double of_speed = counts(dice);
  const bool has_other_speed = dice.chance(0.15);
  if (drive.sensor.position == SensorPlace::both) {
    drive.sensor.speed_encoder.counts_per_turn = of_speed;
  } else if (drive.sensor.position == SensorPlace::load && has_other_speed) {
    drive.sensor.speed = ShaftName::motor;
    drive.sensor.speed_encoder.counts_per_turn = of_speed;
  }
}

void draw_sampling(Dice& dice, Drive& drive) {
  constexpr std::array rates = {1000.0, 2000.0,   4000.0,   5000.0,
                                8000.0, 10'000.0, 16'000.0, 20'000.0};
  constexpr std::array delays = {0.5, 0.75, 1.0};
  Sampling sampling;
  sampling.period = 1.0 / dice.one_of(rates);
  sampling.delay = dice.one_of(delays) * sampling.period;
  const bool has_tachometer = dice.chance(0.1);
  sampling.speed_by_differences = !has_tachometer;
  drive.sampling = sampling;
}

/// Gains at the motor's shaft: speed loop at `rate`, position loop and integral well below.
void draw_cascade(Dice& dice, Drive& drive, const Scale& scale) {
  const double highest = std::min(700.0, 0.2 / drive.sampling->period);
  double rate = highest * dice.log_between(0.15, 1.0);
  if (scale.compliance_rate > 0.0) {
    rate = std::min(rate, scale.compliance_rate * dice.between(0.5, 2.0));
  }
  const double slower = drive.sensor.position == SensorPlace::motor ? 1.0 : 1.5;
  CascadeController cascade;
  cascade.position = rate / (slower * dice.between(3.0, 9.0));
  cascade.speed = scale.inertia * rate;
  const double integral_rate = rate / dice.between(3.0, 12.0);
  cascade.speed_integral = cascade.speed * integral_rate;
  cascade.tracking_time = dice.between(0.5, 2.0) / integral_rate;
  drive.controller = {cascade, GainShaft::motor};
}

void draw_pid(Dice& dice, Drive& drive, const Scale& scale) {
  const double highest = std::min(250.0, 0.06 / drive.sampling->period);
  double rate = highest * dice.log_between(0.15, 1.0);
  if (scale.compliance_rate > 0.0) {
    rate = std::min(rate, scale.compliance_rate * dice.between(0.15, 0.5));
  }
  const double damping = dice.between(0.6, 1.2);
  const double integral_share = dice.between(5.0, 20.0);
  const double filter_share = dice.between(8.0, 20.0);
  PID pid{.terms = PIDTerms::PID};
  pid.proportional = scale.inertia * rate * rate;
  pid.derivative = 2.0 * damping * scale.inertia * rate;
  pid.integral = pid.proportional * rate / integral_share;
  pid.filter = 1.0 / (filter_share * rate);
  pid.tracking_time = dice.between(0.5, 2.0) * integral_share / rate;
  pid.derivative_of_speed = dice.chance(0.5);
  drive.controller = {pid, GainShaft::motor};
}

/// Half of the loads with a constant torque have a weight that gives it, of an arm at some angle.
void draw_gravity(Dice& dice, Drive& drive) {
  if (!drive.load_torque || !dice.chance(0.5)) return;
  const double angle = dice.between(-1.2, 1.2);
  const double torque = std::get<double>(*drive.load_torque);
  drive.load_torque.reset();
  drive.load.gravity = Dice::rounded(std::abs(torque / std::cos(angle)));
  drive.load.gravity_angle = Dice::rounded(torque < 0.0 ? angle : angle + std::numbers::pi);
}

}  // namespace

Drive random_drive(std::uint64_t seed) {
  Dice dice(seed);
  Drive drive;
  Scale scale = draw_mechanics(dice, drive);
  draw_contact(dice, drive, scale);
  draw_sensor(dice, drive);
  draw_sampling(dice, drive);
  if (dice.chance(0.7)) {
    draw_cascade(dice, drive, scale);
  } else {
    draw_pid(dice, drive, scale);
  }
  draw_gravity(dice, drive);
  return drive;
}

Drive continuous_drive(std::uint64_t seed) {
  Drive drive = random_drive(seed);
  drive.sampling.reset();
  drive.sensor.encoder = {};
  drive.sensor.speed_encoder = {};
  if (seed % 2 == 0) {
    drive.motor.friction.breakaway.reset();
    drive.load.friction.breakaway.reset();
  }
  return drive;
}

}  // namespace gearlash::oracle
