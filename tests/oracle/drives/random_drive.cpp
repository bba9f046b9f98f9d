#include "random_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

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

enum class Law : std::uint8_t { cascade, pid };

Scale draw_drive(Dice& dice, Drive& drive, std::optional<Law> law = {}) {
  Scale scale = draw_mechanics(dice, drive);
  draw_contact(dice, drive, scale);
  draw_sensor(dice, drive);
  draw_sampling(dice, drive);
  const Law drawn = dice.chance(0.7) ? Law::cascade : Law::pid;
  if (law.value_or(drawn) == Law::cascade) {
    draw_cascade(dice, drive, scale);
  } else {
    draw_pid(dice, drive, scale);
  }
  draw_gravity(dice, drive);
  return scale;
}

void take_computer_away(Drive& drive) {
  drive.sampling.reset();
  drive.sensor.encoder = {};
  drive.sensor.speed_encoder = {};
}

void let_friction_fall(Dice& dice, Friction& friction, double speed) {
  friction.breakaway = friction.coulomb * dice.between(1.05, 1.6);
  friction.stribeck_speed = speed;
}

Drive filtered_cascade(Dice& dice) {
  Drive drive;
  draw_drive(dice, drive, Law::cascade);
  auto& cascade = std::get<CascadeController>(drive.controller.law);
  const double inertia =
      drive.motor.inertia + drive.load.inertia / (drive.gearbox.ratio * drive.gearbox.ratio);
  cascade.filter = inertia / cascade.speed / dice.between(2.5, 10.0);
  const double speed = dice.log_between(0.1, 30.0);  // of the motor
  let_friction_fall(dice, drive.motor.friction, speed);
  let_friction_fall(dice, drive.load.friction, speed / drive.gearbox.ratio);
  return drive;
}

Drive weight_at_limit(Dice& dice) {
  Drive drive;
  draw_drive(dice, drive, Law::pid);
  drive.load_torque.reset();
  drive.load.gravity = *drive.motor.limit * drive.gearbox.ratio * dice.between(0.05, 0.4);
  drive.load.gravity_angle = dice.between(-1.2, 1.2);
  const double holding = drive.load.gravity * std::cos(drive.load.gravity_angle);
  drive.motor.limit = Dice::rounded(holding / drive.gearbox.ratio / dice.between(0.6, 1.1));
  const double step = drive.sensor.encoder.counts_per_turn
                          ? 2.0 * std::numbers::pi / *drive.sensor.encoder.counts_per_turn
                          : 0.0;
  const double counts = std::nearbyint(dice.between(1.0, 5.0));
  if (dice.chance(0.5)) drive.controller.dead_band.width = counts * step;
  if (dice.chance(0.3) && drive.controller.dead_band.width > 0.0) {
    drive.controller.dead_band.form = DeadBandForm::whole;
    drive.controller.dead_band.hysteresis = 0.2 * drive.controller.dead_band.width;
  }
  if (dice.chance(0.3)) drive.controller.compensation.friction = drive.motor.friction.coulomb;
  if (dice.chance(0.3)) {
    drive.controller.compensation.backlash = drive.gearbox.backlash * dice.between(0.3, 1.2);
  }
  return drive;
}

/// x′ = A x + B u, y = C x + D u, of one input and output.
struct System {
  std::vector<std::vector<double>> A{};
  std::vector<double> B{}, C{};
  double D = 1.0;
};

/// `second` receives the output of `first`.
System in_series(const System& first, const System& second) {
  const std::size_t n = first.A.size();
  const std::size_t m = second.A.size();
  System all{.A = std::vector(n + m, std::vector(n + m, 0.0)), .B = first.B};
  for (std::size_t i = 0; i < n; ++i) {
    std::copy(first.A[i].begin(), first.A[i].end(), all.A[i].begin());
    all.C.push_back(second.D * first.C[i]);
  }
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < n; ++j) all.A[n + i][j] = second.B[i] * first.C[j];
    std::copy(second.A[i].begin(), second.A[i].end(),
              all.A[n + i].begin() + static_cast<std::ptrdiff_t>(n));
    all.B.push_back(second.B[i] * first.D);
    all.C.push_back(second.C[i]);
  }
  all.D = first.D * second.D;
  return all;
}

/// (s + zero)/(s + pole), scaled to the gain 1 at high frequencies.
System first_order(double zero, double pole) {
  return {.A = {{-pole}}, .B = {1.0}, .C = {zero - pole}, .D = 1.0};
}

