#include "computer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace gearlash::oracle {
namespace {

/// (I − share A)⁻¹ by Gauss and Jordan's elimination with row pivots.
std::vector<double> inverse_about_one(const std::vector<double>& A, std::size_t order,
                                      double share) {
  std::vector<double> left(order * order);
  std::vector<double> right(order * order, 0.0);
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = -share * A[i];
  for (std::size_t i = 0; i < order; ++i) {
    left[i * order + i] += 1.0;
    right[i * order + i] = 1.0;
  }
  for (std::size_t column = 0; column < order; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < order; ++row) {
      if (std::abs(left[row * order + column]) > std::abs(left[pivot * order + column]))
        pivot = row;
    }
    const double by = left[pivot * order + column];
    for (std::size_t j = 0; j < order; ++j) {
      std::swap(left[pivot * order + j], left[column * order + j]);
      std::swap(right[pivot * order + j], right[column * order + j]);
      left[column * order + j] /= by;
      right[column * order + j] /= by;
    }
    for (std::size_t row = 0; row < order; ++row) {
      const double times = row == column ? 0.0 : left[row * order + column];
      for (std::size_t j = 0; times != 0.0 && j < order; ++j) {
        left[row * order + j] -= times * left[column * order + j];
        right[row * order + j] -= times * right[column * order + j];
      }
    }
  }
  return right;
}

}  // namespace

Computer::Computer(const PlainDrive& drive, const ShaftReadings& shafts)
    : drive_(drive), least_rate_(1e-9 * drive.reference_course.fastest()) {
  const double position = drive.speed_of_load ? shafts.load_position : shafts.motor_position;
  const double speed = drive.speed_of_load ? shafts.load_speed : shafts.motor_speed;
  last_reading_ = read(position - drive.period * speed, drive.speed_step);
  const PlainSystem& system = drive.controller.system;
  if (!system.is_sampled) {
    inverse_ = inverse_about_one(system.A, system.C.size(), drive.blend * drive.period);
  }
  states_.assign(system.C.size(), 0.0);
  shifted_ = states_;
  constexpr double rounding = 1e-12;
  const double periods = drive.delay > 0.0 ? drive.delay / drive.period : 0.0;
  const double whole = std::max(0.0, std::ceil(periods * (1.0 - rounding)) - 1.0);
  waiting_.assign(static_cast<std::size_t>(whole) + 1, 0.0);
  output_after_ = drive.delay - whole * drive.period;
  if (output_after_ >= drive.period * (1.0 - rounding)) output_after_ = drive.period;
}

double Computer::within_limit(double torque) const {
  return std::clamp(torque, -drive_.limit, drive_.limit);
}

void Computer::set(double& number, double value) {
  if (number != value) has_changed_ = true;
  number = value;
}

double Computer::read(double position, double step) const {
  return step > 0.0 ? step * std::round(position / step) : position;  // halves away from 0
}

double Computer::sampled_speed(const ShaftReadings& shafts) {
  const double exact = drive_.speed_of_load ? shafts.load_speed : shafts.motor_speed;
  if (drive_.has_tachometer) return exact;
  const double reading =
      read(drive_.speed_of_load ? shafts.load_position : shafts.motor_position, drive_.speed_step);
  const double speed = (reading - last_reading_) / drive_.period;
  set(last_reading_, reading);
  return speed;
}

/// The reference, and half of the assumed gap on the side of its last motion. With a lag
/// take_up_time a′ = ± half − a between samples, whose middle gives the side.
double Computer::command(double time) {
  if (!drive_.reference_course.moves()) return drive_.reference;
  const PlainController& gains = drive_.controller;
  const double half = gains.reference_half_gap;
  const auto turn = [&](double when) {
    const double rate = drive_.reference_course.rate_at(when);
    if (std::abs(rate) > least_rate_) set(way_, rate > 0.0 ? 1.0 : -1.0);
  };
  if (half != 0.0 && gains.take_up_time > 0.0 && time > 0.0) {
    turn(time - 0.5 * drive_.period);
    const double kept = std::exp(-drive_.period / gains.take_up_time);
    set(taken_up_, way_ * half + kept * (taken_up_ - way_ * half));
  }
  if (half != 0.0) turn(time);
  return drive_.reference_at(time) + (gains.take_up_time > 0.0 ? taken_up_ : way_ * half);
}

/// Errors of whole counts are compared without their rounding.
double Computer::law_error(double error, double speed) {
  const PlainController& gains = drive_.controller;
  if (gains.rule == PlainErrorRule::as_it_is) return error;
  if (gains.rule == PlainErrorRule::take_up)
    return error + gains.half_gap * std::clamp(error / gains.width, -1.0, 1.0);
  const bool is_of_speed = gains.rule == PlainErrorRule::relay_of_speed;
  const double rounding = is_of_speed ? 0.0 : 1e-9 * drive_.step;
  if (gains.rule == PlainErrorRule::excess) {
    if (std::abs(error) <= gains.width + rounding) return 0.0;
    return error - std::clamp(error, -gains.width, gains.width);
  }
  const bool is_relay = gains.rule != PlainErrorRule::whole;
  const double input = is_of_speed ? -speed : error;
  const bool has_two_levels = is_relay && gains.width == 0.0;
  double branch = has_two_levels ? branch_ : 0.0;
  if (has_two_levels && branch == 0.0) branch = input >= 0.0 ? 1.0 : -1.0;
  for (const double way : {1.0, -1.0}) {
    const double hysteresis = branch_ == way ? -gains.hysteresis : gains.hysteresis;
    if (way * input > gains.width + hysteresis + rounding) branch = way;
  }
  set(branch_, branch);
  if (is_relay) return branch;
  return branch == 0.0 ? 0.0 : error;
}

