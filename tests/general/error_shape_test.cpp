// Relays, dead bands and compensations of the error, beside closed forms and small steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "controllers.hpp"
#include "drives.hpp"

namespace gearlash::drive::error_shape_test {
namespace {

constexpr double inertia = 2.0;
constexpr double friction = 0.3;

const Shaft motor{inertia, {.viscous = friction}};

ErrorShape relay(double width, double hysteresis) {
  return {.begins = width + hysteresis,
          .ends = width - hysteresis,
          .inner_gain = 0.0,
          .outer_gain = 0.0,
          .offset = 1.0,
          .jumps = true};
}

/// The motor by Runge and Kutta's method, its torque a function of the error that may remember.
std::vector<double> positions_by_steps(const std::function<double(double)>& torque_of_error,
                                       double start, double every, int count) {
  constexpr int steps = 20'000;  // in `every`
  const double step = every / steps;
  double position = start, speed = 0.0;
  std::vector<double> positions;
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < steps; ++k) {
      // The speed by the trapezoidal rule with the torque at the middle.
      const double torque = torque_of_error(-(position + 0.5 * step * speed));
      const double next =
          (speed * (1.0 - 0.5 * step * friction / inertia) + step * torque / inertia) /
          (1.0 + 0.5 * step * friction / inertia);
      position += 0.5 * step * (speed + next);
      speed = next;
    }
    positions.push_back(position);
  }
  return positions;
}

struct Shaped {
  const char* name;
  ErrorShape shape;
};

std::vector<Shaped> shapes() {
  return {{"dead band", {.begins = 0.2, .ends = 0.2, .inner_gain = 0.0, .offset = -0.2}},
          {"whole error", {.begins = 0.25, .ends = 0.1, .inner_gain = 0.0, .jumps = true}},
          {"backlash compensation",
           {.begins = 0.1, .ends = 0.1, .inner_gain = 1.0 + 0.3 / 0.1, .offset = 0.3}},
          {"relay of three levels", relay(0.2, 0.1)},
          {"relay of two levels", relay(0.0, 0.1)},
          {"relay that overlaps", relay(0.1, 0.15)}};
}

TEST(OracleErrorShape, MovesAsSmallStepsDo) {
  for (const auto& [name, shape] : shapes()) {
    ReducedDrive drive = lone_motor(motor);
    drive.controller = at_load(PID{.proportional = 4.0});
    drive.error_shape = shape;
    const auto motion = moved(drive, {.motor_position = 1.0}, 20.0);
    int branch = shape.is_two_level() ? -1 : 0;
    const auto torque = [&, &shape = shape](double error) {
      for (int turn = 0; turn < 2; ++turn) {  // a branch may end where the other one begins
        if (branch != 0 && branch * error < shape.ends) branch = shape.is_two_level() ? -branch : 0;
        if (branch == 0 && std::abs(error) > shape.begins) branch = error > 0.0 ? 1 : -1;
      }
      return 4.0 * (branch == 0 ? shape.inner_gain * error
                                : shape.outer_gain * error + branch * shape.offset);
    };
    const std::vector<double> expected = positions_by_steps(torque, 1.0, 1.0, 20);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double time = static_cast<double>(i + 1);
      // A switch of a step is late by up to a step of 5e-5 s, which adds up over the switches.
      EXPECT_NEAR(motion.at(time).numbers[motor_position], expected[i], shape.jumps ? 2e-3 : 1e-7)
          << name << " at " << time;
    }
    EXPECT_GT(motion.events().size(), 3U) << name;
  }
}

/// By hand, from sample to sample: reading, branch, torque; held.
TEST(OracleErrorShape, IsARecursionFromSampleToSample) {
  constexpr double period = 0.1;
  for (const double delay : {0.0, 0.03, period, 0.25}) {
    for (const auto& [name, shape] : shapes()) {
      ReducedDrive drive = lone_motor({inertia});
      drive.controller = at_load(PID{PIDTerms::PD, 4.0, 0.0, 3.0});
      drive.error_shape = shape;
      drive.sampling = Sampling{.period = period, .delay = delay};
      drive.sensing.resolution = drive.sensing.resolution_of_speed = 0.013;
      drive.torque_limit = 2.0;
      drive.reference = 1.0;
      const auto motion = moved(drive, {.motor_position = 0.2, .motor_speed = 0.3}, 20.0);
      const auto read = [](double value) { return 0.013 * std::round(value / 0.013); };
      double position = 0.2, speed = 0.3, last = read(0.2 - period * 0.3), given = 0.0;
      const auto coast = [&](double time) {
        position += time * (speed + 0.25 * time * given);
        speed += 0.5 * time * given;
      };
      std::vector<double> waiting(static_cast<std::size_t>(delay / period), 0.0);
      const double rest = delay - static_cast<double>(waiting.size()) * period;
      int branch = shape.is_two_level() ? 1 : 0;
      for (int sample = 0; sample < 190; ++sample) {
        const double reading = read(position);
        const double error = 1.0 - reading;
        const auto is_beyond = [&, &shape = shape](int way) {
          return way * error > (branch == way ? shape.ends : shape.begins);
        };
        const int stays = shape.is_two_level() ? branch : 0;
        branch = is_beyond(1) ? 1 : is_beyond(-1) ? -1 : stays;
        const double shaped = branch == 0 ? shape.inner_gain * error
                                          : shape.outer_gain * error + branch * shape.offset;
        waiting.push_back(4.0 * shaped - 3.0 * (reading - last) / period);
        last = reading;
        coast(rest);
        given = std::clamp(waiting.front(), -2.0, 2.0);
        waiting.erase(waiting.begin());
        coast(period - rest);
        const hybrid::Vector numbers = motion.at(period * (sample + 1)).numbers;
        ASSERT_NEAR(numbers[motor_position], position, 2e-12) << name << ' ' << delay << sample;
        ASSERT_NEAR(numbers[motor_speed], speed, 2e-12) << name << ' ' << delay << sample;
      }
    }
  }
}

TEST(EdgeErrorShape, ThatMaySwitchWithoutEndIsRefused) {
  ReducedDrive drive = lone_motor(motor);
  drive.controller = at_load(PID{.proportional = 4.0});
  drive.error_shape = relay(0.1, 0.0);
  ASSERT_EQ(faults(drive).size(), 1U);
  EXPECT_EQ(faults(drive)[0].path, "error_shape.hysteresis");
  drive.sampling = Sampling{.period = 0.01};
  EXPECT_TRUE(faults(drive).empty());
}

}  // namespace
}  // namespace gearlash::drive::error_shape_test
