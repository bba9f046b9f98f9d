// Events, the states between them, and every kind of start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "base/traced_draws.hpp"
#include "closed_form/trajectory.hpp"
#include "random_starts.hpp"

namespace gearlash::trajectory_event_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Trajectory run(const RandomStart& start, double until) {
  return simulate(start.servo, start.initial,
                  {.until = until, .reference = start.reference, .event_limit = 3000});
}

double gap_of(const ServoState& state) { return state.motor_position - state.load_position; }

const NormalizedServo sample{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

/// Largest of all lengths and speeds at the events: what epsilons are counted of. Position and
/// reference are added and subtracted, so the reference counts as well.
double scale_of(const RandomStart& start, const Trajectory& motion) {
  double scale = start.scale() + std::abs(start.reference);
  for (const Event& event : motion.events()) {
    for (const ServoState& s : {event.before, event.after}) {
      scale = std::max({scale, std::abs(s.motor_position), std::abs(s.motor_speed),
                        std::abs(s.load_position), std::abs(s.load_speed)});
    }
  }
  return scale;
}

TEST(PropertyEvents, StateAtAnEventIsTheStateAfterIt) {
  TracedDraws draws(401);
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    const RandomStart start = random_start(draws, {.massless_sides = true});
    SCOPED_TRACE(describe(start));
    const Trajectory motion = run(start, 20.0);
    const double scale = scale_of(start, motion);
    const std::vector<Event>& events = motion.events();
    for (std::size_t k = 0; k < events.size(); ++k) {
      if (k + 1 < events.size() && events[k + 1].time == events[k].time) continue;
      const ServoState at = motion.at(events[k].time);
      // The gap is added to and taken from positions: an epsilon of those.
      ASSERT_LE(distance(at, events[k].after), 4.0 * epsilon * scale) << "event " << k;
      ASSERT_EQ(motion.mode_at(events[k].time), events[k].mode_after) << "event " << k;
    }
  }
}

TEST(PropertyEvents, StatesJustBeforeAreTheStatesBefore) {
  TracedDraws draws(402);
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    const RandomStart start = random_start(draws);
    SCOPED_TRACE(describe(start));
    const Trajectory motion = run(start, 20.0);
    const double scale = scale_of(start, motion);
    const double inertia = 1.0 / (1.0 + start.servo.inertia_ratio);
    const double lightest = std::min(inertia, 1.0 - inertia);
    const double rate = (1.0 + 2.0 * start.servo.damping) / lightest;  // bounds c, D and 1/J
    double previous = 0.0;
    for (const Event& event : motion.events()) {
      const double step = 1e-9 * (event.time - previous);
      if (step > 64.0 * epsilon * event.time) {
        const ServoState before = motion.at(event.time - step);
        // Speeds change by at most rate × scale per time, positions by 2 × scale.
        ASSERT_LE(distance(before, event.before),
                  (4.0 * rate * step + 256.0 * epsilon * (1.0 + rate)) * scale)
            << "at " << event.time;
      }
      previous = event.time;
    }
  }
}

TEST(PropertyEvents, EachKindDoesWhatItsNameSays) {
  TracedDraws draws(403);
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    const RandomStart start = random_start(draws, {.massless_sides = true});
    SCOPED_TRACE(describe(start));
    const Trajectory motion = run(start, 20.0);
    const double scale = scale_of(start, motion);
    const double motor_inertia = 1.0 / (1.0 + start.servo.inertia_ratio);
    const double e = start.servo.inertia_ratio == 0.0 || std::isinf(start.servo.inertia_ratio)
                         ? 0.0
                         : start.servo.restitution;
    double previous = 0.0;
    for (const Event& event : motion.events()) {
      ASSERT_GE(event.time, previous);
      ASSERT_LE(event.time, 20.0);
      previous = event.time;
      const double side = event.face == Face::forward ? 1.0 : -1.0;
      ASSERT_NEAR(gap_of(event.before), 0.5 * side * start.servo.backlash, 4.0 * epsilon * scale);
      ASSERT_NEAR(gap_of(event.after), 0.5 * side * start.servo.backlash, 4.0 * epsilon * scale);
      ASSERT_EQ(event.before.load_position, event.after.load_position);
      const double u_before = event.before.motor_speed - event.before.load_speed;
      const double u_after = event.after.motor_speed - event.after.load_speed;
      const double bits = 16.0 * epsilon * scale;
      if (event.kind == EventKind::impact) {
        ASSERT_GE(u_before * side, -bits);
        ASSERT_NEAR(u_after, -e * u_before, bits);
        const auto momentum = [&](const ServoState& s) {
          return motor_inertia * s.motor_speed + (1.0 - motor_inertia) * s.load_speed;
        };
        ASSERT_NEAR(momentum(event.before), momentum(event.after), bits);
        ASSERT_GE(event.energy_lost, 0.0);
      } else {
        // Separation and settling change no speed but by rounding: an engaged phase's own errors
        // are epsilons of its start times the time it took.
        ASSERT_LE(distance(event.before, event.after), 64.0 * epsilon * scale * 20.0);
      }
      if (event.kind == EventKind::separation) {
        ASSERT_EQ(event.mode_after, Mode::separated);
        ASSERT_EQ(event.energy_lost, 0.0);
      }
      if (event.kind == EventKind::settling) {
        ASSERT_EQ(event.mode_after, side > 0.0 ? Mode::engaged_forward : Mode::engaged_backward);
      }
    }
  }
}

