// Where motions end that never leave their mode again.
#include "hybrid/limit_in_mode.hpp"

#include <gtest/gtest.h>

namespace gearlash::hybrid::limit_in_mode_test {
namespace {

AffineMode mode_of(const Matrix& matrix, const Vector& offset, const Vector& guard,
                   double guard_offset) {
  AffineMode mode;
  mode.flow = {matrix, offset};
  mode.transitions.push_back({.guard = {guard, guard_offset}});
  return mode;
}

/// x' = -(x - 2)/1000 with a fast number beside it that has decayed, and a guard at x = `wall`.
AffineMode slide(double wall) {
  return mode_of(Matrix{{-1e-3, 0.0}, {0.0, -50.0}}, Vector{{2e-3, 0.0}}, Vector{{1.0, 0.0}},
                 -wall);
}

TEST(LimitInMode, IsThatOfTheSlowestDecay) {
  const auto limit = limit_in_mode(slide(0.0), Vector{{5.0, 1e-12}});
  ASSERT_TRUE(limit);
  EXPECT_NEAR(limit->numbers[0], 2.0, 1e-14);
  EXPECT_NEAR(limit->numbers[1], 0.0, 1e-14);
  EXPECT_TRUE(limit->drift.isZero(0.0));
  EXPECT_FALSE(limit->is_on_border);
}

TEST(LimitInMode, IsNotWhereAGuardComesFirst) {
  EXPECT_FALSE(limit_in_mode(slide(3.0), Vector{{5.0, 0.0}}));
  EXPECT_TRUE(limit_in_mode(slide(1.9), Vector{{5.0, 0.0}}));
  EXPECT_TRUE(limit_in_mode(slide(3.0), Vector{{2.9, 0.0}}));  // it leaves the wall
  EXPECT_FALSE(limit_in_mode(slide(0.0), Vector{{-1.0, 0.0}}));
}

/// A guard on the speed tends to 0 itself: it keeps its sign as long as the slowest decay rules.
TEST(LimitInMode, MayComeToTheGuardItself) {
  // Overdamped: y'' = -2.5 y' - y, rates 1/2 and 2.
  const Matrix matrix{{0.0, 1.0}, {-1.0, -2.5}};
  const AffineMode mode = mode_of(matrix, Vector::Zero(2), Vector{{0.0, 1.0}}, 0.0);
  ASSERT_TRUE(limit_in_mode(mode, Vector{{1.0, -0.4}}));
  EXPECT_TRUE(limit_in_mode(mode, Vector{{1.0, -0.4}})->is_on_border);
  // From here it passes y = 0 and turns back.
  EXPECT_FALSE(limit_in_mode(mode, Vector{{1.0, -3.0}}));
  const Matrix swinging{{0.0, 1.0}, {-1.0, -0.5}};
  EXPECT_FALSE(limit_in_mode(mode_of(swinging, Vector::Zero(2), Vector{{0.0, 1.0}}, 0.0),
                             Vector{{1.0, -0.4}}));
}

/// Three decays of which the faster ones lower the guard below 0 for a while.
TEST(LimitInMode, WaitsUntilTheSlowestDecayRules) {
  const Matrix matrix = Vector{{-0.1, -1.0, -5.0}}.asDiagonal();
  const AffineMode mode = mode_of(matrix, Vector::Zero(3), Vector{{1.0, 1.0, 1.0}}, 0.0);
  EXPECT_FALSE(limit_in_mode(mode, Vector{{1.0, -3.0, 3.0}}));
  EXPECT_TRUE(limit_in_mode(mode, Vector{{1.0, -0.5, 0.4}}));
}

TEST(LimitInMode, NeedsDecay) {
  const Vector guard{{1.0, 0.0}};
  const Matrix growing{{0.1, 0.0}, {0.0, -1.0}};
  EXPECT_FALSE(limit_in_mode(mode_of(growing, Vector::Zero(2), guard, 1.0), Vector{{1e-12, 1.0}}));
  const Matrix undamped{{0.0, 1.0}, {-1.0, 0.0}};
  EXPECT_FALSE(limit_in_mode(mode_of(undamped, Vector::Zero(2), guard, 9.0), Vector{{0.0, 1.0}}));
  AffineMode ticking = slide(0.0);
  ticking.timed.push_back({});
  EXPECT_FALSE(limit_in_mode(ticking, Vector{{5.0, 0.0}}));
}

/// An integral of a constant error winds up for ever.
TEST(LimitInMode, MayDriftAwayFromEveryGuard) {
  const Matrix integral{{0.0, 0.0}, {0.0, -1.0}};
  const auto from_0 = [&](double rate, double speed_of_other) {
    const AffineMode mode = mode_of(integral, Vector{{rate, 0.0}}, Vector{{1.0, 0.0}}, 1.0);
    return limit_in_mode(mode, Vector{{0.0, speed_of_other}});
  };
  const auto away = from_0(1e-3, 1.0);
  ASSERT_TRUE(away);
  EXPECT_NEAR(away->drift[0], 1e-3, 1e-15);
  EXPECT_NEAR(away->drift[1], 0.0, 1e-15);
  EXPECT_NEAR(away->numbers[1], 0.0, 1e-12);
  EXPECT_FALSE(from_0(-1e-3, 1.0));  // towards the guard
  // What is driven by a drift grows with the square of time.
  const Matrix twice{{0.0, 0.0}, {1.0, 0.0}};
  EXPECT_FALSE(limit_in_mode(mode_of(twice, Vector{{1e-3, 0.0}}, Vector{{0.0, 1.0}}, 1.0),
                             Vector{{0.0, 1.0}}));
}

/// Two shafts that move as one: position, speed of one and of the other. Their difference, which is
/// no decay, does not count; a shaft that coasts stops somewhere.
TEST(LimitInMode, TakesNumbersThatMoveAlikeForOne) {
  const Matrix matrix{
      {0.0, 1.0, 0.0, 0.0}, {0.0, -0.5, -1.0, -2.0}, {0.0, 0.0, 0.0, 1.0}, {0.0, -0.5, -1.0, -2.0}};
  const Vector guard{{0.0, 0.0, 0.0, 1.0}};
  const AffineMode mode = mode_of(matrix, Vector::Zero(4), guard, 0.0);
  const auto limit = limit_in_mode(mode, Vector{{1.3, -0.4, 1.0, -0.4}});
  ASSERT_TRUE(limit);
  EXPECT_NEAR(limit->numbers[0], 0.3, 1e-14);
  EXPECT_NEAR(limit->numbers[2], 0.0, 1e-14);
  const Matrix coasting{{0.0, 1.0}, {0.0, -0.5}};
  const auto stop = limit_in_mode(mode_of(coasting, Vector::Zero(2), Vector{{-1.0, 0.0}}, 10.0),
                                  Vector{{1.0, 2.0}});
  ASSERT_TRUE(stop);
  EXPECT_NEAR(stop->numbers[0], 5.0, 1e-14);
}

}  // namespace
}  // namespace gearlash::hybrid::limit_in_mode_test
