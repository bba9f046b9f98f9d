// Mirror images, scaled copies and restarts of a motion are that motion again.
#include <gtest/gtest.h>

#include <vector>

#include "base/traced_draws.hpp"
#include "closed_form/trajectory.hpp"
#include "random_starts.hpp"

namespace gearlash::trajectory_symmetry_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

ServoState scaled(const ServoState& state, double factor) {
  return {factor * state.motor_position, factor * state.motor_speed, factor * state.load_position,
          factor * state.load_speed};
}

RandomStart scaled(const RandomStart& start, double factor) {
  RandomStart result = start;
  result.servo.backlash *= std::abs(factor);
  result.initial = scaled(start.initial, factor);
  result.reference *= factor;
  return result;
}

/// Elastic faces pressed together bounce ever faster under the drag: a thousand events will do.
constexpr std::size_t event_limit = 1000;

Trajectory run(const RandomStart& start, double until) {
  return simulate(start.servo, start.initial,
                  {.until = until, .reference = start.reference, .event_limit = event_limit});
}

bool complete(const Trajectory& motion) { return motion.stop_reason() == StopReason::reached_end; }

/// Equal, or both so small that scaling meets subnormal numbers, which have fewer bits.
bool same(double a, double b) {
  constexpr double smallest = 1e-290;
  return a == b || (std::abs(a) < smallest && std::abs(b) < smallest);
}

bool same(const ServoState& a, const ServoState& b) {
  return same(a.motor_position, b.motor_position) && same(a.motor_speed, b.motor_speed) &&
         same(a.load_position, b.load_position) && same(a.load_speed, b.load_speed);
}

/// Everything of `b` is `factor` times that of `a`, bit for bit; a negative factor mirrors.
void expect_same_bits(const Trajectory& a, const Trajectory& b, double factor, double until) {
  ASSERT_EQ(a.events().size(), b.events().size());
  for (std::size_t i = 0; i < a.events().size(); ++i) {
    const Event& x = a.events()[i];
    const Event& y = b.events()[i];
    ASSERT_EQ(x.time, y.time) << "event " << i;
    ASSERT_EQ(x.kind, y.kind) << "event " << i;
    ASSERT_EQ(x.face == y.face, factor > 0.0) << "event " << i;
    ASSERT_TRUE(same(scaled(x.before, factor), y.before)) << "event " << i;
    ASSERT_TRUE(same(scaled(x.after, factor), y.after)) << "event " << i;
    ASSERT_TRUE(same(x.energy_lost * factor * factor, y.energy_lost)) << "event " << i;
  }
  for (int k = 0; k <= 50; ++k) {
    const double time = until * k / 50.0;
    ASSERT_TRUE(same(scaled(a.at(time), factor), b.at(time))) << time;
  }
  const EnergyAccount x = a.energy_at(until);
  const EnergyAccount y = b.energy_at(until);
  const double square = factor * factor;
  ASSERT_TRUE(same(x.kinetic * square, y.kinetic));
  ASSERT_TRUE(same(x.elastic * square, y.elastic));
  ASSERT_TRUE(same(x.motor_friction * square, y.motor_friction));
  ASSERT_TRUE(same(x.load_friction * square, y.load_friction));
  ASSERT_TRUE(same(x.impacts * square, y.impacts));
  ASSERT_TRUE(same(x.supplied * square, y.supplied));
}

constexpr RandomRange everything{.largest_damping = 3.0,
                                 .smallest_inertia_ratio = 1e-6,
                                 .largest_inertia_ratio = 1e6,
                                 .massless_sides = true};

TEST(PropertyTrajectory, MirrorImageBitForBit) {
  TracedDraws draws(201);
  for (int i = 0; i < 500 && !testing::Test::HasFailure(); ++i) {
    const RandomStart start = random_start(draws, everything);
    SCOPED_TRACE(describe(start));
    expect_same_bits(run(start, 20.0), run(scaled(start, -1.0), 20.0), -1.0, 20.0);
  }
}

TEST(PropertyTrajectory, ScaledByAPowerOfTwoBitForBit) {
  TracedDraws draws(202);
  for (int i = 0; i < 500 && !testing::Test::HasFailure(); ++i) {
    const RandomStart start = random_start(draws, everything);
    SCOPED_TRACE(describe(start));
    const double factor = draws.one_of({0x1p-20, 0.5, 4.0, 0x1p+15});
    expect_same_bits(run(start, 20.0), run(scaled(start, factor), 20.0), factor, 20.0);
  }
}

