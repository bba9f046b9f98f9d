// Hybrid motions with closed forms, and the rules for events.
#include <gtest/gtest.h>

#include <cmath>

#include "base/correct_digits.hpp"
#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid::simulate_test {
namespace {

// ---- a ball that bounces ------------------------------------------------------------------------

constexpr double gravity = 9.80665;

/// Height and speed; then at rest.
HybridSystem bouncing_ball(double restitution, bool settles) {
  Transition bounce{.name = "bounce",
                    .guard = {Vector{{1.0, 0.0}}, 0.0},
                    .reset = {Matrix{{1.0, 0.0}, {0.0, -restitution}}, {}, {}}};
  if (settles) bounce.settling = Settling{1, {Matrix::Zero(2, 2), {}, {}}};
  return {.state_names = {"height", "speed"},
          .modes = {{.name = "flies",
                     .flow = {Matrix{{0.0, 1.0}, {0.0, 0.0}}, Vector{{0.0, -gravity}}},
                     .transitions = {bounce}},
                    {.name = "rests", .flow = {Matrix::Zero(2, 2), Vector::Zero(2)}}},
          .clocks = {}};
}

TEST(OracleSimulate, ABallBouncesAndComesToRestAtZenosTime) {
  const Trajectory motion =
      simulate(bouncing_ball(0.8, true), {0, Vector{{1.0, 0.0}}}, {.until = 10.0});
  EXPECT_EQ(motion.stop_reason(), StopReason::reached_end);
  const double first = std::sqrt(2.0 / gravity);
  expect_digits("first_impact", motion.events().at(0).time, 0.451600756, 9.2);  // published
  expect_digits("exact_first_impact", motion.events()[0].time, first, 15.0);
  for (std::size_t n = 1; n < 20; ++n) {
    double time = first;
    for (std::size_t k = 1; k <= n; ++k) time += 2.0 * first * std::pow(0.8, k);
    EXPECT_NEAR(motion.events()[n].time, time, 1e-14);
  }
  const Event& last = motion.events().back();
  EXPECT_EQ(last.kind, EventKind::settling);
  EXPECT_EQ(last.mode_after, 1U);
  expect_digits("zeno_time", last.time, 4.0644068, 9.3);  // published
  expect_digits("exact_zeno_time", last.time, first * (1.0 + 0.8) / (1.0 - 0.8), 10.0);
}

TEST(EdgeSimulate, WithoutALimitModeZenosTimeIsTheEnd) {
  const Trajectory motion =
      simulate(bouncing_ball(0.8, false), {0, Vector{{1.0, 0.0}}}, {.until = 10.0});
  EXPECT_EQ(motion.stop_reason(), StopReason::zeno);
  EXPECT_NEAR(motion.end_time(), 4.0644068, 5e-8);
  EXPECT_EQ(motion.culprit(), "flies: bounce");
}

TEST(EdgeSimulate, AnElasticBallBouncesOn) {
  const Trajectory motion =
      simulate(bouncing_ball(1.0, true), {0, Vector{{1.0, 0.0}}}, {.until = 100.0});
  const double first = std::sqrt(2.0 / gravity);
  const auto bounces = static_cast<std::size_t>(0.5 * (100.0 / first + 1.0));
  ASSERT_EQ(motion.events().size(), bounces);
  EXPECT_NEAR(motion.events().back().time, first * (2.0 * static_cast<double>(bounces) - 1.0),
              1e-11);
}

TEST(EdgeSimulate, AGuardThatIsZeroOnAnIntervalDoesNotFire) {
  // At rest on the floor without gravity: height is 0 for ever.
  HybridSystem system = bouncing_ball(0.5, true);
  system.modes[0].flow.offset.setZero();
  const Trajectory motion = simulate(system, {0, Vector{{0.0, 0.0}}}, {.until = 1.0});
  EXPECT_TRUE(motion.events().empty());
  EXPECT_EQ(motion.stop_reason(), StopReason::reached_end);
}

TEST(EdgeSimulate, AStartOnTheGuardFiresByItsMotion) {
  const HybridSystem system = bouncing_ball(0.5, true);
  const Trajectory up = simulate(system, {0, Vector{{0.0, 1.0}}}, {.until = 0.1});
  EXPECT_TRUE(up.events().empty());
  const Trajectory down = simulate(system, {0, Vector{{0.0, -1.0}}}, {.until = 0.05});
  ASSERT_EQ(down.events().size(), 1U);
  EXPECT_EQ(down.events()[0].time, 0.0);
  EXPECT_EQ(down.events()[0].after[1], 0.5);
}

TEST(EdgeSimulate, ATouchIsListedAndIsNoEvent) {
  // x = (t − 1)²
  const HybridSystem system{
      .state_names = {"x", "speed"},
      .modes = {{.name = "falls and rises",
                 .flow = {Matrix{{0.0, 1.0}, {0.0, 0.0}}, Vector{{0.0, 2.0}}},
                 .transitions = {{.name = "floor", .guard = {Vector{{1.0, 0.0}}, 0.0}}}}},
      .clocks = {}};
  const Trajectory motion = simulate(system, {0, Vector{{1.0, -2.0}}}, {.until = 3.0});
  EXPECT_TRUE(motion.events().empty());
  ASSERT_EQ(motion.touches().size(), 1U);
  EXPECT_NEAR(motion.touches()[0].time, 1.0, 1e-7);
}

TEST(EdgeSimulate, TwoModesThatSendEachOtherBackChatter) {
  const auto mode = [](const char* name, double speed, Direction direction, std::size_t other) {
    return AffineMode{.name = name,
                      .flow = {Matrix::Zero(1, 1), Vector{{speed}}},
                      .transitions = {{.name = "switch",
                                       .guard = {Vector{{1.0}}, 0.0},
                                       .direction = direction,
                                       .target = other}}};
  };
  const HybridSystem system{
      .state_names = {"x"},
      .modes = {mode("down", -1.0, Direction::falling, 1), mode("up", 1.0, Direction::rising, 0)},
      .clocks = {}};
  const Trajectory motion = simulate(system, {0, Vector{{1.0}}}, {.until = 5.0});
  EXPECT_EQ(motion.stop_reason(), StopReason::chattering);
  EXPECT_EQ(motion.end_time(), 1.0);
}

TEST(Simulate, ClocksTickInOrder) {
  const auto adds = [](double amount) { return AffineReset{{}, Vector{{amount}}, {}}; };
  const HybridSystem system{
      .state_names = {"x"},
      .modes = {{.name = "waits",
                 .flow = {Matrix::Zero(1, 1), Vector::Zero(1)},
                 .timed = {{.name = "sample", .clock = 0, .reset = adds(1.0)},
                           {.name = "table", .clock = 1, .reset = adds(100.0)}}}},
      .clocks = {{.name = "sampler", .period = 0.1}, {.name = "table", .times = {0.25, 0.5}}}};
  const Trajectory motion = simulate(system, {0, Vector{{0.0}}}, {.until = 0.55});
  ASSERT_EQ(motion.events().size(), 8U);
  EXPECT_EQ(motion.end().numbers[0], 206.0);
  EXPECT_EQ(motion.at(0.26).numbers[0], 103.0);
  EXPECT_EQ(motion.events()[4].time, 0.30000000000000004);
  EXPECT_EQ(motion.events()[6].kind, EventKind::timed);
}

/// x = 1 − (t/t₀)¹³ by thirteen integrators: no term but the last tells that x falls.
TEST(EdgeSimulate, WhatOnlyTheLastTermTurnsIsNotSteppedOver) {
  constexpr Eigen::Index integrators = 13;
  for (const double turn : {1e-3, 1.0, 1e3, 1e9}) {
    SCOPED_TRACE(turn);
    Matrix chain = Matrix::Zero(integrators, integrators);
    std::vector<std::string> names;
    for (Eigen::Index i = 0; i < integrators; ++i) {
      if (i + 1 < integrators) chain(i, i + 1) = 1.0;
      names.push_back("x" + std::to_string(i));
    }
    Vector input = Vector::Zero(integrators);
    input[integrators - 1] = -std::tgamma(integrators + 1.0) * std::pow(turn, -13.0);
    const HybridSystem system{
        .state_names = names,
        .modes = {{.name = "runs",
                   .flow = {chain, input},
                   .transitions = {{.name = "x falls",
                                    .guard = {Vector::Unit(integrators, 0), 0.0},
                                    .target = 1}}},
                  {.name = "rests",
                   .flow = {Matrix::Zero(integrators, integrators), Vector::Zero(integrators)}}}};
    const Trajectory motion =
        simulate(system, {0, Vector::Unit(integrators, 0)}, {.until = 100.0 * turn});
    ASSERT_EQ(motion.events().size(), 1U);
    EXPECT_NEAR(motion.events()[0].time, turn, 1e-14 * turn);
  }
}

// ---- switched flows -----------------------------------------------------------------------------

/// y = e^{−t}, and beside it a fast number that tends to y, or to 0 if nothing draws it along.
TEST(OracleSimulate, AFastDecayIsLeftBehind) {
  for (const double coupling : {1000.0, 0.0}) {
    const HybridSystem system{
        .state_names = {"slow", "fast"},
        .modes = {{.name = "decays",
                   .flow = {Matrix{{-1.0, 0.0}, {coupling, -1000.0}}, Vector::Zero(2)}}},
        .clocks = {}};
    const Vector start{{1.0, coupling == 0.0 ? 1.0 : 0.0}};
    const Trajectory motion = simulate(system, {0, start}, {.until = 2.0});
    const double slow = std::exp(-2.0);
    EXPECT_NEAR(motion.end().numbers[0], slow, 1e-15);
    EXPECT_NEAR(motion.end().numbers[1], slow * coupling / 999.0, 1e-15);
    EXPECT_LT(motion.steps(), 100U);  // 1,000 at the fast one's own pace
  }
}

// ---- numbers that hardly act on each other ------------------------------------------------------

/// A ball falls onto a plate that trembles, z = (1 − cos ω t)/ω:
///   z′ = ω (w + t), w′ = −ω z, t′ = 1 + 1e-46 z.
/// z acts on t by so little that the weights of the flow, which balance what the two do to each
/// other, are 1e24 apart.
TEST(OracleSimulate, ABallMeetsAPlateWhateverHardlyActsOnIt) {
  constexpr double rate = 1000.0;
  constexpr double coupling = 1e-46;
  Matrix flow = Matrix::Zero(5, 5);
  flow(0, 1) = 1.0;
  flow(2, 3) = flow(2, 4) = rate;
  flow(3, 2) = -rate;
  flow(4, 2) = coupling;
  const HybridSystem system{
      .state_names = {"height", "speed", "plate", "turned plate", "time"},
      .modes = {{.name = "flies",
                 .flow = {flow, Vector{{0.0, -gravity, 0.0, 0.0, 1.0}}},
                 .transitions = {{.name = "meets the plate",
                                  .guard = {Vector{{1.0, 0.0, -1.0, 0.0, 0.0}}, 0.0},
                                  .target = 1}}},
                {.name = "rests", .flow = {Matrix::Zero(5, 5), Vector::Zero(5)}}}};
  const Trajectory motion =
      simulate(system, {0, Vector{{1.0, 0.0, 0.0, 0.0, 0.0}}}, {.until = 1.0});
  EXPECT_TRUE(motion.touches().empty());
  ASSERT_EQ(motion.events().size(), 1U);
  const double time = motion.events()[0].time;
  const double height = 1.0 - 0.5 * gravity * time * time;
  EXPECT_NEAR(height, (1.0 - std::cos(rate * time)) / rate, 1e-13);
}

// ---- units --------------------------------------------------------------------------------------

/// The ball with time in units of so many seconds.
HybridSystem in_units_of_time(HybridSystem system, double unit) {
  for (AffineMode& mode : system.modes) {
    mode.flow.matrix *= unit;
    mode.flow.offset *= unit;
  }
  return system;
}

TEST(PropertySimulate, UnitsOfTimeDoNotMatter) {
  for (const double restitution : {0.5, 0.8}) {
    const HybridSystem ball = bouncing_ball(restitution, true);
    const Trajectory seconds = simulate(ball, {0, Vector{{1.0, 0.0}}}, {.until = 10.0});
    for (const double unit : {0x1p-20, 0x1p-10, 0x1p10}) {
      const Trajectory other =
          simulate(in_units_of_time(ball, unit), {0, Vector{{1.0, 0.0}}}, {.until = 10.0 / unit});
      EXPECT_EQ(other.steps(), seconds.steps());
      ASSERT_EQ(other.events().size(), seconds.events().size());
      for (std::size_t i = 0; i < other.events().size(); ++i) {
        EXPECT_NEAR(other.events()[i].time * unit, seconds.events()[i].time, 1e-14);
      }
    }
  }
}

TEST(PropertySimulate, WhatOnlyFollowsDoesNotShortenSteps) {
  // A position that a decaying speed carries along, its unit so many metres.
  std::size_t steps = 0;
  for (const double unit : {1.0, 1e-6, 1e6}) {
    const HybridSystem system{
        .state_names = {"position", "speed"},
        .modes = {{.name = "coasts",
                   .flow = {Matrix{{0.0, 1.0 / unit}, {0.0, -0.01}}, Vector::Zero(2)}}},
        .clocks = {}};
    const Trajectory motion = simulate(system, {0, Vector{{0.0, 1.0}}}, {.until = 1000.0});
    const double distance = -std::expm1(-10.0) / 0.01 / unit;
    EXPECT_NEAR(motion.end().numbers[0], distance, 1e-14 * distance);
    if (steps == 0) steps = motion.steps();
    EXPECT_EQ(motion.steps(), steps);
  }
  EXPECT_LE(steps, 10U);
}

// ---- events in turn that come ever faster -------------------------------------------------------

/// A ball, without weight, between two faces that come together, the lower at rest; or with one
/// mode for each way.
HybridSystem closing_faces(double restitution, bool two_modes) {
  const Matrix flow{{0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  const Vector rates{{0.0, 0.0, -1.0}};  // of the upper face
  const Matrix low{{1.0, 0.0, 0.0}, {0.0, -restitution, 0.0}, {0.0, 0.0, 1.0}};
  const Transition lower{.name = "lower face",
                         .guard = {Vector{{1.0, 0.0, 0.0}}, 0.0},
                         .reset = {low, {}, {}},
                         .target = 0};
  const Transition upper{.name = "upper face",
                         .guard = {Vector{{-1.0, 0.0, 1.0}}, 0.0},
                         .reset = {low, Vector{{0.0, -(1.0 + restitution), 0.0}}, {}},
                         .target = two_modes ? std::size_t{1} : std::size_t{0}};
  if (!two_modes) {
    return {.state_names = {"ball", "speed", "face"},
            .modes = {{.name = "flies", .flow = {flow, rates}, .transitions = {lower, upper}}}};
  }
  return {.state_names = {"ball", "speed", "face"},
          .modes = {{.name = "up", .flow = {flow, rates}, .transitions = {upper}},
                    {.name = "down", .flow = {flow, rates}, .transitions = {lower}}}};
}

TEST(EdgeSimulate, TwoFacesThatCloseInAreZenos) {
  for (const bool two_modes : {false, true}) {
    const HybridSystem system = closing_faces(0.5, two_modes);
    const Trajectory motion = simulate(system, {0, Vector{{0.5, 3.0, 1.0}}}, {.until = 5.0});
    EXPECT_EQ(motion.stop_reason(), StopReason::zeno);
    EXPECT_NEAR(motion.end_time(), 1.0, 1e-9);  // when the faces meet
    EXPECT_NE(motion.culprit().find("face"), std::string::npos) << motion.culprit();
  }
}

TEST(EdgeSimulate, AClockWithoutPeriodAndTimesIsAFault) {
  HybridSystem system = bouncing_ball(0.5, true);
  system.clocks.push_back({.name = "once", .first = 1.0});
  const std::vector<Fault> all = faults(system);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].path, "clock \"once\".period");
  EXPECT_EQ(all[0].permitted, "must be positive where there are no times");
}

TEST(EdgeSimulate, TicksBeforeTheStartAreNotMet) {
  const HybridSystem system{
      .state_names = {"x"},
      .modes = {{.name = "waits",
                 .flow = {Matrix::Zero(1, 1), Vector::Zero(1)},
                 .timed = {{.name = "sample", .clock = 0}, {.name = "table", .clock = 1}}}},
      .clocks = {{.name = "sampler", .first = 0.5, .period = 1.0},
                 {.name = "table", .times = {1.0, 2.0, 3.0}}}};
  const Trajectory motion = simulate(system, {0, Vector{{0.0}}}, {.from = 2.0, .until = 3.0});
  ASSERT_EQ(motion.events().size(), 3U);
  EXPECT_EQ(motion.events()[0].time, 2.0);
  EXPECT_EQ(motion.events()[1].time, 2.5);
  EXPECT_EQ(motion.events()[2].time, 3.0);
}

TEST(Simulate, PreparedSystemsGiveTheSameMotion) {
  const HybridSystem system = bouncing_ball(0.8, true);
  const PreparedSystem prepared(system);
  const Trajectory once = simulate(system, {0, Vector{{1.0, 0.0}}}, {.until = 10.0});
  for (int i = 0; i < 2; ++i) {
    const Trajectory again = simulate(prepared, {0, Vector{{1.0, 0.0}}}, {.until = 10.0});
    ASSERT_EQ(again.events().size(), once.events().size());
    EXPECT_EQ(again.events().back().time, once.events().back().time);
    EXPECT_EQ(again.at(2.0).numbers, once.at(2.0).numbers);
  }
  HybridSystem faulty = system;
  faulty.modes[0].transitions[0].target = 7;
  EXPECT_THROW(PreparedSystem{faulty}, InvalidInput);
  EXPECT_THROW(simulate(prepared, {5, Vector{{1.0, 0.0}}}, {.until = 1.0}), InvalidInput);
}

TEST(EdgeSimulate, FaultsAreToldAllAtOnce) {
  HybridSystem system = bouncing_ball(0.5, true);
  system.modes[0].transitions[0].target = 7;
  system.modes[0].flow.offset = Vector{{1.0}};
  system.clocks.push_back({.name = "table", .times = {1.0, 0.5}});
  try {
    simulate(system, {0, Vector{{0.0}}}, {.until = -1.0});
    FAIL();
  } catch (const InvalidInput& fault) {
    EXPECT_EQ(fault.faults().size(), 5U);
    const std::string text = fault.what();
    for (const char* part : {"target = 7: must be one of 2 modes", "offset = 1 number", "times[1]",
                             "start.numbers", "options.until"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
  }
}

}  // namespace
}  // namespace gearlash::hybrid::simulate_test