TEST(PropertyEvents, TheGapIsNeverExceededAndEngagedFacesTouch) {
  TracedDraws draws(404);
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    const RandomStart start = random_start(draws, {.massless_sides = true});
    SCOPED_TRACE(describe(start));
    const Trajectory motion = run(start, 20.0);
    const double scale = scale_of(start, motion);
    const double half = 0.5 * start.servo.backlash;
    for (int k = 0; k < 200; ++k) {
      const double time = draws.uniform(0.0, motion.end_time());
      const double gap = gap_of(motion.at(time));
      const Mode mode = motion.mode_at(time);
      ASSERT_LE(std::abs(gap), half + 64.0 * epsilon * scale) << time;
      if (mode == Mode::engaged_forward || mode == Mode::engaged_backward) {
        const double face = mode == Mode::engaged_forward ? half : -half;
        ASSERT_NEAR(gap, face, 4.0 * epsilon * scale);
      }
    }
  }
}

TEST(PropertyEvents, SegmentsFollowOneAnotherWithoutHoles) {
  SeededDraws draws(405);
  for (int i = 0; i < 300; ++i) {
    const RandomStart start = random_start(draws, {.massless_sides = true});
    const Trajectory motion = run(start, 20.0);
    const std::vector<Segment>& segments = motion.segments();
    ASSERT_FALSE(segments.empty());
    ASSERT_EQ(segments.front().start, 0.0);
    for (std::size_t k = 1; k < segments.size(); ++k) {
      ASSERT_EQ(segments[k - 1].end, segments[k].start) << describe(start);
    }
    ASSERT_EQ(segments.back().end, motion.end_time());
    if (motion.stop_reason() == StopReason::reached_end) {
      ASSERT_EQ(motion.end_time(), 20.0);
    }
  }
}

TEST(EdgeSettling, StatesWithinFollowTheBounces) {
  NormalizedServo servo = sample;
  servo.restitution = 0.5;
  const Trajectory motion =
      simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = 30.0, .reference = 1.0});
  int settlings = 0;
  for (const Segment& segment : motion.segments()) {
    if (segment.phase.mode != Mode::settling) continue;
    ++settlings;
    const double length = segment.end - segment.start;
    ASSERT_GT(length, 0.0);
    const double side = segment.phase.face;
    const double speed = std::abs(segment.phase.flight.gap_speed);
    double previous_height = infinity;
    for (int k = 0; k < 6; ++k) {
      // With e = ½ bounce k fills T/2 · (½)^k; its top is in its middle, at w² /(2a) · (¼)^k.
      const double top_time = segment.start + length * (1.0 - 0.75 * std::ldexp(1.0, -k));
      const ServoState top = motion.at(top_time);
      const double height = 0.5 * servo.backlash - gap_of(top) * side;
      const double expected = speed * 0.5 * length * 0.25 * std::ldexp(1.0, -2 * k);
      // Heights are 1e-11 or less, of positions of order one: counted in their epsilons; and the
      // times are those of the parabola to first order in T.
      EXPECT_NEAR(height, expected, 8.0 * epsilon + 1e-4 * expected);
      EXPECT_LT(height, previous_height + 8.0 * epsilon);
      previous_height = height;
      EXPECT_NEAR(top.motor_speed - top.load_speed, 0.0, 1e-3 * speed);
    }
  }
  EXPECT_GT(settlings, 3);
}

