// The engine beside the closed form of the servo: every event in order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/described.hpp"
#include "base/range_check.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/trajectory.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "servo_system.hpp"

namespace gearlash::servo_oracle_test {
namespace {

NormalizedServo drawn_servo(SeededDraws& draws, int kind) {
  NormalizedServo servo{.damping = draws.log_uniform(0.02, 1.5),
                        .inertia_ratio = draws.log_uniform(0.03, 30.0),
                        .friction_ratio = draws.uniform(0.02, 0.98),
                        .backlash = draws.log_uniform(0.01, 1.0)};
  // Livelier faces make motions that never repeat, in which 40 time units multiply rounding by 10⁶.
  servo.restitution = kind % 2 == 0 ? 0.0 : draws.uniform(0.05, 0.6);
  return servo;
}

/// How far the two differ.
struct Differences {
  double time = 0.0;
  double state = 0.0;
  std::size_t events = 0;

  void add(double exact_time, const ServoState& exact, double time_found,
           const hybrid::Vector& found) {
    ++events;
    time = std::max(time, std::abs(time_found - exact_time));
    state = std::max(
        {state, std::abs(found[0] - exact.motor_position), std::abs(found[1] - exact.motor_speed),
         std::abs(found[2] - exact.load_position), std::abs(found[3] - exact.load_speed)});
  }
};

bool is_separation(const hybrid::Event& event) {
  return event.kind == hybrid::EventKind::transition && event.mode != separated;
}

/// Bounces that the closed form has summed are followed farther by the engine: what is between is
/// passed over. False where the events are not the same.
bool compare(const Trajectory& exact, const hybrid::Trajectory& found, Differences& differences) {
  const std::vector<hybrid::Event>& events = found.events();
  // The closed form begins apart where faces together would pull.
  std::size_t next = !events.empty() && events[0].time == 0.0 ? 1 : 0;
  for (const Event& event : exact.events()) {
    if (event.kind == EventKind::settling) {
      while (next < events.size() && events[next].kind != hybrid::EventKind::settling) ++next;
      if (next == events.size()) return event.time > exact.end_time() - 1e-3;
      if (std::abs(events[next].time - event.time) > 1e-7) return false;
      ++next;
      continue;
    }
    if (next == events.size()) return false;
    const hybrid::Event& mine = events[next++];
    if (is_separation(mine) != (event.kind == EventKind::separation)) return false;
    differences.add(event.time, event.after, mine.time, mine.after);
  }
  return true;
}

TEST(OracleSimulateServo, EventsOfThousandServosAreThoseOfTheClosedForm) {
  TracedDraws draws(6001);
  Differences worst;
  for (int i = 0; i < 1000; ++i) {
    const NormalizedServo servo = drawn_servo(draws, i);
    SCOPED_TRACE(described(servo));
    constexpr double until = 40.0;
    const ServoState start = engaged_start(servo, -1.0, draws.uniform(-1.0, 1.0), 0.0);
    const Trajectory exact = simulate(servo, start, {.until = until, .reference = 0.0});
    const hybrid::State state{engaged_forward,
                              (hybrid::Vector(4) << start.motor_position, start.motor_speed,
                               start.load_position, start.load_speed)
                                  .finished()};
    const hybrid::Trajectory found = simulate(servo_system(servo), state, {.until = until});
    EXPECT_EQ(found.stop_reason(), hybrid::StopReason::reached_end) << found.culprit();
    Differences here;
    EXPECT_TRUE(compare(exact, found, here));
    EXPECT_LE(here.time, 1e-11);
    EXPECT_LE(here.state, 1e-11);
    worst.time = std::max(worst.time, here.time);
    worst.state = std::max(worst.state, here.state);
    worst.events += here.events;
  }
  EXPECT_GT(worst.events, 10'000U);
  RecordProperty("events", std::to_string(worst.events));
  RecordProperty("worst_time", exact_text(worst.time));
  RecordProperty("worst_state", exact_text(worst.state));
}

}  // namespace
}  // namespace gearlash::servo_oracle_test
