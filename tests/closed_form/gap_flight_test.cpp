// Motion across the gap against the exponential of the raw equations' matrix in fifty digits:
//   ẏ_L = v_L, v̇_L = −D v_L, ẏ_M = v_M, v̇_M = −c v_M − y_L/J_M.
#include "closed_form/gap_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/fifty_digits.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/decay_integral.hpp"

namespace gearlash::gap_flight_test {
namespace {

/// y_L, v_L, u − u₀, v_M − v_L after `time`.
struct WideFlight {
  Wide load_position;
  Wide load_speed;
  Wide gap_displacement;
  Wide gap_speed;
};

WideFlight wide_flight(const ServoDynamics& dynamics, const Wide& load_position,
                       const Wide& load_speed, const Wide& gap_speed, double time) {
  const Wide t = time;
  WideMatrix<4> a{};
  a[0][1] = t;
  a[1][1] = -t * dynamics.load_rate;
  a[2][3] = t;
  a[3][0] = -t / dynamics.motor_inertia;
  a[3][3] = -t * dynamics.motor_rate;
  const WideMatrix<4> m = exponential(a);
  // The motor's position is counted from where it is at the start; the load's from the reference.
  const std::array<Wide, 4> start{load_position, load_speed, 0, load_speed + gap_speed};
  std::array<Wide, 4> end{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) end[i] += m[i][j] * start[j];
  }
  return {end[0], end[1], end[2] - (end[0] - load_position), end[3] - end[1]};
}

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

void expect_exact(const ServoDynamics& dynamics, const GapFlight& flight, const GapState& start,
                  bool clean, double time) {
  SCOPED_TRACE(testing::Message() << "damping " << dynamics.damping << " J_L "
                                  << dynamics.load_inertia << " J_M " << dynamics.motor_inertia
                                  << " D " << dynamics.load_rate << " c " << dynamics.motor_rate
                                  << " time " << time);
  const WideFlight exact =
      wide_flight(dynamics, flight.load_position, flight.load_speed, flight.gap_speed, time);
  const Scale scale = scale_of(dynamics, start, clean, time);
  const FlightMotion motion = motion_in_flight(flight, time);
  EXPECT_LE(epsilons_of(motion.load_position, exact.load_position, scale.load_position),
            flight_epsilons);
  // Underflow of e^{−Dt} is not measured in epsilons.
  const double tiny = std::numeric_limits<double>::min();
  EXPECT_LE(epsilons_of(motion.load_speed, exact.load_speed, std::max(scale.load_speed, tiny)),
            flight_epsilons);
  EXPECT_LE(epsilons_of(point_in_flight(flight, time).gap_displacement, exact.gap_displacement,
                        scale.gap_displacement),
            flight_epsilons);
  EXPECT_LE(epsilons_of(motion.gap_speed, exact.gap_speed, scale.gap_speed), flight_epsilons);
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

TEST(OracleGapFlight, RandomStatesAgainstTheMatrixExponential) {
  constexpr std::uint64_t seed = 314;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 1500 && !testing::Test::HasFailure(); ++i) {
    const RandomFlight random = random_flight(draws);
    const GapFlight flight = flight_from(random.dynamics, random.start);
    expect_exact(random.dynamics, flight, random.start, false, draws.log_uniform(1e-9, 50.0));
  }
}

/// N = 0 exactly in fifty digits: (F_L J_M − F_M J_L) v = J_L y, from the rates as they are used
/// (ü = 0 is −c v − y/J_M + D v = 0).
Wide separating_position(const ServoDynamics& dynamics, double load_speed) {
  return (Wide(dynamics.load_rate) - Wide(dynamics.motor_rate)) * dynamics.motor_inertia *
         load_speed;
}

TEST(OracleGapFlight, CleanSeparationsKeepRelativeAccuracyHoweverShort) {
  constexpr std::uint64_t seed = 315;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 800 && !testing::Test::HasFailure(); ++i) {
    const RandomFlight random = random_flight(draws);
    const ServoDynamics& dynamics = random.dynamics;
    const TorqueFreeLine line = dynamics.torque_free_line;
    const GapFlight flight =
        flight_from_separation(dynamics, 0.7 * line.position, 0.7 * line.speed, 0.15);
    ASSERT_EQ(flight.gap_acceleration, 0.0);
    ASSERT_EQ(flight.gap_speed, 0.0);
    const double time = draws.log_uniform(1e-9, 50.0);
    const WideFlight exact = wide_flight(dynamics, separating_position(dynamics, flight.load_speed),
                                         flight.load_speed, 0, time);
    const GapState start{flight.load_position, flight.load_speed, 0.15, 0.0};
    const Scale scale = scale_of(dynamics, start, true, time);
    EXPECT_LE(epsilons_of(point_in_flight(flight, time).gap_displacement, exact.gap_displacement,
                          scale.gap_displacement),
              flight_epsilons)
        << "c " << dynamics.motor_rate << " D " << dynamics.load_rate << " t " << time;
    EXPECT_LE(
        epsilons_of(motion_in_flight(flight, time).gap_speed, exact.gap_speed, scale.gap_speed),
        flight_epsilons)
        << "c " << dynamics.motor_rate << " D " << dynamics.load_rate << " t " << time;
  }
}

