// A flight across the gap in fifty digits, by the raw equations of the servo's own numbers:
//   ẏ = v_L, v̇_L = −D v_L, v̇_M = −c v_M − y/J_M.
#pragma once

#include <optional>

#include "base/fifty_digits.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Start of a flight: the gap and the face are placed afterwards.
struct FlightStart {
  NormalizedServo servo;
  double load_position;
  double load_speed;
  double gap_speed;
};

struct WideGap {
  Wide displacement;  ///< u − u₀
  Wide speed;
  Wide acceleration;
};

/// Nothing of it is computed from ServoDynamics.
class RawFlight {
 public:
  explicit RawFlight(const FlightStart& start) : start_(start) {
    const Wide ratio = start.servo.inertia_ratio;
    const Wide friction = 2 * Wide(start.servo.damping);
    const Wide load_share = start.servo.friction_ratio;
    motor_inertia_ = 1 / (1 + ratio);
    motor_rate_ = friction * (1 - load_share) / motor_inertia_;
    load_rate_ = friction * load_share * (1 + ratio) / ratio;
  }

  WideGap at(const Wide& time) const {
    WideMatrix<4> flow{};  // of load position and speed, motor displacement and speed
    flow[0][1] = time;
    flow[1][1] = -time * load_rate_;
    flow[2][3] = time;
    flow[3][0] = -time / motor_inertia_;
    flow[3][3] = -time * motor_rate_;
    const WideMatrix<4> m = exponential(flow);
    const Wide y = start_.load_position;
    const Wide v = start_.load_speed;
    const std::array<Wide, 4> begin{y, v, 0, v + start_.gap_speed};
    std::array<Wide, 4> end{};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) end[i] += m[i][j] * begin[j];
    }
    return {end[2] - (end[0] - y), end[3] - end[1],
            -motor_rate_ * end[3] - end[0] / motor_inertia_ + load_rate_ * end[1]};
  }

  /// The turning point next to a guess.
  std::optional<Wide> turning_near(double guess) const {
    Wide time = guess;
    for (int i = 0; i < 60; ++i) {
      const WideGap here = at(time);
      const Wide step = -here.speed / here.acceleration;
      time += step;
      if (!(time > 0) || !(time < 1e3)) return std::nullopt;
      if (abs(step) < 1e-32 * time) return time;
    }
    return std::nullopt;
  }

 private:
  FlightStart start_;
  Wide motor_inertia_;
  Wide motor_rate_;
  Wide load_rate_;
};

}  // namespace gearlash
