// Branches of orbits: folds and grazings that are known.
#include "hybrid/continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "base/correct_digits.hpp"
#include "base/stopping.hpp"
#include "closed_form/limit_cycle.hpp"
#include "servo_system.hpp"

namespace gearlash::hybrid::continuation_test {
namespace {

/// x″ + 0.1x′ + x = A cos t with a stop at x = 1; turning points are events, too.
HybridSystem driven_towards_stop(double amplitude) {
  Matrix flow = Matrix::Zero(4, 4);
  flow(0, 1) = 1.0;
  flow.row(1) << -1.0, -0.1, amplitude, 0.0;
  flow(2, 3) = 1.0;
  flow(3, 2) = -1.0;
  Matrix bounce = Matrix::Identity(4, 4);
  bounce(1, 1) = -0.8;
  AffineMode free{.name = "free", .flow = {flow, Vector::Zero(4)}};
  free.transitions = {
      {.name = "stop",
       .guard = {Vector::Unit(4, 0), -1.0},
       .direction = Direction::rising,
       .reset = {bounce, {}, {}}},
      {.name = "turn", .guard = {Vector::Unit(4, 1), 0.0}, .direction = Direction::either}};
  return {.state_names = {"x", "speed", "force", "force's rate"}, .modes = {free}, .clocks = {}};
}

std::optional<PeriodicOrbit> driven_orbit(double amplitude) {
  const HybridSystem system = driven_towards_stop(amplitude);
  return closing_orbit(system, simulate(system, {0, (Vector(4) << 0.0, 0.5, 1.0, 0.0).finished()},
                                        {.until = 400.0}));
}

TEST(Continuation, ABranchEndsAtTheSideOfItsRangeThatItLeaves) {
  const auto orbit = driven_orbit(0.05);
  ASSERT_TRUE(orbit);
  const Branch branch =
      continue_orbit(driven_towards_stop, 0.05, *orbit, {.low = 0.01, .high = 0.07});
  EXPECT_EQ(branch.end, BranchEnd::left_range);
  EXPECT_EQ(branch.points.back().parameter, 0.07);
}

TEST(Continuation, IsStoppedWithTheOrbitsThatItHasAndNamesNoEnd) {
  const auto orbit = driven_orbit(0.05);
  ASSERT_TRUE(orbit);
  const auto stopped_after = [&](std::size_t most) {
    test::Stopping progress(most);
    const Branch branch =
        continue_orbit(driven_towards_stop, 0.05, *orbit, {.high = 1.0, .progress = &progress});
    EXPECT_EQ(branch.end, BranchEnd::stopped) << most;
    EXPECT_TRUE(branch.culprit.empty()) << most;
    EXPECT_EQ(progress.asked, most);
    return branch.points.size();
  };
  EXPECT_EQ(stopped_after(1), 0);
  EXPECT_GE(stopped_after(20), 2);
}

TEST(OracleContinuation, TheDrivenOscillatorGrazesItsStopAtATenth) {
  const auto orbit = driven_orbit(0.05);
  ASSERT_TRUE(orbit);
  EXPECT_NEAR(orbit->period, 2.0 * std::numbers::pi, 1e-12);
  const Branch branch = continue_orbit(driven_towards_stop, 0.05, *orbit, {.high = 1.0});
  EXPECT_EQ(branch.end, BranchEnd::grazing);
  EXPECT_EQ(branch.culprit, "free: stop");
  expect_digits("grazing_amplitude", branch.points.back().parameter, 0.1, 6.5);
  EXPECT_TRUE(branch.bifurcations.empty());
}

/// θ″ + θ′ = −K × (the output of a play of half width 1 that θ drives): friction-controlled
/// backlash behind an integrating motor.
HybridSystem loop_with_play(double gain) {
  enum : std::size_t { crossing, rising, falling };
  Matrix flow = Matrix::Zero(3, 3);
  flow(0, 1) = 1.0;
  flow.row(1) << 0.0, -1.0, -gain;
  Matrix carried = flow;
  carried(2, 1) = 1.0;
  const Vector offset = (Vector(3) << 1.0, 0.0, -1.0).finished();
  const Vector speed = Vector::Unit(3, 1);
  const auto held = [&](double side) {
    Matrix after = Matrix::Identity(3, 3);
    after.row(2) << 1.0, 0.0, 0.0;
    return AffineReset{after, (Vector(3) << 0.0, 0.0, -side).finished(), {}};
  };
  AffineMode apart{.name = "crossing", .flow = {flow, Vector::Zero(3)}};
  apart.transitions = {{.name = "takes up forward",
                        .guard = {offset, -1.0},
                        .direction = Direction::rising,
                        .reset = held(1.0),
                        .target = rising},
                       {.name = "takes up backward",
                        .guard = {offset, 1.0},
                        .direction = Direction::falling,
                        .reset = held(-1.0),
                        .target = falling}};
  AffineMode up{.name = "carried forward", .flow = {carried, Vector::Zero(3)}};
  up.transitions = {
      {.name = "turns back", .guard = {speed, 0.0}, .reset = held(1.0), .target = crossing}};
  AffineMode down{.name = "carried backward", .flow = {carried, Vector::Zero(3)}};
  down.transitions = {{.name = "turns forward",
                       .guard = {speed, 0.0},
                       .direction = Direction::rising,
                       .reset = held(-1.0),
                       .target = crossing}};
  return {.state_names = {"motor", "speed", "load"}, .modes = {apart, up, down}, .clocks = {}};
}

/// Growth at rest of that loop: the load at −1 and at rest, the motor creeps on at K; carried along
/// it turns at the growth (the load then rests there). Underdamped, K > 1/4.
double growth_at_rest(double gain) {
  const double decay = 0.5;
  const double frequency = std::sqrt(gain - decay * decay);
  // y(0) = −1, ẏ(0) = K: ẏ = e^{−t/2}(K cos wt + ((K/2)/w) sin wt), as ÿ(0) = −K + K = 0.
  const double time = (std::numbers::pi - std::atan2(frequency, decay)) / frequency;
  return std::exp(-decay * time) *
         std::abs(-std::cos(frequency * time) +
                  ((gain - decay) / frequency) * std::sin(frequency * time));
}

/// Harmonic balance has two cycles for K ≥ 3.416581, which meet in a fold. The loop itself has one,
/// which ends where growth at rest is 1, its period growing beyond all bounds.
TEST(OracleContinuation, TheCycleOfALoopWithPlayEndsWhereGrowthAtRestIsOne) {
  const HybridSystem system = loop_with_play(5.0);
  const Trajectory motion =
      simulate(system, {1, (Vector(3) << 3.0, 1.0, 2.0).finished()}, {.until = 200.0});
  const auto orbit = closing_orbit(system, motion);
  ASSERT_TRUE(orbit);
  EXPECT_TRUE(orbit->is_stable());
  EXPECT_EQ(orbit->events.size(), 4U);
  const Branch branch =
      continue_orbit(loop_with_play, 5.0, *orbit,
                     {.low = 1.0, .high = 5.0, .upwards = false, .longest_period = 8.0});
  EXPECT_EQ(branch.end, BranchEnd::endless_period);
  EXPECT_TRUE(branch.bifurcations.empty());
  const double end = branch.points.back().parameter;
  EXPECT_GT(growth_at_rest(end + 1e-6), 1.0);
  EXPECT_LT(growth_at_rest(end - 1e-6), 1.0);
}

/// One impact a period, just below grazing: with the transient q τ(t), τ(0) = τ(2π) = 1,
///   v⁻ = −q (τ′(0) − τ′(2π))/(1 + e),  and of the forced motion  x_p = 1 − q,  x_p′ = v⁻ − q
///   τ′(2π),
/// so that (1 − q)² + c² q² = (A/0.1)², which is least, c²/(1 + c²), where two orbits meet.
double amplitude_of_fold() {
  const double decay = 0.05;
  const double frequency = std::sqrt(1.0 - decay * decay);
  const double period = 2.0 * std::numbers::pi;
  const double fading = std::exp(-decay * period);
  const double cosine = std::cos(frequency * period);
  const double sine = std::sin(frequency * period);
  // τ = e^{−δt}(cos wt + s sin wt)
  const double s = (1.0 / fading - cosine) / sine;
  const double slope_at_start = -decay + s * frequency;
  const double slope_at_end = -decay + fading * frequency * (s * cosine - sine);
  const double c = -(slope_at_start - slope_at_end) / 1.8 - slope_at_end;
  return 0.1 * std::abs(c) / std::sqrt(1.0 + c * c);
}

TEST(OracleContinuation, TheImpactingOrbitTurnsBackJustBelowGrazing) {
  const HybridSystem system = driven_towards_stop(1.0);
  const Trajectory motion =
      simulate(system, {0, (Vector(4) << 0.0, 0.5, 1.0, 0.0).finished()}, {.until = 600.0});
  const auto orbit = closing_orbit(system, motion);
  ASSERT_TRUE(orbit);
  const Branch branch =
      continue_orbit(driven_towards_stop, 1.0, *orbit, {.low = 0.01, .upwards = false});
  ASSERT_EQ(branch.bifurcations.size(), 1U);
  EXPECT_EQ(branch.bifurcations[0].kind, BifurcationKind::fold);
  EXPECT_NEAR(branch.bifurcations[0].parameter, amplitude_of_fold(), 1e-12);
  EXPECT_NEAR(std::abs(branch.bifurcations[0].orbit.multipliers.at(0)), 1.0, 1e-6);
  for (const double below : {1e-5, 1e-6, 1e-7}) {  // where none is, but one is nearly
    const HybridSystem none = driven_towards_stop((1.0 - below) * amplitude_of_fold());
    EXPECT_FALSE(neighbouring_orbit(none, branch.bifurcations[0].orbit)) << below;
  }
  // Beyond it the orbit is unstable, and ends as its impact comes to graze, at A = 0.1 again.
  EXPECT_EQ(branch.end, BranchEnd::grazing);
  EXPECT_EQ(branch.culprit, "free: stop");
  EXPECT_FALSE(branch.points.back().orbit.is_stable());
  EXPECT_NEAR(branch.points.back().parameter, 0.1, 1e-4);
}

}  // namespace

/// A relay with hysteresis before a lag, of period 2 ln 4, drives two more numbers, which oscillate
/// at a rate and decay: their multipliers are e^{(−decay ± i rate) period}.
HybridSystem relay_beside(double decay, double rate) {
  HybridSystem system{.state_names = {"x", "y", "z"}, .modes = {}, .clocks = {}};
  for (const double sign : {1.0, -1.0}) {
    const Matrix flow{{-1.0, 0.0, 0.0}, {0.1, -decay, rate}, {0.0, -rate, -decay}};
    AffineMode mode{.name = sign > 0.0 ? "up" : "down", .flow = {flow, sign * Vector::Unit(3, 0)}};
    mode.transitions = {{.name = "turns",
                         .guard = {Vector::Unit(3, 0), -0.6 * sign},
                         .direction = sign > 0.0 ? Direction::rising : Direction::falling,
                         .target = sign > 0.0 ? 1U : 0U}};
    system.modes.push_back(std::move(mode));
  }
  return system;
}

TEST(OracleContinuation, NamesWhatLeavesTheUnitCircleAndWhere) {
  const double period = 2.0 * std::log(4.0);
  const struct {
    double rate;
    BifurcationKind kind;
  } cases[] = {{0.7, BifurcationKind::neimark_sacker},
               {std::numbers::pi / period, BifurcationKind::flip},
               {0.0, BifurcationKind::branching}};
  for (const auto& [rate, kind] : cases) {
    const Family family = [rate = rate](double decay) { return relay_beside(decay - 0.3, rate); };
    const HybridSystem system = family(0.5);
    const auto orbit =
        closing_orbit(system, simulate(system, {0, Vector::Zero(3)}, {.until = 60.0}));
    ASSERT_TRUE(orbit) << rate;
    EXPECT_TRUE(orbit->is_stable());
    const Branch branch =
        continue_orbit(family, 0.5, *orbit, {.low = 0.1, .high = 1.0, .upwards = false});
    EXPECT_EQ(branch.end, BranchEnd::left_range);
    ASSERT_FALSE(branch.bifurcations.empty()) << rate;
    EXPECT_EQ(branch.bifurcations[0].kind, kind) << rate;
    EXPECT_NEAR(branch.bifurcations[0].parameter, 0.3, 1e-9) << rate;
  }
}

/// x″ + 0.1x′ + x = cos 2.7t with a stop at x = 0 and this restitution.
HybridSystem driven_at_stop(double restitution) {
  HybridSystem system = driven_towards_stop(1.0);
  AffineMode& mode = system.modes[0];
  mode.flow.matrix(2, 3) = 2.7;
  mode.flow.matrix(3, 2) = -2.7;
  mode.transitions.pop_back();
  mode.transitions[0].guard.offset = 0.0;
  mode.transitions[0].reset.matrix(1, 1) = -restitution;
  return system;
}

std::optional<PeriodicOrbit> orbit_at_stop(double restitution) {
  const HybridSystem system = driven_at_stop(restitution);
  return closing_orbit(system,
                       simulate(system, {0, Vector{{-0.1, 0.0, 1.0, 0.0}}}, {.until = 900.0}));
}

TEST(OracleContinuation, AnOrbitOfTwiceThePeriodBeginsAtAFlip) {
  const auto orbit = orbit_at_stop(0.2);
  ASSERT_TRUE(orbit);
  const Branch branch = continue_orbit(driven_at_stop, 0.2, *orbit, {.low = 0.1, .high = 0.4});
  ASSERT_EQ(branch.bifurcations.size(), 1U);
  const Bifurcation& flip = branch.bifurcations[0];
  EXPECT_EQ(flip.kind, BifurcationKind::flip);
  EXPECT_NEAR(std::abs(flip.orbit.multipliers.at(0) + 1.0), 0.0, 1e-9);
  // Settled motion goes round once in a period of the force just below it, just above it twice.
  const double period = 2.0 * std::numbers::pi / 2.7;
  for (const auto& [aside, rounds] : {std::pair{-3e-3, 1.0}, {3e-3, 2.0}}) {
    const auto beside = orbit_at_stop(flip.parameter + aside);
    ASSERT_TRUE(beside) << aside;
    EXPECT_NEAR(beside->period, rounds * period, 1e-9) << aside;
  }
}

/// A relay with a dead zone of ±1 switches ±height into 1/(s (s + 1)²), fed back. Above some height
/// it has a stable and an unstable cycle, below none.
HybridSystem dead_zone_relay(double height) {
  HybridSystem system{.state_names = {"y", "speed", "acceleration"}, .modes = {}, .clocks = {}};
  const Matrix flow{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, -2.0}};
  const auto mode = [&](const char* name, double output) {
    system.modes.push_back({.name = name, .flow = {flow, output * Vector::Unit(3, 2)}});
  };
  mode("off", 0.0);
  mode("on", height);         // y < −1
  mode("reversed", -height);  // y > 1
  const auto at = [](double level, Direction direction, std::size_t target) {
    return Transition{.name = "switches",
                      .guard = {Vector::Unit(3, 0), -level},
                      .direction = direction,
                      .target = target};
  };
  system.modes[0].transitions = {at(-1.0, Direction::falling, 1), at(1.0, Direction::rising, 2)};
  system.modes[1].transitions = {at(-1.0, Direction::rising, 0)};
  system.modes[2].transitions = {at(1.0, Direction::falling, 0)};
  return system;
}