TEST(EdgeGapFlight, NearlyEqualRates) {
  const GapState start{-0.4, 0.8, 0.0, 0.1};
  for (const double ratio : {1e-3, 0.3, 1.0, 5.0, 1e3}) {
    const double equal = ratio / (1.0 + ratio);
    for (const double offset : {0.0, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2}) {
      for (const double side : {-1.0, 1.0}) {
        const double share = std::min(1.0, equal * (1.0 + side * offset));
        const ServoDynamics dynamics = dynamics_of(0.3, ratio, share);
        for (const double time : {1e-3, 0.7, 3.0, 20.0}) {
          expect_exact(dynamics, flight_from(dynamics, start), start, false, time);
        }
      }
    }
  }
}

TEST(EdgeGapFlight, VanishingRates) {
  const GapState start{-0.4, 0.8, 0.0, 0.1};
  for (const double share : {0.0, 1e-300, 1e-100, 1e-16, 1e-12, 1e-8, 1e-4}) {
    for (const double time : {1e-6, 0.5, 10.0}) {
      const ServoDynamics coasting_load = dynamics_of(0.3, 2.0, share);
      expect_exact(coasting_load, flight_from(coasting_load, start), start, false, time);
      const ServoDynamics free_motor = dynamics_of(0.3, 2.0, 1.0 - share);
      expect_exact(free_motor, flight_from(free_motor, start), start, false, time);
      const ServoDynamics slight = dynamics_of(share, 2.0, 0.4);
      expect_exact(slight, flight_from(slight, start), start, false, time);
    }
  }
}

TEST(EdgeGapFlight, ExtremeInertiaRatiosAndDamping) {
  const GapState start{-0.4, 0.8, 0.0, 0.1};
  for (const double ratio : {1e-9, 1e-6, 1e6, 1e9}) {
    for (const double damping : {0.0, 0.1, 1.0, 1000.0}) {
      for (const double time : {1e-9, 1e-3, 1.0}) {
        const ServoDynamics dynamics = dynamics_of(damping, ratio, 0.3);
        // Fifty digits bear rates up to about 1e13 times time: the squarings double their error.
        if (std::max(dynamics.load_rate, dynamics.motor_rate) * time > 1e10) continue;
        expect_exact(dynamics, flight_from(dynamics, start), start, false, time);
      }
    }
  }
}

// A light load with friction stops at once, and what the gap does then is the motor's motion alone:
// nothing is ill-conditioned, so nothing may be lost to the size of D = F_L/J_L.
TEST(EdgeGapFlight, LightLoadKeepsItsDigits) {
  const GapState start{-0.4, 0.8, 0.0, 0.1};
  for (const double ratio : {1e-2, 1e-4, 1e-6, 1e-9}) {
    const ServoDynamics dynamics = dynamics_of(0.3, ratio, 0.4);
    const GapFlight flight = flight_from(dynamics, start);
    for (const double time : {1e-3, 0.1, 1.0, 3.0}) {
      const WideFlight exact =
          wide_flight(dynamics, start.load_position, start.load_speed, start.gap_speed, time);
      // Each shaft's own motion: |v_M| t, |y| t²/2J_M of the motor, |v_L| t φ(Dt) of the load.
      const double load_way = 0.8 * time * decay(dynamics.load_rate * time).integral;
      const double way = 0.9 * time + (0.4 + load_way) * time * time + load_way;
      const double speed = 0.9 + (0.4 + load_way) * time + 0.8;
      EXPECT_LE(
          epsilons_of(point_in_flight(flight, time).gap_displacement, exact.gap_displacement, way),
          flight_epsilons)
          << "inertia ratio " << ratio << " time " << time;
      EXPECT_LE(epsilons_of(motion_in_flight(flight, time).gap_speed, exact.gap_speed, speed),
                flight_epsilons)
          << "inertia ratio " << ratio << " time " << time;
    }
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
    const Wide exact = creep + (Wide(0.8 + 0.1) - creep) * exp(-Wide(friction) * time);
    EXPECT_LE(epsilons_of(motion.gap_speed, exact, 0.9 + 0.4 * time), 8.0);
    const Wide moved =
        creep * time + (Wide(0.8 + 0.1) - creep) * (1 - exp(-Wide(friction) * time)) / friction;
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
        Wide(-0.4) + (rate == 0 ? Wide(0.8) * time : Wide(0.8) * (1 - exp(-rate * time)) / rate);
    const Wide speed = Wide(0.8) * exp(-rate * time);
    EXPECT_LE(epsilons_of(motion.load_position, position, 1.2), 8.0);
    EXPECT_LE(epsilons_of(motion.load_speed, speed, 0.8), 8.0);
    const Wide gap_speed = -position / dynamics.motor_friction - speed;
    EXPECT_LE(epsilons_of(motion.gap_speed, gap_speed, 0.8 + 1.2 / 0.36), 8.0);
  }
}

