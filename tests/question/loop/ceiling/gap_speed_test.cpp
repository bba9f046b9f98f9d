// The speed of the gap, efforts that contain it, and starts that never meet the torque limit.
#include "question/loop/ceiling/gap_speed.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/drive_count.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/motion.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"

namespace gearlash::gap_speed_test {
namespace {

using testing::HasSubstr;

/// A gap that a constant acceleration crosses without end: faces at 0 and b, each impact reversing
/// the push. The speed before impacts tends to w² (1 − e²) = 2 a b.
TEST(OracleGapSpeed, IsThatOfAPushThatTurnsWithEveryImpact) {
  constexpr double backlash = 0.3;
  constexpr double push = 7.0;
  for (const double restitution : {0.0, 0.4, 0.8}) {
    double speed = 0.0;
    for (int i = 0; i < 400; ++i) {
      const double start = restitution * speed;
      speed = std::sqrt(start * start + 2.0 * push * backlash);
    }
    const double bound = highest_gap_speed({.backlash = backlash,
                                            .restitution = restitution,
                                            .acceleration = push,
                                            .per_speed = 0.0,
                                            .slope = 0.0})
                             .highest;
    EXPECT_GE(bound, speed * (1.0 - 1e-14));
    EXPECT_LE(bound, speed * (1.0 + 1e-14));
  }
}

/// ü = a − 5 u̇ tends to a/5.
TEST(OracleGapSpeed, IsBrakedByFriction) {
  const GapMotion motion{
      .backlash = 1e3, .restitution = 1.0, .acceleration = 2.0, .per_speed = 1.0, .slope = -5.0};
  EXPECT_NEAR(highest_gap_speed(motion).highest, 0.5, 1e-12);
  GapMotion elastic = motion;
  elastic.slope = -0.5;
  EXPECT_EQ(highest_gap_speed(elastic).highest, infinity);
}

/// (1 − e²) w² = 2 b (a + β w), by the roots of the quadratic.
TEST(OracleGapSpeed, IsTheRootOfTheQuadraticWithFeedback) {
  const double lost = 1.0 - 0.5 * 0.5;
  const double push = 0.2 * (0.3 + 4.0);
  const double root = (push + std::sqrt(push * push + 2.0 * 0.2 * lost * 6.0)) / lost;
  EXPECT_NEAR(highest_gap_speed({.backlash = 0.2,
                                 .restitution = 0.5,
                                 .acceleration = 6.0,
                                 .per_speed = 0.3,
                                 .slope = 4.0})
                  .highest,
              root, 1e-12 * root);
}

// ---- motion -------------------------------------------------------------------------------------

/// PD without a filter on the motor or with a tachometer, of a loop of about 1 rad/s.
Drive random_drive(SeededDraws& draws, bool is_sampled) {
  Drive drive;
  const double inertia_ratio = draws.log_uniform(0.2, 5.0);
  const auto friction = [&] {
    const double coulomb = draws.happens(0.4) ? draws.log_uniform(1e-4, 2e-2) : 0.0;
    return Friction{.viscous = draws.log_uniform(0.01, 0.3), .coulomb = coulomb};
  };
  drive.motor = {
      .kind = TorqueControl{}, .inertia = 1.0 / (1.0 + inertia_ratio), .friction = friction()};
  drive.load = {.inertia = inertia_ratio / (1.0 + inertia_ratio), .friction = friction()};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.contact = RigidContact{draws.one_of({0.0, 0.3, 0.6, 0.9})};
  drive.sensor.position = draws.happens(0.5) ? SensorPlace::load : SensorPlace::motor;
  drive.sensor.speed = draws.happens(0.3) ? ShaftName::load : ShaftName::motor;
  drive.controller.law = PID{.terms = PIDTerms::PD,
                             .proportional = 1.0,
                             .derivative = draws.log_uniform(0.02, 0.8),
                             .derivative_of_speed = true};
  if (is_sampled) {
    // The torque jumps at the ticks unless a winding lags.
    const double electrical_time = draws.log_uniform(0.01, 0.2);
    if (draws.happens(0.5)) drive.motor.kind = ArmatureControl{1.0, 0.0, 1.0, electrical_time};
    drive.sampling =
        Sampling{.period = draws.log_uniform(0.02, 0.2), .speed_by_differences = false};
  }
  if (draws.happens(0.5)) drive.load_torque = draws.uniform(-0.03, 0.03);
  return drive;
}

struct Extremes {
  double load = 0.0;
  double effort = 0.0;
  double gap_speed = 0.0;
};

/// From `from` to `until`, of the motion about rest.
Extremes extremes_of(const Motion& motion, const Drive& drive, double from, double until) {
  const double load_torque = drive.load_torque ? std::get<double>(*drive.load_torque) : 0.0;
  Extremes extremes;
  const auto include = [&](const MotionSample& sample) {
    extremes.load = std::max(extremes.load, std::abs(sample.shafts.load_position - load_torque));
    extremes.effort = std::max(extremes.effort, std::abs(sample.motor_torque + load_torque));
    extremes.gap_speed = std::max(extremes.gap_speed,
                                  std::abs(sample.shafts.motor_speed - sample.shafts.load_speed));
  };
  for (const MotionEvent& event : motion.events()) {
    if (event.time < from || event.time > until) continue;
    include(motion.at(event.time));
    include(motion.at(event.time - 1e-9));
  }
  for (int k = 0; k <= 4000; ++k) include(motion.at(from + (until - from) * k / 4000.0));
  return extremes;
}

TEST(PropertyGapSpeed, EffortsThatContainItAreNotExceededByMotionThatIsFollowed) {
  SeededDraws draws(20261127);
  int bounded = 0;
  double nearest_effort = 0.0;
  double nearest_speed = 0.0;
  for (int i = 0; i < test::drive_count(60); ++i) {
    const Drive drive = random_drive(draws, i % 2 == 1);
    const Ceiling ceiling = ceiling_of(reduce(drive));
    if (!ceiling.effort) continue;
    ++bounded;
    SCOPED_TRACE("drive " + std::to_string(i));
    constexpr double until = 400.0;
    const Motion motion = simulate(drive, {.until = until, .start = Start{.load_position = 0.5}});
    if (motion.stop() != MotionStop::reached_end) continue;
    const Extremes found = extremes_of(motion, drive, 0.8 * until, until);
    EXPECT_LE(found.effort, *ceiling.effort * (1.0 + 1e-6) + 1e-4);
    EXPECT_LE(found.load, *ceiling.load * (1.0 + 1e-6) + 1e-4);
    nearest_effort = std::max(nearest_effort, found.effort / *ceiling.effort);
    for (const CeilingTerm& term : ceiling.terms) {
      if (term.source != "gap speed") continue;
      EXPECT_LE(found.gap_speed, term.size * (1.0 + 1e-6) + 1e-4);
      nearest_speed = std::max(nearest_speed, found.gap_speed / term.size);
    }
  }
  std::printf("%d drives; the nearest came to %.3f of the effort and %.3f of the speed\n", bounded,
              nearest_effort, nearest_speed);
  EXPECT_GT(bounded, 40);
  EXPECT_GT(nearest_effort, 0.1);
  EXPECT_GT(nearest_speed, 0.1);
}

TEST(EdgeGapSpeed, ElasticFacesOfASampledTachometerHaveNoCeilingUnlessTheyAreBraked) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 0.5, .friction = {.viscous = 0.01}};
  drive.load = {.inertia = 0.5, .friction = {.viscous = 0.01}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.contact = RigidContact{1.0};
  drive.sensor.position = SensorPlace::motor;
  drive.controller.law = PID{.terms = PIDTerms::PD, .proportional = 1.0, .derivative = 0.5};
  EXPECT_TRUE(ceiling_of(reduce(drive)).effort);  // the controller itself brakes
  drive.sampling = Sampling{.period = 0.01, .speed_by_differences = false};
  const Ceiling ceiling = ceiling_of(reduce(drive));
  EXPECT_FALSE(ceiling.load);
  EXPECT_THAT(ceiling.reason, HasSubstr("tachometer"));
  drive.contact = RigidContact{0.5};
  EXPECT_TRUE(ceiling_of(reduce(drive)).load);
  drive.contact = CompliantContact{.stiffness = 100.0};
  EXPECT_TRUE(ceiling_of(reduce(drive)).load);
  drive.contact = RigidContact{0.5};
  drive.reference = SineSignal{.amplitude = 1.0, .frequency = 1.0};
  EXPECT_THAT(ceiling_of(reduce(drive)).reason, HasSubstr("moves"));
}

TEST(Ceiling, WidestBacklashWithATachometerIsOnTheSafeSide) {
  Drive drive;
  drive.motor = {
      .kind = ArmatureControl{1.0, 0.0, 1.0, 0.1}, .inertia = 0.5, .friction = {.viscous = 0.1}};
  drive.load = {.inertia = 0.5, .friction = {.viscous = 0.1, .coulomb = 0.01}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.sensor.position = SensorPlace::motor;
  drive.controller.law = PID{.terms = PIDTerms::PD, .proportional = 1.0, .derivative = 0.5};
  drive.sampling = Sampling{.period = 0.02, .speed_by_differences = false};
  const Ceiling ceiling = ceiling_of(reduce(drive));
  ASSERT_TRUE(ceiling.load) << ceiling.reason;
  for (const double share : {0.7, 0.95, 1.5, 4.0}) {
    const auto widest = ceiling.widest_backlash(share * *ceiling.load, 0.1);
    ASSERT_TRUE(widest) << share;
    Drive wider = drive;
    wider.gearbox.backlash = *widest;
    EXPECT_LE(*ceiling_of(reduce(wider)).load, share * *ceiling.load);
    EXPECT_GE(*ceiling_of(reduce(wider)).load, 0.5 * share * *ceiling.load);
  }
}

// ---- starts below the limit ---------------------------------------------------------------------

/// From the borders of the stated set, with filtered and unfiltered derivatives, no motion meets
/// the limit.
TEST(PropertySafeStarts, NeverMeetTheTorqueLimit) {
  SeededDraws draws(20261128);
  int stated = 0;
  double nearest = 0.0;
  int compliant = 0;
  for (int i = 0; i < test::drive_count(80); ++i) {
    Drive drive = random_drive(draws, i % 3 == 2);
    if (i % 3 == 2) drive.sampling->speed_by_differences = true;
    if (i % 4 == 3) drive.contact = CompliantContact{draws.log_uniform(2.0, 100.0), 0.0};
    drive.load_torque.reset();
    PID& pid = std::get<PID>(drive.controller.law);
    if (i % 3 == 1) {
      pid.filter = draws.log_uniform(0.02, 0.3);
      pid.derivative_of_speed = false;
    }
    const Ceiling free = ceiling_of(reduce(drive));
    if (!free.effort) continue;
    drive.motor.limit = *free.effort * draws.uniform(1.1, 8.0);
    const Ceiling ceiling = ceiling_of(reduce(drive));
    if (!ceiling.safe_starts) continue;
    ++stated;
    SCOPED_TRACE("drive " + std::to_string(i));
    const double share = draws.one_of({0.0, 0.5, 1.0});
    const double position = share * ceiling.safe_starts->position;
    const double speed = (1.0 - share) * ceiling.safe_starts->speed;
    Drive free_drive = drive;
    free_drive.motor.limit.reset();
    compliant += i % 4 == 3 ? 1 : 0;
    // The position is the mean of both shafts' by their inertias.
    const double gap = drive.gearbox.backlash * draws.one_of({-0.5, 0.0, 0.5});
    const double of_motor = drive.motor.inertia / (drive.motor.inertia + drive.load.inertia);
    const Motion motion = simulate(
        free_drive,
        {.until = 60.0,
         .start =
             Start{.load_position = position - of_motor * gap, .load_speed = speed, .gap = gap}});
    const Extremes found = extremes_of(motion, free_drive, 0.0, 60.0);
    EXPECT_LE(found.effort, *drive.motor.limit);
    nearest = std::max(nearest, found.effort / *drive.motor.limit);
  }
  std::printf("%d drives; the nearest came to %.3f of the limit\n", stated, nearest);
  EXPECT_GT(stated, 30);
  EXPECT_GT(compliant, 8);
  EXPECT_GT(nearest, 0.4);
}

}  // namespace
}  // namespace gearlash::gap_speed_test
