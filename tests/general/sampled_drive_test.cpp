// Controllers that run in computers, beside recursions from sample to sample.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <deque>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "controllers.hpp"
#include "drives.hpp"

namespace gearlash::drive::sampled_drive_test {
namespace {

/// Drawn to 1 rad.
ReducedDrive drawn_motor() {
  ReducedDrive drive = lone_motor({2.0});
  drive.reference = 1.0;
  return drive;
}

double rounded(double value, double step) {
  return step > 0.0 ? step * std::round(value / step) : value;
}

/// The motor under a torque that is constant for a while.
struct Motor {
  double position;
  double speed;

  void coast(double torque, double time) {
    const double acceleration = torque / 2.0;
    position += time * (speed + 0.5 * time * acceleration);
    speed += time * acceleration;
  }
};

struct Sampled {
  double delay;
  double resolution;
  double limit;
  double resolution_of_speed = resolution;
};

/// By hand: u = K (r − y) − D (y − y_last)/T, held, given out after the delay.
TEST(OracleSampledDrive, IsARecursionFromSampleToSample) {
  constexpr double period = 0.1;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const std::array cases = {Sampled{0.0, 0.0, infinite},      Sampled{0.03, 0.0, infinite},
                            Sampled{period, 0.0, infinite},   Sampled{0.0, 0.01, infinite},
                            Sampled{0.03, 0.02, 2.0},         Sampled{period, 0.02, 1.5},
                            Sampled{0.13, 0.0, infinite},     Sampled{3.0 * period, 0.0, infinite},
                            Sampled{0.25, 0.023, 2.0},        Sampled{2.0 * period, 0.02, 1.5},
                            Sampled{0.03, 0.023, 2.0, 0.0071}};
  for (const auto& [delay, resolution, limit, resolution_of_speed] : cases) {
    ReducedDrive drive = drawn_motor();
    drive.controller = at_load(PID{PIDTerms::PD, 4.0, 0.0, 3.0});
    drive.sampling = Sampling{.period = period, .delay = delay};
    drive.sensing.resolution = resolution;
    drive.sensing.resolution_of_speed = resolution_of_speed;
    drive.torque_limit = limit;
    Motor motor{0.2, 0.3};
    const auto motion = moved(drive, {.motor_position = 0.2, .motor_speed = 0.3}, 20.0);
    double last = rounded(0.2 - period * 0.3, resolution_of_speed);
    double given = 0.0;
    std::deque<double> waiting(static_cast<std::size_t>(delay / period), 0.0);
    const double rest = delay - static_cast<double>(waiting.size()) * period;
    for (int sample = 0; sample < 200; ++sample) {
      const double reading = rounded(motor.position, resolution);
      const double counted = rounded(motor.position, resolution_of_speed);
      const double asked = 4.0 * (1.0 - reading) - 3.0 * (counted - last) / period;
      last = counted;
      waiting.push_back(asked);
      motor.coast(given, rest);
      given = std::clamp(waiting.front(), -limit, limit);
      waiting.pop_front();
      motor.coast(given, period - rest);
      const hybrid::Vector numbers = motion.at(period * (sample + 1)).numbers;
      ASSERT_NEAR(numbers[motor_position], motor.position, 2e-12) << delay << ' ' << sample;
      ASSERT_NEAR(numbers[motor_speed], motor.speed, 2e-12) << delay << ' ' << sample;
    }
  }
}

/// By hand: u = K (r − y) − D v with the speed of the sample, whatever the steps of the position.
TEST(OracleSampledDrive, ATachometerReadsTheSpeedItself) {
  constexpr double period = 0.1;
  ReducedDrive drive = drawn_motor();
  drive.controller = at_load(PID{PIDTerms::PD, 4.0, 0.0, 3.0});
  drive.sampling = Sampling{.period = period, .speed_by_differences = false};
  drive.sensing.resolution = drive.sensing.resolution_of_speed = 0.023;
  Motor motor{0.2, 0.3};
  const auto motion = moved(drive, {.motor_position = 0.2, .motor_speed = 0.3}, 5.0);
  for (int sample = 0; sample < 50; ++sample) {
    motor.coast(4.0 * (1.0 - rounded(motor.position, 0.023)) - 3.0 * motor.speed, period);
    const hybrid::Vector numbers = motion.at(period * (sample + 1)).numbers;
    ASSERT_NEAR(numbers[motor_position], motor.position, 2e-12) << sample;
    ASSERT_NEAR(numbers[motor_speed], motor.speed, 2e-12) << sample;
  }
}

/// By hand: u = z + (P + s T I) e − D (y − y_last)/T, z⁺ = z + T I e + (T/T_t)(τ − u) with what the
/// sample before asked for and was given; s is 0 by forward, ½ by Tustin's and 1 by backward
/// differences.
TEST(OracleSampledDrive, AntiWindupIsARecursionFromSampleToSample) {
  constexpr double period = 0.1;
  constexpr double limit = 0.5;
  constexpr double tracking_time = 0.4;
  const std::array methods = {std::pair{Discretization::forward, 0.0},
                              std::pair{Discretization::tustin, 0.5},
                              std::pair{Discretization::backward, 1.0}};
  // However late the torque takes effect, the computer knows at once what it may not ask for.
  struct Case {
    Discretization method;
    double share;
    double delay;
  };
  std::vector<Case> cases;
  for (const auto& [method, share] : methods) {
    for (const double delay : {0.0, 0.03, period, 0.13, 3.0 * period}) {
      cases.push_back({method, share, delay});
    }
  }
  for (const auto& [method, share, delay] : cases) {
    SCOPED_TRACE(delay);
    ReducedDrive drive = drawn_motor();
    drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                   .proportional = 4.0,
                                   .integral = 1.5,
                                   .derivative = 3.0,
                                   .tracking_time = tracking_time});
    drive.sampling = Sampling{.period = period, .delay = delay, .method = method};
    drive.torque_limit = limit;
    Motor motor{0.2, 0.3};
    const auto motion = moved(drive, {.motor_position = 0.2, .motor_speed = 0.3}, 20.0);
    double last = 0.2 - period * 0.3;
    double integral = 0.0;
    double beyond = 0.0;  // of what was asked for last
    double given = 0.0;
    std::deque<double> waiting(static_cast<std::size_t>(delay / period), 0.0);
    const double rest = delay - static_cast<double>(waiting.size()) * period;
    for (int sample = 0; sample < 190; ++sample) {
      const double error = 1.0 - motor.position;
      const double asked =
          integral + (4.0 + share * period * 1.5) * error - 3.0 * (motor.position - last) / period;
      integral += period * 1.5 * error - period / tracking_time * beyond;
      last = motor.position;
      waiting.push_back(std::clamp(asked, -limit, limit));
      beyond = asked - waiting.back();
      motor.coast(given, rest);
      given = waiting.front();
      waiting.pop_front();
      motor.coast(given, period - rest);
      const hybrid::Vector numbers = motion.at(period * (sample + 1)).numbers;
      ASSERT_NEAR(numbers[motor_position], motor.position, 2e-12) << sample;
      ASSERT_NEAR(numbers[motor_speed], motor.speed, 2e-12) << sample;
    }
  }
}

