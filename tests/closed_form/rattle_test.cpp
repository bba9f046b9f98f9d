// Nearly elastic faces pressed together: bounces too many to be followed, and what is left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "closed_form/first_contact.hpp"
#include "closed_form/trajectory.hpp"

namespace gearlash::rattle_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Rattling {
  NormalizedServo servo;  ///< damping, inertia and friction ratio, backlash, restitution
  double parting_error;   ///< permitted in the time at which the other face is reached
};

/// Stepped by 1 rad from the forward face they part, cross and rattle on the backward one.
const std::vector<Rattling> rattling{
    // The drag ends the rattle long before the faces part: only the offset of 1e-9 is left out.
    {{0.19, 100.0, 0.1, 0.3, 1.0}, 1e-9},
    {{0.19, 100.0, 0.1, 0.3, 0.9999}, 1e-9},
    {{0.5, 100.0, 0.1, 0.3, 1.0}, 1e-9},
    {{0.1, 100.0, 0.1, 0.3, 1.0}, 1e-9},
    // Here it does not quite, and some relative speed would be left as they part.
    {{0.1, 75.0, 0.1, 0.3, 1.0}, 1e-7}};

Trajectory stepped(const NormalizedServo& servo, double until, std::size_t event_limit) {
  return simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0),
                  {.until = until, .reference = 1.0, .event_limit = event_limit});
}

double gap_speed(const ServoState& state) { return state.motor_speed - state.load_speed; }

/// Speed of the common momentum.
double common_speed(const ServoDynamics& dynamics, const ServoState& state) {
  return state.load_speed + dynamics.motor_inertia * gap_speed(state);
}

double drag_on_gap(const ServoDynamics& dynamics) {
  return dynamics.motor_rate * dynamics.load_inertia + dynamics.load_rate * dynamics.motor_inertia;
}

TEST(PropertyRattle, ActionFallsByTheDragAlone) {
  const NormalizedServo servo = rattling.front().servo;
  const ServoDynamics dynamics = servo_dynamics(servo);
  const double reduced_inertia = dynamics.motor_inertia * dynamics.load_inertia;
  const Trajectory motion = stepped(servo, 10.0, 500);
  double constant = 0.0;
  for (std::size_t i = 100; i < 500; ++i) {
    const Event& event = motion.events()[i];
    ASSERT_EQ(event.kind, EventKind::impact);
    ASSERT_EQ(event.face, Face::backward);
    const double speed = std::abs(gap_speed(event.after));
    const double pressing = -mesh_torque(dynamics, event.after.load_position - 1.0,
                                         common_speed(dynamics, event.after)) /
                            reduced_inertia;
    const double action =
        std::pow(speed, 3) / pressing * std::exp(drag_on_gap(dynamics) * event.time);
    if (i == 100) constant = action;
    // Adiabatic: to first order in the duration of a bounce times the drag.
    const double bounce = 2.0 * speed / pressing;
    EXPECT_NEAR(action / constant, 1.0, 5.0 * bounce * drag_on_gap(dynamics)) << i;
  }
}

/// When the motion after the first impact on the backward face reaches the forward one, every
/// bounce followed until they are 1e-12 of the backlash high.
double arrival_followed(const NormalizedServo& servo, const Event& first) {
  const ServoDynamics dynamics = servo_dynamics(servo);
  double time = first.time;
  GapState state{first.after.load_position - 1.0, first.after.load_speed, -0.5 * servo.backlash,
                 gap_speed(first.after)};
  GapFlight flight = flight_from(dynamics, state);
  while (true) {
    const FirstContact contact = first_contact(flight, servo.backlash, infinity);
    const FlightMotion motion = motion_in_flight(flight, contact.time);
    time += contact.time;
    if (contact.toward > 0.0) return time;
    const ImpactOutcome outcome = impact(dynamics, motion.load_speed, motion.gap_speed);
    state = {motion.load_position, outcome.load_speed, -0.5 * servo.backlash, outcome.gap_speed};
    if (0.25 * contact.time * outcome.gap_speed < 1e-12 * servo.backlash) {
      const EngagedFlow flow{servo.damping, state.load_position,
                             state.load_speed + dynamics.motor_inertia * state.gap_speed};
      const double engaged =
          first_zero(servo.damping, mesh_torque(dynamics, flow.position, flow.speed),
                     mesh_torque_rate(dynamics, flow.position, flow.speed));
      const EngagedFlow::State parting = flow.at(engaged);
      time += engaged;
      flight = flight_from_separation(dynamics, parting.position, parting.speed, state.gap);
    } else {
      flight = flight_from(dynamics, state);
    }
  }
}

TEST(OracleRattle, FollowingEveryBounceGivesTheSameMotion) {
  for (const auto& [servo, parting_error] : rattling) {
    SCOPED_TRACE(servo.damping);
    SCOPED_TRACE(servo.inertia_ratio);
    SCOPED_TRACE(servo.restitution);
    const Trajectory motion = stepped(servo, 8.0, 1'000'000);
    const auto on = [](Face face) {
      return [face](const Event& e) { return e.kind == EventKind::impact && e.face == face; };
    };
    const auto first =
        std::find_if(motion.events().begin(), motion.events().end(), on(Face::backward));
    const auto next = std::find_if(first, motion.events().end(), on(Face::forward));
    ASSERT_NE(next, motion.events().end());
    EXPECT_TRUE(
        std::any_of(first, next, [](const Event& e) { return e.kind == EventKind::settling; }));
    EXPECT_NEAR(next->time, arrival_followed(servo, *first), parting_error);
  }
}

TEST(PropertyRattle, BooksBalanceAndElasticImpactsLoseNothing) {
  for (const auto& [servo, parting_error] : rattling) {
    const Trajectory motion = stepped(servo, 8.0, 1'000'000);
    const EnergyAccount start = motion.energy_at(0.0);
    const EnergyAccount end = motion.energy_at(8.0);
    EXPECT_NEAR(end.stored() + end.motor_friction + end.load_friction + end.impacts,
                start.stored() + end.supplied, 1e-12 * start.stored());
    if (servo.restitution == 1.0) {
      EXPECT_EQ(end.impacts, 0.0);
    } else {
      EXPECT_GT(end.impacts, 0.0);
    }
  }
}

TEST(EdgeRattle, LongRunsReachTheirEnd) {
  for (const auto& [servo, parting_error] : rattling) {
    EXPECT_EQ(stepped(servo, 50.0, 1'000'000).stop_reason(), StopReason::reached_end)
        << servo.inertia_ratio;
  }
}

}  // namespace
}  // namespace gearlash::rattle_test
