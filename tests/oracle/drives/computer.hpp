// The computer of a sampled drive: encoders, controller from sample to sample, delayed output.
#pragma once

#include <array>
#include <vector>

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
/// `delay` later and is held; results keep their order. A delay of whole periods is over as a
/// sample begins.
class Computer {
 public:
  /// At time 0 its states and torques are 0; the encoder was read as if the speeds had been the
  /// same before.
  Computer(const PlainDrive& drive, const ShaftReadings& shafts);

  /// Reads at 0, period, 2 period, …: `time`, s, of which the reference is.
  void sample(const ShaftReadings& shafts, double time = 0.0);
  /// Takes the oldest torque that waits into effect: `output_after` each sample, if
  /// `gives_out_later`.
  void give_out() { set(asked_, waiting_.front()); }
  [[nodiscard]] bool gives_out_later() const {
    return output_after_ > 0.0 && output_after_ < drive_.period;
  }
  [[nodiscard]] double output_after() const { return output_after_; }  ///< s, 0 … period

  [[nodiscard]] double torque() const { return within_limit(asked_); }  ///< N m, delivered
  /// Whether the last sample or its output changed any number of it.
  [[nodiscard]] bool has_changed() const { return has_changed_; }

 private:
  [[nodiscard]] double within_limit(double torque) const;
  void set(double& number, double value);
  [[nodiscard]] double read(double position, double step) const;
  double sampled_speed(const ShaftReadings& shafts);
  double command(double time);
  double law_error(double error, double speed);
  [[nodiscard]] double asked_speed(double error, double time) const;
  double cascade(double speed);
  double pid(double error, double speed);
  double system(const std::array<double, 3>& inputs);
  double integrate(double rate);
  double low_pass(double input);
  double derivative_part(double error, double speed);
  [[nodiscard]] double feed_forward(double time) const;

  PlainDrive drive_;
  double output_after_ = 0.0;
  double least_rate_ = 0.0;      ///< rad/s, below which the reference stands
  std::vector<double> inverse_;  ///< of I − blend T A
  double last_reading_ = 0.0;
  double integral_ = 0.0;
  double filter_ = 0.0;
  std::vector<double> states_, shifted_;  ///< of a system
  int ticks_ = 0;                         ///< since the position controller's last one
  double error_ = 0.0;                    ///< that the law receives
  double asked_speed_ = 0.0;              ///< rad/s, of a cascade
  double branch_ = 0.0;                   ///< of the band: −1, 0, 1
  double way_ = 0.0;                      ///< of the reference's last motion
  double taken_up_ = 0.0;                 ///< rad
  std::vector<double> waiting_;  ///< results that have not taken effect; the last one at the end
  double asked_ = 0.0;           ///< of the motor, before the limit
  bool has_changed_ = true;
};

}  // namespace gearlash::oracle
