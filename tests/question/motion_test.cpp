// The motion of a drive: the same from either engine, and that of the engines themselves.
#include "gearlash/motion.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <string>

#include "base/stopping.hpp"
#include "closed_form/trajectory.hpp"
#include "question/motion.hpp"

namespace gearlash::motion_test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr double rate = 14.5;

Drive sample_drive(double restitution = 0.0) {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3, restitution);
  drive.servo->natural_frequency = rate;
  drive.reference = 1.0;
  return drive;
}

/// A limit that is never reached: the general engine's, with the same motion.
Drive general_drive() {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 1.0, .friction = {.viscous = 0.9}};
  drive.load = {.inertia = 2.0, .friction = {.viscous = 0.1}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.3};
  drive.controller.law = PID{.proportional = 3.0};
  drive.reference = 1.0;
  return drive;
}

Drive limited(Drive drive) {
  drive.motor.limit = 1e9;
  return drive;
}

TEST(Motion, IsSampledAtAnyTimes) {
  for (const Drive& drive : {sample_drive(), general_drive()}) {
    const Motion motion = simulate(drive, {.until = 2.0});
    const std::array times = {1.3, 0.0, 0.77, 2.0, 0.77};
    const Samples samples = motion.at(times);
    ASSERT_EQ(samples.time.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      const MotionSample one = motion.at(times[i]);
      EXPECT_EQ(samples.time[i], times[i]);
      EXPECT_EQ(samples.load_position[i], one.shafts.load_position);
      EXPECT_EQ(samples.motor_speed[i], one.shafts.motor_speed);
      EXPECT_EQ(samples.motor_torque[i], one.motor_torque);
    }
    for (const double outside : {-1e-9, 2.1, std::nan("")}) {
      EXPECT_THROW((void)motion.at(std::array{outside}), InvalidInput);
    }
  }
}

TEST(Motion, GivesAHundredMillionSamplesAtMost) {
  const Motion motion = simulate(sample_drive(), {.until = 2.0});
  EXPECT_THROW((void)motion.sampled(1e-9), InvalidInput);
  EXPECT_THROW((void)motion.sampled(1e-300), InvalidInput);
}

TEST(Motion, SamplingCanBeStopped) {
  test::Stopping stop;
  EXPECT_TRUE(simulate(sample_drive(), {.until = 2.0}).sampled(0.1, stop).time.empty());
}

TEST(OracleMotion, OfTheClosedFormIsItsTrajectoryInSeconds) {
  const NormalizedServo servo{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};
  const Motion motion = simulate(sample_drive(), {.until = 2.0});
  const Trajectory trajectory =
      simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = 2.0 * rate, .reference = 1.0});
  EXPECT_EQ(motion.engine(), Engine::closed_form);
  ASSERT_EQ(motion.events().size(), trajectory.events().size());
  for (std::size_t i = 0; i < motion.events().size(); ++i) {
    EXPECT_EQ(motion.events()[i].time, trajectory.events()[i].time / rate);
    EXPECT_EQ(motion.events()[i].after.motor_speed,
              trajectory.events()[i].after.motor_speed * rate);
  }
  for (const double time : {0.0, 0.1, 0.77, 2.0}) {
    const MotionSample sample = motion.at(time);
    const ServoState state = trajectory.at(time * rate);
    EXPECT_EQ(sample.shafts.load_position, state.load_position);
    EXPECT_EQ(sample.shafts.load_speed, state.load_speed * rate);
    EXPECT_EQ(sample.shafts.motor_position, state.motor_position);
    EXPECT_EQ(sample.shafts.motor_speed, state.motor_speed * rate);
    EXPECT_DOUBLE_EQ(sample.motor_torque, rate * rate * (1.0 - state.load_position));
    EXPECT_EQ(sample.reference, 1.0);
  }
}

TEST(OracleMotion, IsTheSameFromBothEngines) {
  const Motion closed = simulate(general_drive(), {.until = 12.0});
  const Motion general = simulate(limited(general_drive()), {.until = 12.0});
  EXPECT_EQ(closed.engine(), Engine::closed_form);
  EXPECT_EQ(general.engine(), Engine::general);
  ASSERT_GT(closed.events().size(), 4U);
  ASSERT_EQ(closed.events().size(), general.events().size());
  for (std::size_t i = 0; i < closed.events().size(); ++i) {
    EXPECT_NEAR(closed.events()[i].time, general.events()[i].time, 1e-11);
    EXPECT_EQ(closed.events()[i].what, general.events()[i].what);
    EXPECT_EQ(closed.events()[i].mode_after, general.events()[i].mode_after);
  }
  for (double time = 0.05; time < 12.0; time += 0.37) {
    const MotionSample one = closed.at(time);
    const MotionSample other = general.at(time);
    EXPECT_NEAR(one.shafts.load_position, other.shafts.load_position, 1e-11);
    EXPECT_NEAR(one.shafts.motor_speed, other.shafts.motor_speed, 1e-11);
    EXPECT_NEAR(one.motor_torque, other.motor_torque, 1e-10);
    EXPECT_EQ(one.mode, other.mode);
    EXPECT_EQ(one.is_apart, other.is_apart);
  }
}