TEST(SampledDrive, EveryNumberOfItsStateHasAName) {
  ReducedDrive drive = drawn_motor();
  drive.controller =
      at_load(PID{.terms = PIDTerms::PID, .integral = 1.0, .derivative = 1.0, .filter = 0.1});
  drive.sampling = Sampling{.period = 0.1, .delay = 0.05};
  const std::vector<std::string> names = drive_system(drive).system.state_names;
  EXPECT_EQ(std::vector(names.begin(), names.begin() + 9),
            (std::vector<std::string>{"motor position", "motor speed", "load position",
                                      "load speed", "controller 1", "controller 2", "torque held",
                                      "torque worked out", "last reading"}));
  EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size());
}

/// A continuous controller with an encoder: between counts the torque is constant.
TEST(OracleSampledDrive, AnEncoderHoldsTheTorqueBetweenItsCounts) {
  ReducedDrive drive = drawn_motor();
  drive.controller = at_load(PID{.proportional = 4.0});
  drive.sensing.resolution = 0.1;
  const auto motion = moved(drive, {}, 0.9);
  // From 0 to the first count, at 0.05, by τ = 4; then by 4 · 0.9 until 0.15.
  const auto& events = motion.events();
  ASSERT_GE(events.size(), 2U);
  const double first = std::sqrt(2.0 * 0.05 / 2.0);
  EXPECT_NEAR(events[0].time, first, 1e-14);
  const double speed = 2.0 * first;
  const double acceleration = 1.8;
  const double second =
      (std::sqrt(speed * speed + 2.0 * acceleration * 0.1) - speed) / acceleration;
  EXPECT_NEAR(events[1].time, first + second, 1e-14);
}