// ---- starts -------------------------------------------------------------------------------------

TEST(EdgeStart, OnAFaceMovingIntoItIsAnImpactAtTimeZero) {
  const ServoState into{0.15, 1.0, 0.0, 0.0};
  const Trajectory motion = simulate(sample, into, {.until = 1.0, .reference = 0.0});
  ASSERT_FALSE(motion.events().empty());
  const Event& first = motion.events().front();
  EXPECT_EQ(first.time, 0.0);
  EXPECT_EQ(first.kind, EventKind::impact);
  EXPECT_EQ(first.face, Face::forward);
  EXPECT_EQ(first.before, into);
  EXPECT_DOUBLE_EQ(first.after.load_speed, 1.0 / 3.0);
  EXPECT_EQ(first.after.load_speed, first.after.motor_speed);
  EXPECT_EQ(motion.at(0.0), first.after);
}

TEST(EdgeStart, OnAFaceMovingAwayIsAFlight) {
  const Trajectory motion =
      simulate(sample, {0.15, -1.0, 0.0, 0.0}, {.until = 0.01, .reference = 0.0});
  EXPECT_TRUE(motion.events().empty());
  EXPECT_EQ(motion.mode_at(0.0), Mode::separated);
}

TEST(EdgeStart, AtRestTogetherPushedOrPulled) {
  // The reference ahead: the forward face pushes; on the backward face it would have to pull.
  const SimulationOptions ahead{.until = 0.01, .reference = 1.0};
  const Trajectory pushed = simulate(sample, {0.15, 0.0, 0.0, 0.0}, ahead);
  EXPECT_EQ(pushed.mode_at(0.0), Mode::engaged_forward);
  const Trajectory pulled = simulate(sample, {-0.15, 0.0, 0.0, 0.0}, ahead);
  EXPECT_EQ(pulled.mode_at(0.0), Mode::separated);
  EXPECT_TRUE(pulled.events().empty());
  // The motor alone runs ahead: u = u₀ + t²/(2 J_M) at first.
  EXPECT_NEAR(gap_of(pulled.at(0.01)), -0.15 + 1.5e-4, 1e-6);
}

TEST(EdgeStart, AtRestOnTheReferenceNothingEverHappens) {
  for (const double gap : {0.15, -0.15, 0.0, 0.1}) {
    const Trajectory motion =
        simulate(sample, {gap, 0.0, 0.0, 0.0}, {.until = 1e6, .reference = 0.0});
    EXPECT_TRUE(motion.events().empty()) << gap;
    EXPECT_EQ(motion.at(1e6), (ServoState{gap, 0.0, 0.0, 0.0})) << gap;
  }
}

TEST(EdgeStart, EngagedStartIsOnTheFaceTheMotorPushesWith) {
  EXPECT_EQ(engaged_start(sample, 0.2, 0.5, 1.0), (ServoState{0.2 + 0.15, 0.5, 0.2, 0.5}));
  EXPECT_EQ(engaged_start(sample, 0.2, 0.5, -1.0), (ServoState{0.2 - 0.15, 0.5, 0.2, 0.5}));
  EXPECT_EQ(engaged_start(sample, 1.0, 0.0, 1.0), (ServoState{1.15, 0.0, 1.0, 0.0}));
}

TEST(EdgeStart, AGapWithinRoundingOfAFaceIsOnIt) {
  // 0.7 + 0.15 − 0.7 is not 0.15 in double precision.
  const ServoState state = engaged_start(sample, 0.7, 0.0, 1.0);
  ASSERT_NE(state.motor_position - state.load_position, 0.15);
  const Trajectory motion = simulate(sample, state, {.until = 0.1, .reference = 1.0});
  EXPECT_EQ(motion.mode_at(0.0), Mode::engaged_forward);
  EXPECT_TRUE(motion.events().empty());
}