/// How far the event times and end states of two motions lie apart, relative to their scale; NaN
/// when they do not have the same events.
double deviation(const Trajectory& a, const Trajectory& b, double factor, double scale,
                 double time_offset, double until) {
  std::vector<const Event*> later;
  for (const Event& event : a.events()) {
    if (event.time > time_offset) later.push_back(&event);
  }
  if (later.size() != b.events().size()) return std::numeric_limits<double>::quiet_NaN();
  double largest =
      distance(scaled(a.at(until), factor), b.at(until - time_offset)) / (factor * scale);
  for (std::size_t i = 0; i < later.size(); ++i) {
    const Event& x = *later[i];
    const Event& y = b.events()[i];
    if (x.kind != y.kind || x.face != y.face) return std::numeric_limits<double>::quiet_NaN();
    largest = std::max({largest, std::abs(x.time - time_offset - y.time),
                        distance(scaled(x.before, factor), y.before) / (factor * scale),
                        distance(scaled(x.after, factor), y.after) / (factor * scale)});
  }
  return largest;
}

/// The motion's own condition: how much a disturbance of both shafts by one part in 1e9 grows. A
/// copy that differs by rounding may differ by as many epsilons, and by epsilons of the time.
struct Condition {
  bool known;
  double growth;
};

Condition condition(const RandomStart& start, const Trajectory& motion, double until) {
  constexpr double disturbance = 1e-9;
  RandomStart disturbed = start;
  const double step = disturbance * start.scale();
  disturbed.initial.load_position += step;
  disturbed.initial.motor_position += step;
  // In the gap the distance to the faces is disturbed too: it is a difference of two positions.
  const double gap = start.initial.motor_position - start.initial.load_position;
  if (motion.mode_at(0.0) == Mode::separated) {
    disturbed.initial.motor_position -= std::copysign(0.5 * step, gap);
  }
  disturbed.initial.load_speed -= step;
  disturbed.initial.motor_speed -= step;
  const double moved = deviation(motion, run(disturbed, until), 1.0, start.scale(), 0.0, until);
  return {!std::isnan(moved), moved / disturbance};
}

/// A few dozen roundings a phase, each of which the rest of the motion magnifies.
double permitted(const Condition& c, const Trajectory& motion, double until) {
  const double phases = static_cast<double>(motion.segments().size());
  return 64.0 * epsilon * phases * (1.0 + until + c.growth);
}

TEST(PropertyTrajectory, ScaledByAnyFactorToRounding) {
  TracedDraws draws(203);
  int compared = 0;
  int cut_short = 0;
  constexpr int count = 1000;
  constexpr double until = 12.0;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const RandomStart start = random_start(draws);
    SCOPED_TRACE(describe(start));
    const Trajectory motion = run(start, until);
    if (!complete(motion)) {
      ++cut_short;
      continue;
    }
    const Condition c = condition(start, motion, until);
    if (!c.known) continue;  // a graze within 1e-9: which side it falls is not determined
    const double factor = draws.log_uniform(0.01, 100.0);
    const double apart =
        deviation(motion, run(scaled(start, factor), until), factor, start.scale(), 0.0, until);
    ASSERT_LE(apart, permitted(c, motion, until)) << "factor " << factor;
    ++compared;
  }
  EXPECT_GT(compared, (count - cut_short) * 9 / 10);
  EXPECT_LT(cut_short, count / 5);
}

TEST(PropertyTrajectory, RestartedFromItsOwnStateItGoesOnAsBefore) {
  TracedDraws draws(204);
  int compared = 0;
  int cut_short = 0;
  constexpr int count = 1500;
  constexpr double until = 12.0;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    RandomStart start = random_start(draws, {.massless_sides = true});
    SCOPED_TRACE(describe(start));
    const Trajectory motion = run(start, until);
    if (!complete(motion)) {
      ++cut_short;
      continue;
    }
    const double time = draws.uniform(0.0, until);
    SCOPED_TRACE(time);
    if (motion.mode_at(time) == Mode::settling) continue;
    RandomStart middle = start;
    middle.initial = motion.at(time);
    const Trajectory rest = run(middle, until - time);
    const Condition c = condition(middle, rest, until - time);
    if (!c.known) continue;
    const double apart = deviation(motion, rest, 1.0, start.scale(), time, until);
    ASSERT_LE(apart, permitted(c, motion, until));
    ++compared;
  }
  EXPECT_GT(compared, (count - cut_short) * 85 / 100);
  EXPECT_LT(cut_short, count / 5);
}

TEST(PropertyTrajectory, ALaterEndChangesNothingBefore) {
  SeededDraws draws(205);
  for (int i = 0; i < 200; ++i) {
    const RandomStart start = random_start(draws, everything);
    const Trajectory shorter = run(start, 7.0);
    const Trajectory longer = run(start, 20.0);
    if (!complete(longer)) continue;
    ASSERT_LE(shorter.events().size(), longer.events().size());
    for (std::size_t k = 0; k < shorter.events().size(); ++k) {
      // The horizon may end the search for a root from another guess: times agree to rounding.
      ASSERT_EQ(shorter.events()[k].kind, longer.events()[k].kind) << describe(start);
      ASSERT_NEAR(shorter.events()[k].time, longer.events()[k].time, 1e-9) << describe(start);
    }
  }
}

}  // namespace
}  // namespace gearlash::trajectory_symmetry_test
