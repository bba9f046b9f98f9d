// A motor whose fast speed loop had settled went on at a constant speed while its torque grew, and
// through the gap without meeting the other face: of a chain of integrators, with what rounding
// leaves where fast decays are taken out, weights came out so far apart (1e38) that a series which
// was short in their norm left the position out.
#include <gtest/gtest.h>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid::slow_motion_resolved_test {
namespace {

// The drive as it was found, its motor in the gap and its load at rest off the reference.
constexpr double inertia = 1.09;
constexpr double viscous = 5.2;
constexpr double proportional = 1e4;
constexpr double integral_gain = 5e4;
constexpr double derivative = 800.0;
constexpr double filter_rate = 200.0;
constexpr double coulomb = 6.1;
constexpr double load_place = 0.0172734;
constexpr double reference = 0.01745329;
constexpr double torque_rate = integral_gain * (reference - load_place);

enum Number : Eigen::Index { position, speed, load_position, load_speed, integral, damping };

/// θ′ = v, J v′ = p (r − y) + z + d − c v − coulomb, z′ = i (r − y), d′ = −a (k v + d), y′ = u,
/// u′ = 0; an event as the motor has gone a way.
HybridSystem motor_in_gap(double way) {
  Matrix flow = Matrix::Zero(6, 6);
  flow(position, speed) = 1.0;
  flow(speed, speed) = -viscous / inertia;
  flow(speed, load_position) = -proportional / inertia;
  flow(speed, integral) = 1.0 / inertia;
  flow(speed, damping) = 1.0 / inertia;
  flow(load_position, load_speed) = 1.0;
  flow(integral, load_position) = -integral_gain;
  flow(damping, speed) = -filter_rate * derivative;
  flow(damping, damping) = -filter_rate;
  Vector offset = Vector::Zero(6);
  offset[speed] = (proportional * reference - coulomb) / inertia;
  offset[integral] = integral_gain * reference;
  Transition meeting{.name = "faces meet",
                     .guard = {Vector{{-1.0, 0.0, 0.0, 0.0, 0.0, 0.0}}, way},
                     .direction = Direction::either,
                     .target = 0};
  return {
      .state_names = {"position", "speed", "load position", "load speed", "integral", "damping"},
      .modes = {{.name = "apart", .flow = {flow, offset}, .transitions = {std::move(meeting)}}}};
}

/// From rest: integrate v′ and d′ once, and eliminate ∫d.
double position_of(const Vector& numbers, double time) {
  return (torque_rate * time * time / 2.0 - inertia * numbers[speed] -
          numbers[damping] / filter_rate) /
         (viscous + derivative);
}

/// Once what is fast has died away: v = p t + q, d = −k v + k p/a.
double speed_at(double time) {
  const double slope = torque_rate / (viscous + derivative);
  return slope * time + (derivative / filter_rate - inertia) * slope / (viscous + derivative);
}

TEST(RegressionSlowMotionResolved, AfterFastDecaysHaveSettled) {
  constexpr double way = 0.0024;
  constexpr double end = 20.0;
  const HybridSystem system = motor_in_gap(way);
  const double integral_at_start = coulomb - proportional * (reference - load_place);
  const State start{0, Vector{{0.0, 0.0, load_place, 0.0, integral_at_start, 0.0}}};
  const Trajectory motion = simulate(system, start, {.until = end});
  ASSERT_EQ(motion.events().size(), 1U);
  const Event& meeting = motion.events().front();
  // The torque is known to some 1e-15 of the thousand that it is a difference of.
  EXPECT_NEAR(position_of(meeting.before, meeting.time), way, 1e-11 * way);
  for (const double time : {1.0, 2.0, 5.0, 10.0, end}) {
    const Vector numbers = motion.at(time).numbers;
    EXPECT_NEAR(numbers[speed], speed_at(time), 1e-11 * speed_at(time)) << time;
    EXPECT_NEAR(numbers[position], position_of(numbers, time), 1e-11 * numbers[position]) << time;
  }
}

}  // namespace
}  // namespace gearlash::hybrid::slow_motion_resolved_test
