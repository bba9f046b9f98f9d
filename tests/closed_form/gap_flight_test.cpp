// Motion across the gap against the exponential of the raw equations' matrix in many digits.
#include "closed_form/gap_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/references.hpp"
#include "base/seeded_draws.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/decay_integral.hpp"

namespace gearlash::gap_flight_test {
namespace {

/// The sums of the absolute values of the closed form's terms: what one epsilon in the data, or in
/// the rates formed from them, can do. The rates enter e^{−Dt}, which (1 + Dt) accounts for.
struct Scale {
  double load_position;
  double load_speed;
  double gap_displacement;
  double gap_speed;
};

Scale scale_of(const ServoDynamics& dynamics, const GapState& start, bool clean, double t) {
  const double d = dynamics.load_rate;
  const double c = dynamics.motor_rate;
  const double v = std::abs(start.load_speed);
  const double w = std::abs(start.gap_speed);
  // ü₀ and G are differences themselves (D² − 2ζD + 1); at a clean separation ü₀ is exactly zero.
  const double acceleration = clean ? 0.0
                                    : c * std::abs(start.load_speed + start.gap_speed) +
                                          std::abs(start.load_position) / dynamics.motor_inertia +
                                          d * v;
  const double drive = v * (d * d + 2.0 * dynamics.damping * d + 1.0) / dynamics.motor_inertia;
  const Decay load = decay(d * t);
  const Decay motor = decay(c * t);
  const Convolution coupled = convolution(load, motor);
  return {std::abs(start.load_position) + v * t * load.integral,
          v * std::exp(-d * t) * (1.0 + d * t),
          w * t + acceleration * t * t * motor.double_integral +
              drive * t * t * t * coupled.double_integral,
          w + acceleration * t * motor.integral + drive * t * t * coupled.integral};
}

ServoDynamics dynamics_of(double damping, double inertia_ratio, double friction_ratio) {
  return servo_dynamics({.damping = damping,
                         .inertia_ratio = inertia_ratio,
                         .friction_ratio = friction_ratio,
                         .backlash = 0.3});
}

/// Sixteen for the φ-functions (measured 5) and four for the coefficients before them.
constexpr double flight_epsilons = 20.0;

void expect_near(const GapFlight& flight, const Reference& exact, const Scale& scale) {
  const double time = exact.input("time");
  SCOPED_TRACE(testing::Message() << exact.kind() << ": damping " << exact["damping"] << " ratio "
                                  << exact["inertia_ratio"] << " friction "
                                  << exact["friction_ratio"] << " time " << time);
  const FlightMotion motion = motion_in_flight(flight, time);
  EXPECT_LE(epsilons_of(point_in_flight(flight, time).gap_displacement, exact["gap_displacement"],
                        scale.gap_displacement),
            flight_epsilons);
  EXPECT_LE(epsilons_of(motion.gap_speed, exact["end_gap_speed"], scale.gap_speed),
            flight_epsilons);
  // A clean parting's place is a difference of the rates, which rounding moves.
  if (exact.kind() == "clean") return;
  EXPECT_LE(epsilons_of(motion.load_position, exact["end_position"], scale.load_position),
            flight_epsilons);
  // Underflow of e^{−Dt} is not measured in epsilons.
  const double tiny = std::numeric_limits<double>::min();
  EXPECT_LE(epsilons_of(motion.load_speed, exact["end_speed"], std::max(scale.load_speed, tiny)),
            flight_epsilons);
}

ServoDynamics dynamics_of(const Reference& exact) {
  return dynamics_of(exact.input("damping"), exact.input("inertia_ratio"),
                     exact.input("friction_ratio"));
}

/// Random states, nearly equal and vanishing rates, extreme inertia ratios and damping.
TEST(OracleGapFlight, KeepsItsDigits) {
  for (const Reference& exact : References("closed_form", "gap_flights")) {
    if (exact.kind() == "clean") continue;
    const GapState start{exact.input("load_position"), exact.input("load_speed"), 0.0,
                         exact.input("gap_speed")};
    const ServoDynamics dynamics = dynamics_of(exact);
    const GapFlight flight = flight_from(dynamics, start);
    expect_near(flight, exact, scale_of(dynamics, start, false, exact.input("time")));
  }
}

/// Relative accuracy, however short the flight.
TEST(OracleGapFlight, CleanSeparationsKeepTheirDigits) {
  for (const Reference& exact : References("closed_form", "gap_flights")) {
    if (exact.kind() != "clean") continue;
    const ServoDynamics dynamics = dynamics_of(exact);
    const TorqueFreeLine line = dynamics.torque_free_line;
    const GapFlight flight =
        flight_from_separation(dynamics, line.position / line.speed, 1.0, 0.15);
    ASSERT_EQ(flight.gap_acceleration, 0.0);
    ASSERT_EQ(flight.gap_speed, 0.0);
    const GapState start{flight.load_position, flight.load_speed, 0.15, 0.0};
    expect_near(flight, exact, scale_of(dynamics, start, true, exact.input("time")));
  }
}

struct RandomFlight {
  ServoDynamics dynamics;
  GapState start;
};

RandomFlight random_flight(SeededDraws& draws) {
  const double damping = draws.happens(0.1) ? draws.one_of({0.0, 1.0}) : draws.uniform(0.0, 2.0);
  const double ratio = draws.log_uniform(1e-6, 1e6);
  double friction_ratio = draws.happens(0.2) ? draws.one_of({0.0, 1.0}) : draws.uniform(0.0, 1.0);
  if (draws.happens(0.2)) friction_ratio = ratio / (1.0 + ratio);  // D = c to rounding
  return {dynamics_of(damping, ratio, friction_ratio),
          {draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0), 0.0, draws.uniform(-1.0, 1.0)}};
}

// A light load with friction stops at once, and what the gap does then is the motor's motion alone:
// nothing is ill-conditioned, so nothing may be lost to the size of D = F_L/J_L.
TEST(EdgeGapFlight, LightLoadKeepsItsDigits) {
  const GapState start{-0.4, 0.8, 0.0, 0.1};
  for (const Reference& exact : References("closed_form", "gap_flights")) {
    if (exact.kind() != "light") continue;
    const ServoDynamics dynamics = dynamics_of(exact);
    const double time = exact.input("time");
    // Each shaft's own motion: |v_M| t, |y| t²/2J_M of the motor, |v_L| t φ(Dt) of the load.
    const double load_way = 0.8 * time * decay(dynamics.load_rate * time).integral;
    Scale scale = scale_of(dynamics, start, false, time);
    scale.gap_displacement = 0.9 * time + (0.4 + load_way) * time * time + load_way;
    scale.gap_speed = 0.9 + (0.4 + load_way) * time + 0.8;
    expect_near(flight_from(dynamics, start), exact, scale);
  }
}

TEST(EdgeGapFlight, MasslessLoadStandsStill) {
  const ServoDynamics dynamics = dynamics_of(0.3, 0.0, 0.4);
  const GapFlight flight = flight_from(dynamics, {-0.4, 0.8, 0.05, 0.1});
  // v̇_M = −F_M v_M − y with y = −0.4 standing, v_M(0) = 0.9.
  const double friction = dynamics.motor_friction;
  for (const double time : {1e-6, 0.1, 1.0, 10.0}) {
    const FlightMotion motion = motion_in_flight(flight, time);
    EXPECT_EQ(motion.load_position, -0.4);
    EXPECT_EQ(motion.load_speed, 0.0);
    const Wide creep = Wide(0.4) / friction;
    // The motor's speed is the sum 0.8 + 0.1 as a double forms it.
    const Wide exact = creep + (Wide(0.8 + 0.1) - creep) * std::exp(-Wide(friction) * time);
    EXPECT_LE(epsilons_of(motion.gap_speed, exact, 0.9 + 0.4 * time), 8.0);
    const Wide moved =
        creep * time + (Wide(0.8 + 0.1) - creep) * -std::expm1(-Wide(friction) * time) / friction;
    EXPECT_LE(epsilons_of(point_in_flight(flight, time).gap_displacement, moved,
                          time * (0.9 + 0.4 * time)),
              8.0);
  }
}

TEST(EdgeGapFlight, MasslessMotorRunsAtTheSpeedTheLoopDrivesItAt) {
  const ServoDynamics dynamics = dynamics_of(0.3, infinity, 0.4);
  const GapFlight flight = flight_from(dynamics, {-0.4, 0.8, 0.05, 123.0});
  for (const double time : {0.0, 1e-6, 0.1, 1.0, 10.0}) {
    const FlightMotion motion = motion_in_flight(flight, time);
    const Wide rate = dynamics.load_friction;
    const Wide position =
        Wide(-0.4) + (rate == 0 ? Wide(0.8) * time : Wide(0.8) * -std::expm1(-rate * time) / rate);
    const Wide speed = Wide(0.8) * std::exp(-rate * time);
    EXPECT_LE(epsilons_of(motion.load_position, position, 1.2), 8.0);
    EXPECT_LE(epsilons_of(motion.load_speed, speed, 0.8), 8.0);
    const Wide gap_speed = -position / dynamics.motor_friction - speed;
    EXPECT_LE(epsilons_of(motion.gap_speed, gap_speed, 0.8 + 1.2 / 0.36), 8.0);
  }
}

TEST(PropertyGapFlight, PullStartsWithTheMeshTorquesAcceleration) {
  SeededDraws draws(317);
  for (int i = 0; i < 1000; ++i) {
    const RandomFlight random = random_flight(draws);
    const ServoDynamics& dynamics = random.dynamics;
    const double y = random.start.load_position;
    const double v = random.start.load_speed;
    const GapFlight pulled = flight_from_pull(dynamics, y, v, 0.15);
    const GapFlight general = flight_from(dynamics, {y, v, 0.15, 0.0});
    const double scale = dynamics.motor_rate * std::abs(v) + std::abs(y) / dynamics.motor_inertia +
                         dynamics.load_rate * std::abs(v);
    ASSERT_EQ(pulled.gap_speed, 0.0);
    ASSERT_NEAR(pulled.gap_acceleration, general.gap_acceleration, 8.0 * epsilon * scale);
    ASSERT_EQ(pulled.gap_drive, general.gap_drive);
  }
}

}  // namespace
}  // namespace gearlash::gap_flight_test
