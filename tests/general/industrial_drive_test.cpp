// Current loops, two rates, limits of speed and feed-forward, beside closed forms and recursions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <deque>
#include <limits>

#include "base/seeded_draws.hpp"
#include "drives.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::drive::industrial_drive_test {
namespace {

constexpr double ratio = 4.0;
constexpr double inertia = 2.0;   // at the load's shaft
constexpr double friction = 0.5;  // likewise

/// A motor by itself, far from both faces, with gains at the load.
Drive motor_with(const CascadeController& law) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = inertia / (ratio * ratio),
                 .friction = {.viscous = friction / (ratio * ratio)}};
  drive.gearbox = {.ratio = ratio, .backlash = 1e6};
  drive.load.inertia = 1.0;
  drive.sensor.position = SensorPlace::motor;
  drive.controller = {.law = law, .shaft = GainShaft::load};
  return drive;
}

hybrid::Trajectory run(const Drive& drive, double until, const ShaftStates& start = {}) {
  for (const Fault& fault : faults(drive)) ADD_FAILURE() << to_string(fault);
  return moved(reduce(drive), start, until);
}

double position_after(const Drive& drive, double until) {
  return run(drive, until).end().numbers[motor_position];
}

// ---- the current loop ---------------------------------------------------------------------------

/// Under its limit L the torque is L (1 − e^{−ω t}) from the start on: the request is limited
/// before the lag.
TEST(OracleCurrentBandwidth, ATorqueAtItsLimitRisesAsALag) {
  constexpr double bandwidth = 30.0;
  constexpr double limit = 0.75;  // of the motor
  Drive drive = motor_with({.position = 100.0, .speed = 100.0});
  drive.motor.friction.viscous = 0.0;
  drive.motor.kind = TorqueControl{.current_bandwidth = bandwidth};
  drive.motor.limit = limit;
  drive.reference = 1000.0;
  const auto motion = run(drive, 0.5);
  for (const double time : {0.01, 0.05, 0.2, 0.5}) {
    const double rest = 1.0 - std::exp(-bandwidth * time);
    const double speed = limit * ratio / inertia * (time - rest / bandwidth);
    EXPECT_NEAR(motion.at(time).numbers[motor_speed], speed, 1e-13) << time;
  }
}

/// Of a sine: position/reference = K/((s/ω + 1)(J s² + F s) + D s + K), K = D · position.
TEST(OracleCurrentBandwidth, IsALagOfTheTransferFunction) {
  constexpr double bandwidth = 5.0;
  const CascadeController law{.position = 1.5, .speed = 3.0};
  Drive drive = motor_with(law);
  drive.motor.kind = TorqueControl{.current_bandwidth = bandwidth};
  constexpr double frequency = 1.3;
  drive.reference = SineSignal{.amplitude = 0.2, .frequency = frequency};
  const std::complex<double> s{0.0, frequency};
  const double stiffness = law.speed * law.position;
  const auto response = stiffness / ((s / bandwidth + 1.0) * (inertia * s * s + friction * s) +
                                     law.speed * s + stiffness);
  const auto motion = run(drive, 80.0);
  for (const double time : {77.0, 78.1, 79.2, 80.0}) {
    const double expected =
        0.2 * std::abs(response) * std::sin(frequency * time + std::arg(response));
    EXPECT_NEAR(motion.at(time).numbers[motor_position], expected, 1e-9) << time;
  }
}

// ---- two rates, by hand -------------------------------------------------------------------------

struct Rates {
  const char* name;
  int position_ticks;
  double delay;
  double resolution;
  double torque_limit;
  double speed_limit;
  bool moves;  ///< the reference is a sine
};

constexpr double none = std::numeric_limits<double>::infinity();
constexpr double period = 0.1;
const CascadeController gains{
    .position = 0.8, .speed = 3.0, .speed_integral = 1.5, .acceleration_feedforward = 0.7};

