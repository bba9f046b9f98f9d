// Which decays are fast, and what is left without them.
#include "hybrid/fast_decays.hpp"

#include <gtest/gtest.h>

#include "base/traced_draws.hpp"
#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid::fast_decays_test {
namespace {

/// Both shafts of a drive as one, in its load's and its motor's own numbers: the gap and its speed
/// are eigenvectors of 0, to which rounding gives some 1e-17. It is no decay, however small the
/// other is.
TEST(FastDecays, LeaveOutWhatRoundingAloneKeepsFromZero) {
  const double friction = 0.91477945294240459;
  const double of_load = 0.3790779330608402;
  const double torque = 0.045978005724789134;
  AffineFlow flow{Matrix::Zero(4, 4), Vector::Zero(4)};
  flow.matrix << 0.0, 1.0, 0.0, 0.0,   //
      -1.0, -friction, 0.0, -of_load,  //
      0.0, 0.0, 0.0, 1.0,              //
      -1.0, -friction, 0.0, -of_load;
  flow.offset << 0.0, torque, 0.0, torque;
  const auto decays = fast_decays(flow);
  Vector rest(4);
  rest << torque, 0.0, torque + 0.05, 0.0;
  for (const FastDecays& fast : decays) {  // none is allowed: nothing is then put at rest
    EXPECT_LT(fast.projector.norm(), 10.0);
    Vector state = rest;
    fast.put_at_rest(state);
    EXPECT_LT((state - rest).norm(), 1e-14);
  }
}

TEST(FastDecays, AreThoseWithTheWidestGap) {
  AffineFlow flow{Matrix::Zero(3, 3), Vector::Zero(3)};
  flow.matrix.diagonal() << -1e4, -1.0, -0.9;
  flow.offset << 2e4, 1.0, 0.9;
  const auto decays = fast_decays(flow);
  ASSERT_EQ(decays.size(), 1U);
  Vector state(3);
  state << 7.0, 5.0, 4.0;
  decays[0].put_at_rest(state);
  EXPECT_NEAR(state[0], 2.0, 1e-12);
  EXPECT_NEAR(state[1], 5.0, 1e-12);
  EXPECT_NEAR(state[2], 4.0, 1e-12);
}

/// A filter, a motor against friction, and a controller's integral that takes hours: each is over
/// by itself, the faster ones first.
TEST(FastDecays, AreOverOneAfterTheOther) {
  AffineFlow flow{Matrix::Zero(4, 4), Vector::Zero(4)};
  flow.matrix << -1e4, 0.0, 0.0, 0.0,  //
      1.0, -10.0, 1.0, 0.0,            //
      0.0, 0.0, -1e-4, 0.0,            //
      0.0, 1.0, 0.0, 0.0;              // a position, which no decay brings to rest
  const auto decays = fast_decays(flow);
  ASSERT_GE(decays.size(), 2U);
  Vector state{{1.0, 2.0, 3.0, 4.0}};
  decays[0].put_at_rest(state);
  EXPECT_NEAR(state[0], 0.0, 1e-15);
  EXPECT_NEAR(state[2], 3.0, 1e-12);
  decays[1].put_at_rest(state);
  EXPECT_NEAR(state[1], 3.0 / (10.0 - 1e-4), 1e-13);
  EXPECT_NEAR(state[2], 3.0, 1e-12);
}

/// A motor behind a filtered PID controller that reads the load, which coasts: nothing acts on the
/// load, and the motor on itself alone. Rounding in the projector may not let them act either: a
/// flow in which all numbers act on all others has one scale for all, and hid an impact behind it.
TEST(PropertyFastDecays, LetNothingActThatDoesNot) {
  TracedDraws draws(90);
  enum : Eigen::Index { motor_position, motor_speed, load_position, load_speed, integral, filter };
  std::size_t left_out = 0;
  for (int i = 0; i < 100; ++i) {
    const double rate = draws.log_uniform(100.0, 1e4);
    const double derivative = draws.log_uniform(0.01, 1.0);
    AffineFlow flow{Matrix::Zero(6, 6), Vector::Zero(6)};
    Matrix& matrix = flow.matrix;
    matrix(motor_position, motor_speed) = 1.0;
    matrix(motor_speed, motor_speed) = -draws.log_uniform(0.1, 1.0);
    matrix(motor_speed, load_position) = -1.0 - derivative * rate;
    matrix(motor_speed, integral) = -1.0;
    matrix(motor_speed, filter) = derivative * rate;
    matrix(load_position, load_speed) = 1.0;
    matrix(load_speed, load_speed) = -draws.log_uniform(0.1, 1.0);
    matrix(integral, load_position) = draws.log_uniform(0.01, 1.0);
    matrix(filter, load_position) = rate;
    matrix(filter, filter) = -rate;
    for (const FastDecays& fast : fast_decays(flow)) {
      ++left_out;
      for (const Matrix& acts : {fast.projector, fast.slow.matrix}) {
        EXPECT_EQ(acts(load_position, motor_speed), 0.0);
        EXPECT_EQ(acts(load_speed, motor_speed), 0.0);
        EXPECT_EQ(acts(load_speed, filter), 0.0);
        EXPECT_EQ(acts(load_speed, integral), 0.0);
        EXPECT_EQ(acts(integral, motor_position), 0.0);
      }
    }
  }
  EXPECT_GE(left_out, 100U);
}

/// Shafts whose faces stay together move alike, to the last bit: nothing may part them.
TEST(FastDecays, KeepNumbersTogetherThatMoveAlike) {
  AffineFlow flow{Matrix::Zero(6, 6), Vector::Zero(6)};
  const double of_motor = -0.0640752;
  const double of_load = -0.852681;
  flow.matrix << 0.0, 8.0, 0.0, 0.0, 0.0, 0.0,             // motor's position
      0.0, of_motor, -815.737, of_load, 48.8774, 48.8774,  // and speed
      0.0, 0.0, 0.0, 8.0, 0.0, 0.0,                        // load's position
      0.0, of_motor, -815.737, of_load, 48.8774, 48.8774,  // and speed
      0.0, 0.0, -0.405556, 0.0, 0.0, 0.0,                  // integral
      0.0, 0.0, 3211.35, 0.0, 0.0, -198.513;               // filter
  const auto decays = fast_decays(flow);
  ASSERT_FALSE(decays.empty());
  for (const FastDecays& fast : decays) {
    Vector state{{-0.966849, -8.26283e-4, 0.00711955, -8.26283e-4, -1.20148, 0.115714}};
    const double apart = state[0] - state[2];
    fast.put_at_rest(state);
    EXPECT_EQ(state[1], state[3]);
    EXPECT_NEAR(state[0] - state[2], apart, 1e-15);
  }
}

/// A shaft that sticks at 0.0175 rad beside the filter of a controller, whose number is some
/// thousand times as large.
TEST(FastDecays, DoNotMoveWhatHasNoPartInThem) {
  AffineFlow flow{Matrix::Zero(4, 4), Vector::Zero(4)};
  flow.matrix << 0.0, 1.0, 0.0, 0.0,  // position
      0.0, 0.0, 0.0, 0.0,             // speed
      -3.2e4, -17.0, -200.0, 0.3,     // filter
      -10.0, 0.0, 0.0, 0.0;           // integral
  const auto decays = fast_decays(flow);
  ASSERT_EQ(decays.size(), 1U);
  Vector state(4);
  state << 0.0175, 0.0, -2.8, 3.1;
  for (int i = 0; i < 1000; ++i) {
    state[3] += 0.01;
    decays[0].put_at_rest(state);
  }
  EXPECT_EQ(state[0], 0.0175);
  EXPECT_EQ(state[1], 0.0);
  EXPECT_NEAR(state[2], (-3.2e4 * state[0] + 0.3 * state[3]) / 200.0, 1e-3);
}

/// A motor that turns slowly at a speed that a controller's integral holds, against friction: the
/// integral ends a few of its roundings off its rest, where its change per step is less than one.
TEST(FastDecays, AreOverWhereRoundingHoldsAnIntegral) {
  constexpr double speed = 4.5e-5;
  constexpr double friction = 0.51;
  HybridSystem system{.state_names = {"position", "speed", "integral"},
                      .modes = {{.name = "turns"}}};
  AffineFlow& flow = system.modes[0].flow;
  flow = {Matrix::Zero(3, 3), Vector::Zero(3)};
  flow.matrix << 0.0, 1.0, 0.0,  //
      0.0, -200.0, 200.0,        //
      0.0, -20.0, 0.0;
  flow.offset << 0.0, -200.0 * friction, 20.0 * speed;
  constexpr double until = 10'000.0;
  const Trajectory motion =
      simulate(system, {0, Vector{{-0.7, 0.0, friction}}}, {.until = until, .step_limit = 20'000});
  EXPECT_EQ(motion.stop_reason(), StopReason::reached_end);
  EXPECT_NEAR(motion.end().numbers[1], speed, 1e-15);
  // What the integral gains is what the position lacks.
  const double way = -speed / 20.0;
  EXPECT_NEAR(motion.end().numbers[0], -0.7 + speed * until + way, 1e-11);
}

}  // namespace
}  // namespace gearlash::hybrid::fast_decays_test