// ---- from continuous to sampled -----------------------------------------------------------------

using Complex = std::complex<double>;

/// From e to the torque asked for, of one or two states.
Complex response(const LinearController& controller, Complex at) {
  const std::size_t order = controller.order();
  Complex sum = controller.direct[0];
  if (order == 1) {
    sum +=
        controller.output[0] * controller.input_matrix[0][0] / (at - controller.state_matrix[0][0]);
  } else if (order == 2) {
    const auto& a = controller.state_matrix;
    const Complex determinant = (at - a[0][0]) * (at - a[1][1]) - a[0][1] * a[1][0];
    const double first = controller.input_matrix[0][0];
    const double second = controller.input_matrix[1][0];
    sum += (controller.output[0] * ((at - a[1][1]) * first + a[0][1] * second) +
            controller.output[1] * (a[1][0] * first + (at - a[0][0]) * second)) /
           determinant;
  }
  return sum;
}

TEST(OracleSampledController, IsTheContinuousOneWithAnotherDerivative) {
  const LinearController pid = at_load(PID{PIDTerms::PID, 3.0, 2.0, 0.7, 0.05, 0.4});
  constexpr double period = 0.02;
  for (const Complex z : {std::polar(1.0, 0.3), std::polar(0.9, 2.0), Complex(-0.8, 0.1)}) {
    const auto expect = [&](Discretization method, Complex s) {
      const LinearController sampled =
          sampled_controller(pid, {.period = period, .method = method});
      const Complex exact = 3.0 + 2.0 / s + 0.7 * s / (0.05 * s + 1.0);
      EXPECT_LT(std::abs(response(sampled, z) - exact), 1e-12 * std::abs(exact));
    };
    expect(Discretization::tustin, 2.0 / period * (z - 1.0) / (z + 1.0));
    expect(Discretization::backward, (z - 1.0) / (period * z));
    expect(Discretization::forward, (z - 1.0) / period);
  }
  const LinearController filter =
      at_load(TransferFunctionController{1.0, {0.5, 0.1}, {1.0, -0.9}, true});
  const Complex z = std::polar(1.0, 0.7);
  EXPECT_LT(std::abs(response(sampled_controller(filter, {.period = period}), z) -
                     (0.5 * z + 0.1) / (z - 0.9)),
            1e-14);
}

TEST(EdgeSampledDrive, FaultsAreToldAllAtOnce) {
  const auto fields_of = [](const ReducedDrive& drive) {
    std::vector<std::string> fields;
    for (const Fault& fault : faults(drive)) fields.push_back(fault.path);
    return fields;
  };
  ReducedDrive drive = drawn_motor();
  drive.controller = at_load(TransferFunctionController{1.0, {1.0}, {1.0, -2.0}, true});
  const auto with_denominator = [](const std::string& other) {
    return std::vector<std::string>{"controller.denominator", other};
  };
  EXPECT_EQ(fields_of(drive), with_denominator("sampling"));
  drive.sampling = Sampling{.period = 0.0};
  EXPECT_EQ(fields_of(drive), with_denominator("sampling.period"));
  drive.sampling = Sampling{.period = 0.1, .delay = 10.1};
  EXPECT_EQ(fields_of(drive), with_denominator("sampling.delay"));
  drive.sampling = Sampling{.period = 0.1};
  EXPECT_EQ(fields_of(drive), std::vector<std::string>{"controller.denominator"});
  // A filter that forward differences cannot follow: 1 − T/T_f < −1.
  drive.controller =
      at_load(PID{.terms = PIDTerms::PID, .proportional = 1.0, .derivative = 1.0, .filter = 0.04});
  EXPECT_TRUE(faults(drive).empty());
  drive.sampling->method = Discretization::forward;
  EXPECT_EQ(fields_of(drive), std::vector<std::string>{"sampling.period"});
  EXPECT_THROW(drive_system(drive), InvalidInput);
}

}  // namespace
}  // namespace gearlash::drive::sampled_drive_test
