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
  EXPECT_NEAR((*limit)[0], 2.0, 1e-14);
  EXPECT_NEAR((*limit)[1], 0.0, 1e-14);
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
  EXPECT_TRUE(limit_in_mode(mode, Vector{{1.0, -0.4}}));
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
  const Matrix ramp{{0.0, 0.0}, {0.0, -1.0}};  // an integral of a constant error
  EXPECT_FALSE(limit_in_mode(mode_of(ramp, Vector{{1e-3, 0.0}}, guard, 1.0), Vector{{0.0, 1.0}}));
  const Matrix undamped{{0.0, 1.0}, {-1.0, 0.0}};
  EXPECT_FALSE(limit_in_mode(mode_of(undamped, Vector::Zero(2), guard, 9.0), Vector{{0.0, 1.0}}));
  AffineMode ticking = slide(0.0);
  ticking.timed.push_back({});
  EXPECT_FALSE(limit_in_mode(ticking, Vector{{5.0, 0.0}}));
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
  EXPECT_NEAR((*limit)[0], 0.3, 1e-14);
  EXPECT_NEAR((*limit)[2], 0.0, 1e-14);
  const Matrix coasting{{0.0, 1.0}, {0.0, -0.5}};
  const auto stop = limit_in_mode(mode_of(coasting, Vector::Zero(2), Vector{{-1.0, 0.0}}, 10.0),
                                  Vector{{1.0, 2.0}});
  ASSERT_TRUE(stop);
  EXPECT_NEAR((*stop)[0], 5.0, 1e-14);
}

}  // namespace
}  // namespace gearlash::hybrid::limit_in_mode_test