/// (s² + 2 shallow rate s + rate²)/(s² + 2 wide rate s + rate²).
System notch(double rate, double shallow, double wide) {
  return {.A = {{0.0, 1.0}, {-rate * rate, -2.0 * wide * rate}},
          .B = {0.0, 1.0},
          .C = {0.0, 2.0 * (shallow - wide) * rate},
          .D = 1.0};
}

/// Integral and filtered derivative, then up to two notches above the loop's rate.
Drive state_space(Dice& dice) {
  Drive drive;
  Scale scale = draw_mechanics(dice, drive);
  const double motor_inertia = drive.motor.inertia;
  const double inertia_ratio = dice.log_between(0.02, 50.0);
  const double square = drive.gearbox.ratio * drive.gearbox.ratio;
  drive.load.inertia = inertia_ratio * motor_inertia * square;
  scale.inertia = motor_inertia * (1.0 + inertia_ratio);
  drive.contact = RigidContact{dice.between(0.0, 0.9)};
  draw_sensor(dice, drive);
  draw_sampling(dice, drive);
  const double rate = std::min(150.0, 0.03 / drive.sampling->period) * dice.log_between(0.1, 1.0);
  const double integral_rate = dice.chance(0.7) ? rate / dice.between(8.0, 20.0) : 0.0;
  const double lead = dice.between(3.0, 6.0);
  System all = first_order(rate / lead, rate * lead);
  all = in_series(all, first_order(integral_rate, integral_rate > 0.0 ? 0.0 : 3.0 * lead * rate));
  const int notches = static_cast<int>(dice.between(0.0, 3.0));
  for (int i = 0; i < notches; ++i) {
    const double wide = dice.between(0.3, 0.8);
    all = in_series(all, notch(rate * dice.between(4.0, 10.0), 0.2 * wide, wide));
  }
  for (std::vector<double>& row : all.A) {
    for (double& value : row) value += 0.0;  // no −0, which a file does not keep
  }
  StateSpaceController law{.gain = scale.inertia * rate * rate * lead, .A = all.A};
  for (const double one : all.B) law.B.push_back({one});
  law.C = all.C;
  law.D = {all.D};
  drive.controller = {law, GainShaft::motor};
  return drive;
}

void draw_reference(Dice& dice, Drive& drive) {
  const double gap = drive.gearbox.backlash;
  const double way = gap * dice.log_between(0.3, 1000.0);
  const double rate = 2.0 * std::numbers::pi * dice.log_between(0.05, 5.0);
  const double kind = dice.between(0.0, 1.0);
  if (kind < 0.4 || (kind < 0.7 && drive.load.gravity > 0.0)) {  // a ramp has no gravity
    drive.reference = SineSignal{.amplitude = way, .frequency = rate};
  } else if (kind < 0.7) {
    drive.reference = RampSignal{.rate = way * rate};
  } else {
    drive.reference =
        TrapezoidSignal{.to = way, .speed = way * rate, .acceleration = 4.0 * way * rate * rate};
  }
}

Drive moving_reference(Dice& dice) {
  Drive drive;
  draw_drive(dice, drive);
  draw_reference(dice, drive);
  return drive;
}

Drive two_rates(Dice& dice) {
  Drive drive;
  const Scale scale = draw_drive(dice, drive, Law::cascade);
  auto& cascade = std::get<CascadeController>(drive.controller.law);
  const double rate = cascade.speed / scale.inertia;
  if (dice.chance(0.7)) {
    drive.motor.kind = TorqueControl{.current_bandwidth = rate * dice.log_between(4.0, 30.0)};
  }
  const double ticks = std::floor(dice.between(1.0, 9.0));
  cascade.position /= std::sqrt(ticks);
  drive.sampling->position_period = ticks * drive.sampling->period;
  if (dice.chance(0.5)) {
    const double length =
        drive.gearbox.backlash * drive.gearbox.ratio * dice.log_between(0.3, 30.0);
    cascade.speed_limit = Dice::rounded(cascade.position * length);
  }
  if (dice.chance(0.5)) draw_reference(dice, drive);
  if (dice.chance(0.5)) cascade.speed_feedforward = Dice::rounded(dice.between(0.0, 1.0));
  if (dice.chance(0.3)) cascade.acceleration_feedforward = scale.inertia;
  return drive;
}