TEST(EdgeStart, BadStartsAreRefusedByName) {
  const auto refused = [](const ServoState& initial, const SimulationOptions& options) {
    std::vector<std::string> fields;
    try {
      simulate(sample, initial, options);
    } catch (const InvalidInput& error) {
      for (const Fault& v : error.faults()) fields.push_back(v.path);
    }
    return fields;
  };
  using ::testing::Contains;
  using ::testing::ElementsAre;
  const SimulationOptions sound{.until = 1.0};
  EXPECT_THAT(refused({}, sound), ElementsAre());
  EXPECT_THAT(refused({0.1501, 0.0, 0.0, 0.0}, sound),
              ElementsAre("initial.motor_position - initial.load_position"));
  EXPECT_THAT(refused({-0.1501, 0.0, 0.0, 0.0}, sound),
              ElementsAre("initial.motor_position - initial.load_position"));
  for (const double bad : {nan, infinity, -infinity, 1e300}) {
    EXPECT_THAT(refused({bad, 0.0, 0.0, 0.0}, sound), Contains("initial.motor_position")) << bad;
    EXPECT_THAT(refused({0.0, bad, 0.0, 0.0}, sound), ElementsAre("initial.motor_speed")) << bad;
    EXPECT_THAT(refused({0.0, 0.0, bad, 0.0}, sound), Contains("initial.load_position")) << bad;
    EXPECT_THAT(refused({0.0, 0.0, 0.0, bad}, sound), ElementsAre("initial.load_speed")) << bad;
    EXPECT_THAT(refused({}, {.until = 1.0, .reference = bad}), ElementsAre("reference")) << bad;
  }
  for (const double bad : {nan, infinity, -1.0, -5e-324}) {
    EXPECT_THAT(refused({}, {.until = bad}), ElementsAre("until")) << bad;
  }
  EXPECT_THAT(refused({0.0, nan, 0.0, nan}, {.until = -1.0, .reference = nan}),
              ElementsAre("initial.motor_speed", "initial.load_speed", "reference", "until"));
  NormalizedServo unsound = sample;
  unsound.damping = -1.0;
  EXPECT_THROW(simulate(unsound, {}, sound), InvalidInput);
}

TEST(EdgeEnd, UntilZeroAndEventLimits) {
  const ServoState start = engaged_start(sample, 0.0, 0.0, 1.0);
  const Trajectory none = simulate(sample, start, {.until = 0.0});
  EXPECT_EQ(none.end_time(), 0.0);
  EXPECT_TRUE(none.events().empty());
  EXPECT_EQ(none.stop_reason(), StopReason::reached_end);
  EXPECT_EQ(none.at(0.0), start);

  const Trajectory whole = simulate(sample, start, {.until = 100.0});
  ASSERT_GT(whole.events().size(), 10U);
  for (const std::size_t limit : {0U, 1U, 5U}) {
    const Trajectory cut = simulate(sample, start, {.until = 100.0, .event_limit = limit});
    EXPECT_EQ(cut.stop_reason(), StopReason::event_limit);
    ASSERT_EQ(cut.events().size(), limit);
    EXPECT_GT(cut.end_time(), 0.0);
    EXPECT_LT(cut.end_time(), 100.0);
    for (std::size_t k = 0; k < limit; ++k) {
      EXPECT_EQ(cut.events()[k].time, whole.events()[k].time);
      EXPECT_GE(cut.end_time(), cut.events()[k].time);
    }
    EXPECT_EQ(cut.at(1e9), cut.at(cut.end_time()));
  }
  // The impact at time zero counts as well.
  const Trajectory at_once =
      simulate(sample, {0.15, 1.0, 0.0, 0.0}, {.until = 1.0, .reference = 0.0, .event_limit = 0});
  EXPECT_LE(at_once.events().size(), 0U);
}

TEST(EdgeEnd, TimesOutsideAreClamped) {
  const Trajectory motion = simulate(sample, engaged_start(sample, 0.0, 0.0, 1.0), {.until = 10.0});
  EXPECT_EQ(motion.at(-1.0), motion.at(0.0));
  EXPECT_EQ(motion.at(1e300), motion.at(10.0));
  EXPECT_EQ(motion.mode_at(-1.0), motion.mode_at(0.0));
  EXPECT_EQ(motion.mode_at(11.0), motion.mode_at(10.0));
}

}  // namespace
}  // namespace gearlash::trajectory_event_test