/// The integral at this sample, with `blend` of this sample's rate; then its next value, drawn back
/// by what the limit withholds of the torque computed at the sample before.
double Computer::integrate(double rate) {
  const double period = drive_.period;
  const double now = integral_ + drive_.blend * period * rate;
  double next = integral_ + period * rate;
  if (drive_.controller.tracking_time > 0.0) {
    const double computed = waiting_.back();
    next += period / drive_.controller.tracking_time * (within_limit(computed) - computed);
  }
  set(integral_, next);
  return now;
}

/// x' = (u − x)/filter by the blended rule: the implicit part of one step, half of it at this
/// sample.
double Computer::low_pass(double input) {
  const double share = drive_.period / drive_.controller.filter;
  const double now = (filter_ + drive_.blend * share * input) / (1.0 + drive_.blend * share);
  set(filter_, filter_ + share * (input - now));
  return now;
}

/// − derivative v without a filter. With one, of the speed; or derivative (u − x)/filter of the
/// filtered error.
double Computer::derivative_part(double error, double speed) {
  const PlainController& gains = drive_.controller;
  if (gains.derivative == 0.0) return 0.0;
  if (gains.filter == 0.0) return -gains.derivative * speed;
  if (gains.derivative_of_speed) return -gains.derivative * low_pass(speed);
  return gains.derivative / gains.filter * (error - low_pass(error));
}

double Computer::asked_speed(double error, double time) const {
  const PlainController& gains = drive_.controller;
  const double rate = drive_.reference_course.rate_at(time);
  return std::clamp(gains.position * error + gains.speed_share * rate, -gains.speed_limit,
                    gains.speed_limit);
}

double Computer::cascade(double speed) {
  const PlainController& gains = drive_.controller;
  const double filtered = gains.filter > 0.0 ? low_pass(speed) : speed;
  const double speed_error = asked_speed_ - filtered;
  const double direct = gains.proportional * speed_error;
  if (gains.integral == 0.0) return direct;
  return direct + integrate(gains.integral * speed_error);
}

double Computer::pid(double error, double speed) {
  const PlainController& gains = drive_.controller;
  double torque = gains.proportional * error + derivative_part(error, speed);
  if (gains.integral != 0.0) torque += integrate(gains.integral * error);
  return torque;
}

/// By the blended rule x = z + blend T x′, z⁺ = z + T x′, as of the integral: so
/// x = (I − blend T A)⁻¹ (z + blend T B u) and z⁺ = z + (x − z)/blend.
double Computer::system(const std::array<double, 3>& inputs) {
  const PlainSystem& law = drive_.controller.system;
  const std::size_t order = states_.size();
  const auto of_inputs = [&](const std::array<double, 3>& row) {
    return row[0] * inputs[0] + row[1] * inputs[1] + row[2] * inputs[2];
  };
  const auto of_numbers = [&](const std::vector<double>& matrix, std::size_t row) {
    double sum = 0.0;
    for (std::size_t j = 0; j < order; ++j) sum += matrix[row * order + j] * shifted_[j];
    return sum;
  };
  const double blend = law.is_sampled ? 0.0 : drive_.blend;
  for (std::size_t i = 0; i < order; ++i) {
    shifted_[i] = states_[i];
    if (blend > 0.0) shifted_[i] += blend * drive_.period * of_inputs(law.B[i]);
  }
  double torque = of_inputs(law.D);
  for (std::size_t i = 0; i < order; ++i) {
    const double before = states_[i];
    const double now = blend > 0.0 ? of_numbers(inverse_, i) : before;
    torque += law.C[i] * now;
    if (blend > 0.0) {
      set(states_[i], before + (now - before) / blend);
    } else {
      const double next = of_numbers(law.A, i) + of_inputs(law.B[i]);
      set(states_[i], law.is_sampled ? next : before + drive_.period * next);
    }
  }
  return torque;
}

/// Of the reference's motion.
double Computer::feed_forward(double time) const {
  const PlainController& gains = drive_.controller;
  const double of_inertia =
      gains.inertia == 0.0 ? 0.0 : gains.inertia * drive_.reference_course.acceleration_at(time);
  if (gains.friction == 0.0) return of_inertia;
  const double rate = drive_.reference_course.rate_at(time);
  if (gains.friction_speed > least_rate_)
    return of_inertia + gains.friction * std::clamp(rate / gains.friction_speed, -1.0, 1.0);
  return of_inertia + (std::abs(rate) > least_rate_ ? std::copysign(gains.friction, rate) : 0.0);
}

void Computer::sample(const ShaftReadings& shafts, double time) {
  has_changed_ = false;
  const double position =
      read(drive_.reads_load ? shafts.load_position : shafts.motor_position, drive_.step);
  const double asked = command(time);
  const double speed = sampled_speed(shafts);
  const PlainController& gains = drive_.controller;
  if (ticks_ == 0) {
    set(error_, law_error(asked - position, speed));
    set(asked_speed_, asked_speed(error_, time));
  }
  ticks_ = (ticks_ + 1) % gains.position_ticks;
  const bool is_shaped = gains.rule != PlainErrorRule::as_it_is;
  const double computed = (gains.law == PlainLaw::cascade ? cascade(speed)
                           : gains.law == PlainLaw::PID   ? pid(error_, speed)
                           : is_shaped                    ? system({error_, 0.0, speed})
                                                          : system({asked, position, speed})) +
                          feed_forward(time);
  if (output_after_ == drive_.period) set(asked_, waiting_.front());
  for (std::size_t i = 0; i + 1 < waiting_.size(); ++i) set(waiting_[i], waiting_[i + 1]);
  set(waiting_.back(), computed);
  if (output_after_ == 0.0) set(asked_, computed);
}

}  // namespace gearlash::oracle