/// The height with which a symmetric cycle exists that is on for a share of its period, by its
/// Fourier series (Tsypkin): y(0) = y(share period) = −1, which gives the frequency first.
double height_of_cycle(double share) {
  using Complex = std::complex<double>;
  const auto response = [&](double frequency, double time_share) {
    constexpr int harmonics = 2001;
    const double period = 2.0 * std::numbers::pi / frequency;
    double sum = 0.0;
    for (int k = harmonics; k > 0; k -= 2) {
      const Complex s(0.0, k * frequency);
      const Complex size = 2.0 / period * (1.0 - std::exp(-s * share * period)) / s;
      sum += 2.0 * (size / (s * (s + 1.0) * (s + 1.0)) * std::exp(s * time_share * period)).real();
    }
    return sum;
  };
  const auto difference = [&](double frequency) {
    return response(frequency, 0.0) - response(frequency, share);
  };
  double low = 0.8;
  double high = 1.2;
  const bool rises = difference(low) < 0.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    ((difference(middle) < 0.0) == rises ? low : high) = middle;
  }
  return -1.0 / response(low, 0.0);
}

TEST(OracleContinuation, TheFoldOfARelayWithADeadZoneIsThatOfItsFourierSeries) {
  double low = 0.1;
  double high = 0.4;
  for (int i = 0; i < 40; ++i) {  // golden sections for the least height
    constexpr double golden = 0.3819660112501051;
    const double a = low + golden * (high - low);
    const double b = high - golden * (high - low);
    if (height_of_cycle(a) < height_of_cycle(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  const double fold = height_of_cycle(0.5 * (low + high));
  // The describing function, 4 h √(1 − 1/A²)/(πA), is at most 2h/π; the plant's gain at −180° is ½.
  EXPECT_NEAR(fold, std::numbers::pi, 0.1 * std::numbers::pi);
  const HybridSystem system = dead_zone_relay(1.3 * fold);
  const auto orbit =
      closing_orbit(system, simulate(system, {0, Vector{{0.0, 3.0, 0.0}}}, {.until = 300.0}));
  ASSERT_TRUE(orbit);
  const Branch branch = continue_orbit(dead_zone_relay, 1.3 * fold, *orbit,
                                       {.low = 0.5 * fold, .high = 2.0 * fold, .upwards = false});
  ASSERT_FALSE(branch.bifurcations.empty());
  EXPECT_EQ(branch.bifurcations[0].kind, BifurcationKind::fold);
  EXPECT_NEAR(branch.bifurcations[0].parameter, fold, 1e-9 * fold);
}

TEST(OracleContinuation, OfAServoAgreesWithTheClosedFormAllAlong) {
  const auto servo_of = [](double friction_ratio) {
    return NormalizedServo{
        .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = friction_ratio, .backlash = 0.3};
  };
  const Family family = [&](double friction_ratio) {
    return servo_system(servo_of(friction_ratio));
  };
  const LimitCycle start = analyse_limit_cycles(servo_of(0.1)).cycles.at(0);
  const Trajectory motion =
      simulate(family(0.1),
               {separated, (Vector(4) << start.start.motor_position, start.start.motor_speed,
                            start.start.load_position, start.start.load_speed)
                                   .finished() *
                               1.01},
               {.until = 60.0});
  const auto orbit = closing_orbit(family(0.1), motion);
  ASSERT_TRUE(orbit);
  const Branch branch = continue_orbit(family, 0.1, *orbit, {.low = 0.02, .high = 0.5});
  EXPECT_GT(branch.points.size(), 5U);
  for (const BranchPoint& point : branch.points) {
    const LimitCycleAnalysis exact = analyse_limit_cycles(servo_of(point.parameter));
    if (exact.cycles.empty() || exact.cycles[0].multiplier > 0.99) continue;
    EXPECT_NEAR(point.orbit.period, exact.cycles[0].period, 1e-10) << point.parameter;
    EXPECT_NEAR(std::abs(point.orbit.multipliers.at(0)), exact.cycles[0].multiplier, 1e-8);
  }
}

}  // namespace gearlash::hybrid::continuation_test
