// Which decays are fast, and what is left without them.
#include "hybrid/fast_decays.hpp"

#include <gtest/gtest.h>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {
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
  if (!decays) return;  // allowed: nothing is then put at rest
  EXPECT_LT(decays->projector.norm(), 10.0);
  Vector state = rest;
  decays->put_at_rest(state);
  EXPECT_LT((state - rest).norm(), 1e-14);
}

TEST(FastDecays, AreThoseWithTheWidestGap) {
  AffineFlow flow{Matrix::Zero(3, 3), Vector::Zero(3)};
  flow.matrix.diagonal() << -1e4, -1.0, -0.9;
  flow.offset << 2e4, 1.0, 0.9;
  const auto decays = fast_decays(flow);
  ASSERT_TRUE(decays);
  Vector state(3);
  state << 7.0, 5.0, 4.0;
  decays->put_at_rest(state);
  EXPECT_NEAR(state[0], 2.0, 1e-12);
  EXPECT_NEAR(state[1], 5.0, 1e-12);
  EXPECT_NEAR(state[2], 4.0, 1e-12);
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
  ASSERT_TRUE(decays);
  Vector state(4);
  state << 0.0175, 0.0, -2.8, 3.1;
  for (int i = 0; i < 1000; ++i) {
    state[3] += 0.01;
    decays->put_at_rest(state);
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
}  // namespace gearlash::hybrid