Drive without_integral(Dice& dice) {
  Drive drive;
  draw_drive(dice, drive, Law::pid);
  auto& pid = std::get<PID>(drive.controller.law);
  pid.terms = PIDTerms::PD;
  pid.integral = pid.tracking_time = 0.0;
  pid.derivative_of_speed = true;
  drive.contact = RigidContact{dice.chance(0.5) ? 0.0 : dice.between(0.1, 0.7)};
  drive.load_torque.reset();
  drive.load.gravity = 0.0;
  const double torque = *drive.motor.limit * drive.gearbox.ratio * dice.between(-0.3, 0.3);
  const double kind = dice.between(0.0, 3.0);
  if (kind < 1.0) {
    drive.controller.dead_band.width = drive.gearbox.backlash * dice.log_between(0.1, 3.0);
  } else if (kind < 2.0) {
    drive.load_torque = Dice::rounded(torque);
  } else {
    drive.load.gravity = Dice::rounded(std::abs(torque));
    drive.load.gravity_angle = dice.between(-1.2, 1.2);
  }
  return drive;
}

void multiply_gains(double factor, Controller& controller) {
  if (auto* cascade = std::get_if<CascadeController>(&controller.law)) {
    cascade->position *= factor;
    cascade->speed *= factor;
    cascade->speed_integral *= factor * factor;
  } else if (auto* pid = std::get_if<PID>(&controller.law)) {
    pid->proportional *= factor;
    pid->integral *= factor * factor;
    pid->derivative *= factor;
  }
}

Drive extreme(Dice& dice) {
  Drive drive;
  draw_drive(dice, drive);
  const double kind = dice.between(0.0, 4.0);
  if (kind < 1.0) {
    drive.gearbox.backlash = 1e-6;
  } else if (kind < 2.0) {
    const double counts = 2.0 * std::numbers::pi / drive.gearbox.backlash / dice.between(1.5, 30.0);
    drive.sensor.position = SensorPlace::load;
    drive.sensor.speed.reset();
    drive.sensor.speed_encoder = {};
    drive.sensor.encoder.counts_per_turn = std::ceil(counts);
  } else if (kind < 3.0) {
    multiply_gains(dice.log_between(3.0, 30.0), drive.controller);
  } else {
    drive.sampling->delay = drive.sampling->period * dice.between(1.0, 8.0);
  }
  return drive;
}

Drive drawn(Dice& dice, DriveKind kind) {
  switch (kind) {
    case DriveKind::filtered_cascade:
      return filtered_cascade(dice);
    case DriveKind::weight_at_limit:
      return weight_at_limit(dice);
    case DriveKind::state_space:
      return state_space(dice);
    case DriveKind::moving_reference:
      return moving_reference(dice);
    case DriveKind::two_rates:
      return two_rates(dice);
    case DriveKind::without_integral:
      return without_integral(dice);
    case DriveKind::extreme:
      return extreme(dice);
    case DriveKind::industrial:
      break;
  }
  Drive drive;
  draw_drive(dice, drive);
  return drive;
}

}  // namespace

Drive random_drive(std::uint64_t seed) { return random_drive(seed, DriveKind::industrial); }

Drive random_drive(std::uint64_t seed, DriveKind kind) {
  Dice dice(seed);
  Drive drive = drawn(dice, kind);
  // The industrial ones have continuous_drive(); steps and delays need a computer.
  const bool has_both = kind != DriveKind::industrial && kind != DriveKind::extreme;
  if (has_both && seed % 2 == 0) take_computer_away(drive);
  return drive;
}

Drive frictionless_drive(std::uint64_t seed) {
  Dice dice(seed);
  Drive drive;
  drive.motor.inertia = 1e-4;
  drive.gearbox = {.ratio = std::nearbyint(dice.log_between(5.0, 160.0)),
                   .backlash = arcmin * dice.log_between(0.5, 10.0)};
  const double square = drive.gearbox.ratio * drive.gearbox.ratio;
  const double inertia_ratio = dice.log_between(0.1, 10.0);
  drive.load.inertia = inertia_ratio * drive.motor.inertia * square;
  drive.contact = RigidContact{dice.between(0.0, 0.9)};
  const double rate = 2.0 * std::numbers::pi * dice.log_between(1.0, 30.0);
  const double damping = dice.log_between(0.02, 1.0);
  const double inertia = drive.motor.inertia * square * (1.0 + inertia_ratio);
  PID pid{.terms = PIDTerms::PD};
  pid.proportional = inertia * rate * rate;
  pid.derivative = 2.0 * damping * inertia * rate;
  pid.filter = 1.0 / (rate * dice.between(5.0, 30.0));
  drive.controller = {pid, GainShaft::load};
  return drive;
}

Drive continuous_drive(std::uint64_t seed) {
  Drive drive = random_drive(seed);
  take_computer_away(drive);
  if (seed % 2 == 0) {
    drive.motor.friction.breakaway.reset();
    drive.load.friction.breakaway.reset();
  }
  return drive;
}

}  // namespace gearlash::oracle
