#include "computer.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash::oracle {

Computer::Computer(const PlainDrive& drive, const ShaftReadings& shafts) : drive_(drive) {
  const double position = drive.speed_of_load ? shafts.load_position : shafts.motor_position;
  const double speed = drive.speed_of_load ? shafts.load_speed : shafts.motor_speed;
  last_reading_ = read(position - drive.period * speed, drive.speed_step);
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
  last_reading_ = reading;
  return speed;
}

double Computer::torque() const { return std::clamp(asked_, -drive_.limit, drive_.limit); }

/// The integral at this sample, with `blend` of this sample's rate; then its next value, drawn back
/// by what the limit withholds of the torque computed at the sample before.
double Computer::integrate(double rate) {
  const double period = drive_.period;
  const double now = integral_ + drive_.blend * period * rate;
  integral_ += period * rate;
  if (drive_.controller.tracking_time > 0.0) {
    integral_ += period / drive_.controller.tracking_time *
                 (std::clamp(computed_, -drive_.limit, drive_.limit) - computed_);
  }
  return now;
}

/// − derivative v without a filter. With one, x' = (u − x)/filter by the blended rule, of u = the
/// speed, or derivative (u − x)/filter of u = the error.
double Computer::derivative_part(double error, double speed) {
  const PlainController& gains = drive_.controller;
  if (gains.derivative == 0.0) return 0.0;
  if (gains.filter == 0.0) return -gains.derivative * speed;
  const double input = gains.derivative_of_speed ? speed : error;
  const double share = drive_.period / gains.filter;
  // The implicit part of one step from `filter_`, half of it at this sample.
  const double now = (filter_ + drive_.blend * share * input) / (1.0 + drive_.blend * share);
  filter_ += share * (input - now);
  return gains.derivative_of_speed ? -gains.derivative * now
                                   : gains.derivative / gains.filter * (input - now);
}

double Computer::cascade(double error, double speed) {
  const PlainController& gains = drive_.controller;
  const double speed_error = gains.position * error - speed;
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

void Computer::sample(const ShaftReadings& shafts) {
  const double position =
      read(drive_.reads_load ? shafts.load_position : shafts.motor_position, drive_.step);
  const double error = drive_.reference - position;
  const double speed = sampled_speed(shafts);
  const double before = computed_;
  computed_ = drive_.controller.is_cascade ? cascade(error, speed) : pid(error, speed);
  if (drive_.delay == 0.0) asked_ = computed_;
  if (drive_.delay == drive_.period) asked_ = before;
}

bool Computer::operator==(const Computer& other) const {
  return last_reading_ == other.last_reading_ && integral_ == other.integral_ &&
         filter_ == other.filter_ && computed_ == other.computed_ && asked_ == other.asked_;
}

}  // namespace gearlash::oracle