TEST(Motion, OfAStepAtTheStartHasAClosedForm) {
  Drive drive = sample_drive();
  drive.reference = StepSignal{.before = 0.0, .after = 1.0, .time = 0.0};
  const Motion motion = simulate(drive, {.until = 1.0});
  EXPECT_EQ(motion.engine(), Engine::closed_form);
  EXPECT_EQ(motion.at(1.0).shafts.load_position,
            simulate(sample_drive(), {.until = 1.0}).at(1.0).shafts.load_position);
}

/// Bounces settle while the load's speed passes 0 between two of them: the last firing has led to
/// another mode than the one whose faces settle.
TEST(Motion, NamesASettlingThatChangesTheModeTwice) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{},
                 .inertia = 0.22604871219172623,
                 .friction = {.viscous = 0.19875536782470948}};
  drive.load = {.inertia = 0.7739512878082737,
                .friction = {.viscous = 0.015601170534170438, .coulomb = 0.017854820486427173}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.contact = RigidContact{.restitution = 0.4};
  drive.controller.law = PID{.terms = PIDTerms::PID,
                             .proportional = 1.0,
                             .integral = 0.039052346908240186,
                             .derivative = 0.1651237817355332,
                             .filter = 0.034846518159327045};
  drive.reference = 0.0008660245662213129;
  const Motion motion = simulate(drive, {.until = 31.0, .start = Start{.load_position = 1.0}});
  std::size_t settled = 0;
  for (const MotionEvent& event : motion.events()) {
    EXPECT_THAT(std::string(event.what), AnyOf(HasSubstr("impact"), HasSubstr("faces"),
                                               HasSubstr("stop"), HasSubstr("break")));
    settled += event.what.ends_with("(settled)") ? 1U : 0U;
  }
  EXPECT_GT(settled, 0U);
}

TEST(Motion, HasNoTicksAmongItsEvents) {
  Drive drive = general_drive();
  drive.sampling = Sampling{.period = 0.01};
  const Motion motion = simulate(drive, {.until = 5.0});
  ASSERT_FALSE(motion.events().empty());
  EXPECT_LT(motion.events().size(), 50U);
  for (const MotionEvent& event : motion.events())
    EXPECT_THAT(event.what, AnyOf(HasSubstr("faces"), HasSubstr("impact")));
}

TEST(Motion, IsStoppedOnItsWayByProgress) {
  Drive drive = general_drive();
  drive.sampling = Sampling{.period = 0.01};
  auto progress = test::Stopping::at(0.5);
  const Motion motion = simulate(drive, {.until = 1000.0}, progress);
  EXPECT_EQ(motion.stop(), MotionStop::stopped);
  EXPECT_GE(motion.end_time(), 500.0);
  EXPECT_LT(motion.end_time(), 600.0);
}

TEST(Motion, OutlivesWhatItWasMadeOf) {
  Motion copy;
  EXPECT_EQ(copy.stop(), MotionStop::stopped);
  {
    Drive drive = general_drive();
    drive.motor.friction.coulomb = 0.05;
    const Motion motion = simulate(drive, {.until = 5.0});
    copy = motion;
  }
  ASSERT_FALSE(copy.events().empty());
  EXPECT_THAT(std::string(copy.events().back().what), Not(testing::IsEmpty()));
}

TEST(Motion, IsSampledAtTheTimesThatOneWouldWrite) {
  const Motion motion = simulate(sample_drive(), {.until = 0.03});
  const Samples samples = motion.sampled(0.003);
  ASSERT_EQ(samples.time.size(), 11U);
  EXPECT_EQ(samples.time[3], 0.009);
  EXPECT_EQ(samples.time[10], 0.03);
  EXPECT_EQ(samples.load_torque.size(), 11U);
  EXPECT_EQ(samples.motor_position[10], motion.at(0.03).shafts.motor_position);
  EXPECT_THROW(static_cast<void>(motion.sampled(0.0)), InvalidInput);
}

TEST(Motion, StopsAfterSoManyEvents) {
  for (const Drive& drive : {general_drive(), limited(general_drive())}) {
    const Motion motion = simulate(drive, {.until = 100.0, .most_events = 3});
    EXPECT_EQ(motion.stop(), MotionStop::event_limit);
    EXPECT_EQ(motion.stop_text(), "after 3 events");
    EXPECT_LT(motion.end_time(), 100.0);
  }
}