/// From tick to tick: w = position e + share ṙ within its limit, at every n-th tick; then
/// u = K (w − v) + z + T I (w − v)/2 + A r̈ with v = (y − y_last)/T, and z⁺ = z + T I (w − v).
void expect_recursion(const Rates& one) {
  CascadeController law = gains;
  law.speed_feedforward = 0.6;
  if (one.speed_limit < none) law.speed_limit = one.speed_limit;
  Drive drive = motor_with(law);
  drive.motor.friction.viscous = 0.0;
  if (one.torque_limit < none) drive.motor.limit = one.torque_limit / ratio;
  drive.sensor.encoder.resolution = one.resolution * ratio;
  drive.sampling = Sampling{
      .period = period, .delay = one.delay, .position_period = one.position_ticks * period};
  constexpr double frequency = 0.9;
  drive.reference = 1.0;
  if (one.moves) drive.reference = SineSignal{.amplitude = 1.0, .frequency = frequency};
  const auto motion = run(drive, 15.0, {.motor_position = 0.2, .motor_speed = 0.3});
  const auto read = [&](double at) {
    return one.resolution > 0.0 ? one.resolution * std::round(at / one.resolution) : at;
  };
  double position = 0.2, speed = 0.3, last = read(0.2 - period * 0.3), asked = 0.0, state = 0.0;
  double given = 0.0;
  std::deque<double> waiting(static_cast<std::size_t>(one.delay / period), 0.0);
  const double rest = one.delay - static_cast<double>(waiting.size()) * period;
  const auto coast = [&](double time) {
    const double torque = std::clamp(given, -one.torque_limit, one.torque_limit);
    position += time * (speed + 0.5 * time * torque / inertia);
    speed += time * torque / inertia;
  };
  for (int tick = 0; tick < 150; ++tick) {
    const double time = tick * period;
    const double reference = one.moves ? std::sin(frequency * time) : 1.0;
    const double rate = one.moves ? frequency * std::cos(frequency * time) : 0.0;
    const double acceleration = one.moves ? -frequency * frequency * reference : 0.0;
    const double reading = read(position);
    if (tick % one.position_ticks == 0) {
      asked = std::clamp(law.position * (reference - reading) + law.speed_feedforward * rate,
                         -one.speed_limit, one.speed_limit);
    }
    const double error = asked - (reading - last) / period;
    last = reading;
    const double step = period * law.speed_integral * error;
    waiting.push_back(law.speed * error + state + 0.5 * step +
                      law.acceleration_feedforward * acceleration);
    state += step;
    coast(rest);
    given = waiting.front();
    waiting.pop_front();
    coast(period - rest);
    const hybrid::Vector numbers = motion.at(time + period).numbers;
    ASSERT_NEAR(numbers[motor_position], position, 1e-11) << one.name << ' ' << tick;
    ASSERT_NEAR(numbers[motor_speed], speed, 1e-11) << one.name << ' ' << tick;
  }
}

TEST(OracleTwoRates, AreARecursionFromTickToTick) {
  expect_recursion({"one rate", 1, 0.0, 0.0, none, none, true});
  expect_recursion({"two rates", 4, 0.0, 0.0, none, none, false});
  expect_recursion({"two rates, sine", 3, 0.0, 0.0, none, none, true});
  expect_recursion({"delay", 4, 0.03, 0.0, none, none, true});
  expect_recursion({"late output", 2, 0.25, 0.0, none, none, true});
  expect_recursion({"encoder", 5, 0.03, 0.023, none, none, false});
  expect_recursion({"torque limit", 4, 0.03, 0.0, 0.5, none, true});
  expect_recursion({"speed limit", 1, 0.03, 0.0, none, 0.15, false});
  expect_recursion({"speed limit, two rates, sine", 7, 0.03, 0.0, none, 0.2, true});
}

TEST(PropertyTwoRates, OfOnePeriodAreOneRate) {
  Drive drive = motor_with(gains);
  drive.reference = 1.0;
  drive.sampling = Sampling{.period = period, .delay = 0.03};
  const hybrid::Vector one = run(drive, 10.0).end().numbers;
  drive.sampling->position_period = period;
  EXPECT_EQ(run(drive, 10.0).end().numbers, one);
}

class Nobody : public hybrid::MotionObserver {
  void moved(double, double, const hybrid::Vector&, const hybrid::Vector&) override {}
};

/// Ticks that are passed over, as in a search, lead where all ticks lead.
TEST(PropertyTwoRates, AreTheSameWhereTicksArePassedOver) {
  constexpr int drives = 20;
  for (int seed = 0; seed < drives; ++seed) {
    SeededDraws draws(static_cast<std::uint64_t>(seed));
    CascadeController law = gains;
    law.position = draws.uniform(0.2, 1.2);
    Drive drive = motor_with(law);
    drive.motor.friction.coulomb = draws.uniform(0.0, 0.05);
    drive.sensor.encoder.resolution = draws.log_uniform(1e-4, 0.05);
    drive.reference = draws.uniform(-1.0, 1.0);
    const double ticks = std::floor(draws.uniform(2.0, 9.0));
    const double delay = draws.one_of({0.0, 0.03, 0.1});
    drive.sampling = Sampling{.period = period, .delay = delay, .position_period = ticks * period};
    const ReducedDrive reduced = reduce(drive);
    const DriveSystem built = drive_system(reduced);
    const hybrid::State start = drive_start(reduced, built, {});
    constexpr double until = 2000.05;
    Nobody nobody;
    const hybrid::Observed passed =
        observe(hybrid::PreparedSystem(built.system), start, {.until = until}, nobody);
    const hybrid::State all = simulate(built.system, start, {.until = until}).end();
    EXPECT_EQ(passed.end.mode, all.mode) << "seed " << seed;
    EXPECT_NEAR(passed.end.numbers[motor_position], all.numbers[motor_position], 1e-9)
        << "seed " << seed;
    EXPECT_NEAR(passed.end.numbers[motor_speed], all.numbers[motor_speed], 1e-9) << "seed " << seed;
  }
}

// ---- the speed limit ----------------------------------------------------------------------------

