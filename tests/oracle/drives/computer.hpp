// The computer of a sampled drive: encoders, controller from sample to sample, delayed output.
#pragma once

#include "plain_drive.hpp"

namespace gearlash::oracle {

/// Positions rad, speeds rad/s, both at the load's shaft.
struct ShaftReadings {
  double motor_position = 0.0;
  double motor_speed = 0.0;
  double load_position = 0.0;
  double load_speed = 0.0;

  bool operator==(const ShaftReadings&) const = default;
};

/// At each sample the computer reads, computes a torque and its next state. The torque takes effect
/// `delay` later and is held; a delay of one period is over as the next sample begins.
class Computer {
 public:
  /// At time 0 its states and torques are 0; the encoder was read as if the speeds had been the
  /// same before.
  Computer(const PlainDrive& drive, const ShaftReadings& shafts);

  /// Reads at 0, period, 2 period, …
  void sample(const ShaftReadings& shafts);
  /// Takes the computed torque into effect: `delay` after each sample, if the delay is between 0
  /// and one period.
  void give_out() { asked_ = computed_; }
  [[nodiscard]] bool gives_out_later() const {
    return drive_.delay > 0.0 && drive_.delay < drive_.period;
  }

  [[nodiscard]] double torque() const;  ///< N m, delivered, within the limit

  bool operator==(const Computer& other) const;  ///< of all numbers that change

 private:
  [[nodiscard]] double read(double position, double step) const;
  double sampled_speed(const ShaftReadings& shafts);
  double cascade(double error, double speed);
  double pid(double error, double speed);
  [[nodiscard]] double integrate(double rate);
  [[nodiscard]] double derivative_part(double error, double speed);

  PlainDrive drive_;
  double last_reading_ = 0.0;
  double integral_ = 0.0;
  double filter_ = 0.0;
  double computed_ = 0.0;
  double asked_ = 0.0;  ///< of the motor, before the limit
};

}  // namespace gearlash::oracle
