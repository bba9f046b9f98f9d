// A drive whose gap leaps as a test commands: its raw equations, by small Runge–Kutta steps.
#pragma once

#include <array>
#include <cmath>
#include <variant>

#include "model/drive.hpp"

namespace gearlash {

/// Rigid faces: both shafts move as one at the commanded gap. Compliant faces without damping: the
/// gap's part within its faces is commanded, and the spring has the rest. A controller is outside.
class LeapingDrive {
 public:
  explicit LeapingDrive(const drive::ReducedDrive& drive) : drive_(drive) {}

  /// `damping`: N m s/rad of a torque −damping v, by which the leap of the sensed position pushes.
  void leap(double change, double damping = 0.0) {
    gap_ += change;
    if (is_sprung()) return;
    const double of_load = -share() * change;
    const double of_motor = change + of_load;
    now_[load] += of_load;
    now_[motor] += of_motor;
    const double sensed = drive_.sensing.load_share_of_speed * of_load +
                          (1.0 - drive_.sensing.load_share_of_speed) * of_motor;
    double push =
        -(drive_.motor.friction.viscous * of_motor + drive_.load.friction.viscous * of_load);
    if (lags()) {
      now_[torque] -=
          (drive_.winding.back_emf * of_motor + damping * sensed) / drive_.winding.time_constant;
    } else {
      push -= damping * sensed;
    }
    now_[motor_speed] += push / inertia();
    now_[load_speed] = now_[motor_speed];
  }

  /// `requested(drive)`: N m.
  template <class Torque>
  void go_on(double time, int steps, const Torque& requested) {
    const double step = time / steps;
    for (int i = 0; i < steps; ++i) {
      const Numbers start = now_;
      const auto slope_at = [&](double share, const Numbers& slope) {
        for (std::size_t k = 0; k < start.size(); ++k) now_[k] = start[k] + share * step * slope[k];
        return slope_of(requested(*this));
      };
      const Numbers a = slope_at(0.0, {});
      const Numbers b = slope_at(0.5, a);
      const Numbers c = slope_at(0.5, b);
      const Numbers d = slope_at(1.0, c);
      for (std::size_t k = 0; k < start.size(); ++k) {
        now_[k] = start[k] + step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
      }
    }
  }

  double load_position() const { return now_[load]; }
  double motor_position() const { return now_[motor]; }
  double sensed_position() const {
    return sensed(drive_.sensing.load_share_of_position, load, motor);
  }
  double counted_position() const {
    return sensed(drive_.sensing.load_share_of_speed, load, motor);
  }
  double sensed_speed() const {
    return sensed(drive_.sensing.load_share_of_speed, load_speed, motor_speed);
  }

 private:
  enum : std::size_t { load, motor, load_speed, motor_speed, torque, count };
  using Numbers = std::array<double, count>;

  bool is_sprung() const { return std::holds_alternative<drive::CompliantContact>(drive_.contact); }
  bool lags() const { return drive_.winding.time_constant > 0.0; }
  double inertia() const { return drive_.motor.inertia + drive_.load.inertia; }
  double share() const { return drive_.motor.inertia / inertia(); }
  double sensed(double of_load, std::size_t on_load, std::size_t on_motor) const {
    return of_load * now_[on_load] + (1.0 - of_load) * now_[on_motor];
  }
  Numbers slope_of(double requested) const {
    Numbers slope{};
    const double delivered = lags() ? now_[torque] : requested;
    const double on_motor = delivered - drive_.motor.friction.viscous * now_[motor_speed];
    const double on_load =
        -drive_.load.friction.viscous * now_[load_speed] - drive_.gravity.stiffness * now_[load];
    slope[load] = now_[load_speed];
    slope[motor] = now_[motor_speed];
    if (is_sprung()) {
      const double mesh = std::get<drive::CompliantContact>(drive_.contact).stiffness *
                          (now_[motor] - now_[load] - gap_);
      slope[motor_speed] = (on_motor - mesh) / drive_.motor.inertia;
      slope[load_speed] = (on_load + mesh) / drive_.load.inertia;
    } else {
      slope[motor_speed] = slope[load_speed] = (on_motor + on_load) / inertia();
    }
    if (lags()) {
      slope[torque] = (requested - drive_.winding.back_emf * now_[motor_speed] - now_[torque]) /
                      drive_.winding.time_constant;
    }
    return slope;
  }

  drive::ReducedDrive drive_;
  Numbers now_{};
  double gap_ = 0.0;
};

}  // namespace gearlash