/// J v′ = K (limit − v) − F v until the error is limit/position.
TEST(OracleSpeedLimit, ALargeStepMovesAtTheLimit) {
  constexpr double limit = 2.0;
  const double rate = (gains.speed + friction) / inertia;
  const double end = gains.speed * limit / (gains.speed + friction);
  for (const double way : {1.0, -1.0}) {
    Drive drive =
        motor_with({.position = gains.position, .speed = gains.speed, .speed_limit = limit});
    drive.reference = way * 100.0;
    const auto motion = run(drive, 40.0);
    for (const double time : {0.1, 1.0, 10.0, 40.0}) {
      const double grown = 1.0 - std::exp(-rate * time);
      EXPECT_NEAR(motion.at(time).numbers[motor_speed], way * end * grown, 1e-12) << time;
      EXPECT_NEAR(motion.at(time).numbers[motor_position], way * end * (time - grown / rate), 1e-11)
          << time;
    }
    EXPECT_NEAR(position_after(drive, 200.0), way * 100.0, 1e-9);
  }
  Drive with_integral = motor_with(gains);
  std::get<CascadeController>(with_integral.controller.law).speed_limit = limit;
  with_integral.reference = 1000.0;
  EXPECT_NEAR(run(with_integral, 100.0).end().numbers[motor_speed], limit, 1e-12);
}

/// Angles and speeds are those of the gains' shaft.
TEST(OracleSpeedLimit, IsOfTheShaftOfTheGains) {
  Drive drive = motor_with(gains);
  auto& law = std::get<CascadeController>(drive.controller.law);
  law.speed_limit = 2.0;
  drive.controller.shaft = GainShaft::motor;
  law.speed /= ratio * ratio;
  law.speed_integral /= ratio * ratio;
  drive.reference = 1000.0;
  EXPECT_NEAR(run(drive, 100.0).end().numbers[motor_speed], 2.0 / ratio, 1e-12);
}

TEST(PropertySpeedLimit, ChangesNoSmallMotion) {
  for (const bool is_sampled : {false, true}) {
    Drive drive = motor_with(gains);
    drive.reference = 0.1;
    if (is_sampled) drive.sampling = Sampling{.period = 0.05};
    const hybrid::State without = run(drive, 7.03).end();
    std::get<CascadeController>(drive.controller.law).speed_limit = 0.09;
    const hybrid::State with = run(drive, 7.03).end();
    EXPECT_NEAR(with.numbers[motor_position], without.numbers[motor_position], 1e-13);
    EXPECT_NEAR(with.numbers[motor_speed], without.numbers[motor_speed], 1e-13);
  }
}

// ---- feed-forward -------------------------------------------------------------------------------

/// In an even motion the integral makes v = w: position e = (1 − share) ṙ.
TEST(OracleSpeedFeedforward, TakesItsShareOfARampsLag) {
  for (const double share : {0.0, 0.5, 1.0}) {
    for (const double ticks : {0.0, 1.0, 4.0}) {
      Drive drive = motor_with(gains);
      std::get<CascadeController>(drive.controller.law).speed_feedforward = share;
      drive.reference = RampSignal{.value = 0.0, .rate = -0.4, .time = 0.5};
      if (ticks > 0.0) drive.sampling = Sampling{.period = 0.05, .position_period = ticks * 0.05};
      const double reference = -0.4 * 59.5;
      const double lag = (1.0 - share) * -0.4 / gains.position;
      EXPECT_NEAR(position_after(drive, 60.0), reference - lag, 1e-9) << share << ' ' << ticks;
    }
  }
}

/// With the whole speed, and the motor's inertia for the acceleration, nothing is left to correct.
TEST(OracleFeedforward, OfSpeedAndAccelerationFollowsExactly) {
  Drive drive = motor_with({.position = 2.0,
                            .speed = 3.0,
                            .speed_feedforward = 1.0,
                            .acceleration_feedforward = inertia});
  drive.motor.friction.viscous = 0.0;
  drive.reference =
      TrapezoidSignal{.from = 0.0, .to = 3.0, .speed = 1.0, .acceleration = 0.5, .time = 1.0};
  const auto motion = run(drive, 10.0);
  // To 1 at 3 s, evenly to 2 at 4 s, at rest at 6 s.
  EXPECT_NEAR(motion.at(2.0).numbers[motor_position], 0.25, 1e-13);
  EXPECT_NEAR(motion.at(3.0).numbers[motor_position], 1.0, 1e-13);
  EXPECT_NEAR(motion.at(3.7).numbers[motor_position], 1.7, 1e-13);
  EXPECT_NEAR(motion.at(5.0).numbers[motor_position], 2.75, 1e-13);
  EXPECT_NEAR(motion.at(10.0).numbers[motor_position], 3.0, 1e-13);
  drive.reference = SineSignal{.amplitude = 0.3, .frequency = 2.0};
  const auto swing = run(drive, 9.0, {.motor_speed = 0.6});
  EXPECT_NEAR(swing.end().numbers[motor_position], 0.3 * std::sin(18.0), 1e-12);
}

}  // namespace
}  // namespace gearlash::drive::industrial_drive_test
