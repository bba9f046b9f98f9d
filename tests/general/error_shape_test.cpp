// Relays, dead bands and compensations of the error, beside closed forms and small steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "general/assemble/drive_system.hpp"

namespace gearlash::drive::error_shape_test {
namespace {

constexpr double inertia = 2.0;
constexpr double friction = 0.3;

/// A motor by itself, far from both faces.
ReducedDrive lone_motor() {
  ReducedDrive drive;
  drive.motor = {inertia, {.viscous = friction}};
  drive.load = {1.0, {.viscous = 0.1}};
  drive.backlash = 1e6;
  drive.sensing = {.load_share_of_position = 0.0};
  return drive;
}

ErrorShape relay(double width, double hysteresis) {
  return {.begins = width + hysteresis,
          .ends = width - hysteresis,
          .inner_gain = 0.0,
          .outer_gain = 0.0,
          .offset = 1.0,
          .jumps = true};
}

hybrid::Trajectory run(const ReducedDrive& drive, const ShaftStates& start, double until) {
  const DriveSystem built = drive_system(drive);
  return simulate(built.system, drive_start(drive, built, start), {.until = until});
}

/// Times of the events after a time.
std::vector<double> times_after(const hybrid::Trajectory& motion, double after) {
  std::vector<double> times;
  for (const hybrid::Event& event : motion.events()) {
    if (event.time > after) times.push_back(event.time);
  }
  return times;
}

/// Half a period of J x″ + F x′ = ±M that switches at x = ∓h (Tsypkin): from the speed −v to v the
/// way is 2 h.
double half_period(double level, double hysteresis) {
  const double time_constant = inertia / friction;
  const auto way = [&](double time) {
    const double decay = std::exp(-time / time_constant);
    const double start = -level / friction * (1.0 - decay) / (1.0 + decay);
    return level / friction * time + (start - level / friction) * time_constant * (1.0 - decay);
  };
  double low = 0.0, high = 1e4;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (way(middle) < 2.0 * hysteresis ? low : high) = middle;
  }
  return low;
}

TEST(OracleRelay, WithHysteresisHasTsypkinsPeriod) {
  for (const auto& [level, hysteresis] :
       {std::pair{1.0, 0.1}, std::pair{0.5, 0.4}, std::pair{3.0, 0.02}}) {
    ReducedDrive drive = lone_motor();
    drive.controller = ProportionalDerivative{.proportional = level};
    drive.error_shape = relay(0.0, hysteresis);
    const double half = half_period(level, hysteresis);
    const auto motion = run(drive, {.motor_position = 0.1}, 400.0 * half);
    const std::vector<double> times = times_after(motion, 300.0 * half);
    ASSERT_GT(times.size(), 50U);
    const double mean = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    EXPECT_NEAR(mean, half, 1e-9 * half) << level;
  }
}

/// A relay of the speed without friction: the speed is a triangle between ±β, the position of the
/// motor an arc of the height J β²/(2 M) either way, and the load is never met in a gap that is
/// wider (the cycle within the gap of Ruderman, Yamada and Fujimoto, arXiv 1802.06246).
TEST(OracleRelay, OfTheSpeedSwingsWithinTheGap) {
  constexpr double level = 0.7;
  constexpr double threshold = 0.4;
  ReducedDrive drive = lone_motor();
  drive.motor.friction.viscous = 0.0;
  drive.sensing.load_share_of_speed = 0.0;
  drive.controller = ProportionalDerivative{.proportional = level};
  drive.error_shape = relay(0.0, threshold);
  drive.error_shape.is_of_speed = true;
  const double height = inertia * threshold * threshold / level;
  drive.backlash = 2.5 * height;
  const double period = 4.0 * inertia * threshold / level;
  const auto motion = run(drive, {.motor_speed = -threshold}, 20.2 * period);
  const std::vector<double> times = times_after(motion, 0.0);
  ASSERT_EQ(times.size(), 40U);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], 0.5 * period * static_cast<double>(i + 1), 1e-11);
  }
  EXPECT_NEAR(motion.at(0.25 * period).numbers[motor_position], -0.5 * height, 1e-14);
  EXPECT_NEAR(motion.at(0.75 * period).numbers[motor_position], 0.5 * height, 1e-13);
  EXPECT_EQ(motion.end().numbers[load_position], 0.0);
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
    ReducedDrive drive = lone_motor();
    drive.controller = ProportionalDerivative{.proportional = 4.0};
    drive.error_shape = shape;
    const auto motion = run(drive, {.motor_position = 1.0}, 20.0);
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
      ReducedDrive drive = lone_motor();
      drive.motor.friction.viscous = 0.0;
      drive.controller = ProportionalDerivative{4.0, 3.0};
      drive.error_shape = shape;
      drive.sampling = Sampling{.period = period, .delay = delay};
      drive.sensing.resolution = drive.sensing.resolution_of_speed = 0.013;
      drive.torque_limit = 2.0;
      drive.reference = 1.0;
      const auto motion = run(drive, {.motor_position = 0.2, .motor_speed = 0.3}, 20.0);
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
  ReducedDrive drive = lone_motor();
  drive.controller = ProportionalDerivative{.proportional = 4.0};
  drive.error_shape = relay(0.1, 0.0);
  ASSERT_EQ(validate(drive).size(), 1U);
  EXPECT_EQ(validate(drive)[0].path, "error_shape.hysteresis");
  drive.sampling = Sampling{.period = 0.01};
  EXPECT_TRUE(validate(drive).empty());
}

}  // namespace
}  // namespace gearlash::drive::error_shape_test