/// Largest difference of the states that two servos reach from one start at a few times well after
/// the initial layer of a light shaft.
double difference(const ServoDynamics& a, const ServoDynamics& b, const GapState& start) {
  const GapFlight first = flight_from(a, start);
  const GapFlight second = flight_from(b, start);
  double largest = 0.0;
  for (const double time : {0.5, 1.0, 3.0}) {
    const FlightMotion x = motion_in_flight(first, time);
    const FlightMotion y = motion_in_flight(second, time);
    largest = std::max({largest, std::abs(x.load_position - y.load_position),
                        std::abs(x.load_speed - y.load_speed), std::abs(x.gap_speed - y.gap_speed),
                        std::abs(point_in_flight(first, time).gap_displacement -
                                 point_in_flight(second, time).gap_displacement)});
  }
  return largest;
}

TEST(PropertyGapFlight, MasslessShaftsAreTheLimitsOfLightOnes) {
  const GapState start{-0.4, 0.8, 0.05, 0.1};
  // The difference is of the order of the light shaft's inertia, so a hundredth of the inertia
  // leaves a hundredth of the difference (a half to twice that is allowed for the next order).
  const ServoDynamics no_load = dynamics_of(0.3, 0.0, 0.4);
  const ServoDynamics no_motor = dynamics_of(0.3, infinity, 0.4);
  double load_before = difference(no_load, dynamics_of(0.3, 1e-3, 0.4), start);
  double motor_before = difference(no_motor, dynamics_of(0.3, 1e3, 0.4), start);
  for (const double light : {1e-5, 1e-7, 1e-9}) {
    const double load = difference(no_load, dynamics_of(0.3, light, 0.4), start);
    const double motor = difference(no_motor, dynamics_of(0.3, 1.0 / light, 0.4), start);
    EXPECT_NEAR(load_before / load, 100.0, 50.0) << light;
    EXPECT_NEAR(motor_before / motor, 100.0, 50.0) << light;
    load_before = load;
    motor_before = motor;
  }
}

TEST(PropertyGapFlight, Semigroup) {
  constexpr std::uint64_t seed = 316;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 20000; ++i) {
    RandomFlight random = random_flight(draws);
    const ServoDynamics& dynamics = random.dynamics;
    // Mild servos: the middle state's epsilons are multiplied by at most the rates over the rest.
    if (std::max(dynamics.load_rate, dynamics.motor_rate) > 100.0) continue;
    const double first = draws.log_uniform(1e-3, 5.0);
    const double second = draws.log_uniform(1e-3, 5.0);
    const GapFlight whole = flight_from(dynamics, random.start);
    const FlightMotion middle = motion_in_flight(whole, first);
    const GapState restart{middle.load_position, middle.load_speed,
                           point_in_flight(whole, first).gap_displacement, middle.gap_speed};
    const GapFlight rest = flight_from(dynamics, restart);
    const double time = first + second;
    const Scale scale = scale_of(dynamics, random.start, false, time);
    const Scale split = scale_of(dynamics, restart, false, second);
    const Scale at_first = scale_of(dynamics, random.start, false, first);
    const GapState errors{at_first.load_position, at_first.load_speed, 0.0, at_first.gap_speed};
    const Scale carried = scale_of(dynamics, errors, false, second);
    const auto bound = [&](double Scale::*member) {
      return 2.0 * flight_epsilons * epsilon *
             (scale.*member + split.*member + carried.*member + at_first.*member);
    };
    const FlightMotion at_once = motion_in_flight(whole, time);
    const FlightMotion in_two = motion_in_flight(rest, second);
    ASSERT_NEAR(in_two.load_position, at_once.load_position, bound(&Scale::load_position));
    ASSERT_NEAR(in_two.load_speed, at_once.load_speed, bound(&Scale::load_speed));
    ASSERT_NEAR(restart.gap + point_in_flight(rest, second).gap_displacement,
                point_in_flight(whole, time).gap_displacement, bound(&Scale::gap_displacement));
    ASSERT_NEAR(in_two.gap_speed, at_once.gap_speed, bound(&Scale::gap_speed));
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