/// Faces that a load torque keeps together have no events, but steps that are kept.
TEST(Motion, StopsAfterSoManySteps) {
  Drive drive = limited(general_drive());
  drive.sensor.position = SensorPlace::motor;
  drive.load_torque = SineSignal{.mean = 10.0, .amplitude = 1.0, .frequency = 6.0, .phase = 0.0};
  const Motion motion = simulate(drive, {.until = 1e9});
  EXPECT_EQ(motion.stop(), MotionStop::step_limit);
  EXPECT_EQ(motion.stop_text(), "after " + std::to_string(most_steps_of_a_motion) + " steps");
  EXPECT_LT(motion.events().size(), 10U);
  EXPECT_EQ(std::string(name_of(motion.stop())), "step_limit");
}

TEST(Motion, BooksOfItsEnergyBalance) {
  const std::optional<EnergyBooks> books = simulate(sample_drive(0.3), {.until = 3.0}).energy();
  ASSERT_TRUE(books.has_value());
  const double in = books->stored_at_start + books->supplied;
  const double out = books->stored + books->motor_friction + books->load_friction + books->impacts;
  // Sums of some ten segments each, by quadrature to a double's last digits.
  EXPECT_NEAR(in, out, 1e-12 * in);
  EXPECT_NEAR(books->stored_at_start, 0.5 * rate * rate, 1e-12 * in);
  EXPECT_FALSE(simulate(limited(general_drive()), {.until = 1.0}).energy().has_value());
}

TEST(Motion, BeginsWhereItIsTold) {
  const Start start{.load_position = 0.5, .load_speed = 0.25, .gap = 0.01, .gap_speed = -0.5};
  for (const Drive& drive : {general_drive(), limited(general_drive())}) {
    const Shafts shafts = simulate(drive, {.until = 1.0, .start = start}).at(0.0).shafts;
    EXPECT_DOUBLE_EQ(shafts.load_position, 0.5);
    EXPECT_DOUBLE_EQ(shafts.load_speed, 0.25);
    EXPECT_DOUBLE_EQ(shafts.motor_position, 0.51);
    EXPECT_DOUBLE_EQ(shafts.motor_speed, -0.25);
  }
}

TEST(EdgeMotion, FaultsOfTheSpanAreToldTogether) {
  const Start start{.load_position = NAN, .gap = 2.0};
  for (const Drive& drive : {general_drive(), limited(general_drive())}) {
    try {
      static_cast<void>(simulate(drive, {.until = -1.0, .start = start}));
      ADD_FAILURE();
    } catch (const InvalidInput& error) {
      ASSERT_EQ(error.faults().size(), 3U);
      EXPECT_EQ(error.faults()[0].path, "start.gap");
      EXPECT_EQ(error.faults()[1].path, "start.load_position");
      EXPECT_EQ(error.faults()[2].path, "until");
    }
  }
}

/// Without friction and with the load at rest u = t − t² (J_M = ½): it turns at ¼.
TEST(EdgeMotion, TouchesAreListed) {
  const auto touches = [](double backlash) {
    Drive drive = normal_form(0.0, 1.0, 0.0, backlash);
    drive.reference = 0.0;
    const Motion motion = simulate(
        drive, {.until = 0.75, .start = Start{.load_position = 1.0, .gap = 0.0, .gap_speed = 1.0}});
    return std::vector<MotionTouch>(motion.touches().begin(), motion.touches().end());
  };
  const std::vector<MotionTouch> grazing = touches(0.5);
  ASSERT_EQ(grazing.size(), 1U);
  EXPECT_NEAR(grazing[0].time, 0.5, 1e-7);
  EXPECT_EQ(grazing[0].what, "impact forward");
  EXPECT_TRUE(touches(0.5 + 1e-12).empty());
}

/// x = (t − 1)² + a height, of a system that stands for a drive's.
TEST(EdgeMotion, TouchesOfTheGeneralEngineNameTheEvent) {
  const auto touches = [](double height) {
    const hybrid::Vector start{{1.0, -2.0, 0.0, 0.0}};
    hybrid::Matrix flow = hybrid::Matrix::Zero(4, 4);
    flow(0, 1) = 1.0;
    const hybrid::Transition floor{.name = "faces meet forward",
                                   .guard = {hybrid::Vector{{1.0, 0.0, 0.0, 0.0}}, height}};
    drive::DriveSystem system;
    system.system = {
        .state_names = {"motor position", "motor speed", "load position", "load speed"},
        .modes = {{.name = "apart",
                   .flow = {flow, hybrid::Vector{{0.0, 2.0, 0.0, 0.0}}},
                   .transitions = {floor}}}};
    hybrid::Trajectory trajectory = hybrid::simulate(system.system, {0, start}, {.until = 3.0});
    const Motion motion = motion_of(system, std::move(trajectory));
    return motion.touches().empty() ? std::string() : std::string(motion.touches()[0].what);
  };
  EXPECT_EQ(touches(0.0), "faces meet forward");
  EXPECT_EQ(touches(1e-9), "");
}

}  // namespace
}  // namespace gearlash::motion_test
