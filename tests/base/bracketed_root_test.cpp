// The root finder under every crossing, on functions that mislead Newton's and Halley's steps.
#include "base/bracketed_root.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gearlash::bracketed_root_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(EdgeBracketedRoot, SmoothRootsFromAnyGuess) {
  const auto cosine = [](double x) {
    return ValueAndSlope{std::cos(x), -std::sin(x), -std::cos(x)};
  };
  for (const double guess : {-1.0, 0.0, 1e-9, 0.1, 1.57, 3.0, 3.14, 10.0}) {
    EXPECT_NEAR(bracketed_root(cosine, 0.0, 3.14, guess, -1.0), 0.5 * 3.14159265358979324,
                2.0 * epsilon)
        << guess;
  }
}

TEST(EdgeBracketedRoot, FlatAndVerticalFunctions) {
  const auto flat = [](double x) {
    return ValueAndSlope{std::pow(x - 0.25, 9), 9.0 * std::pow(x - 0.25, 8)};
  };
  // A ninefold root is known to the ninth root of what a double resolves.
  EXPECT_NEAR(bracketed_root(flat, 0.0, 1.0, 0.9, 1.0), 0.25, 1e-6);
  const auto vertical = [](double x) {
    return ValueAndSlope{std::cbrt(x - 0.3), 1.0 / (3.0 * std::pow(std::cbrt(x - 0.3), 2))};
  };
  EXPECT_NEAR(bracketed_root(vertical, 0.0, 1.0, 0.9, 1.0), 0.3, 2.0 * epsilon);
  const auto jump = [](double x) { return ValueAndSlope{x < 0.7 ? -1.0 : 1.0, 0.0}; };
  EXPECT_NEAR(bracketed_root(jump, 0.0, 1.0, 0.5, 1.0), 0.7, 2.0 * epsilon);
}

TEST(EdgeBracketedRoot, RootsAtTheEndsOfTheBracket) {
  const auto line = [](double x) { return ValueAndSlope{x - 1.0, 1.0}; };
  EXPECT_NEAR(bracketed_root(line, 0.0, 1.0, 0.5, 1.0), 1.0, 2.0 * epsilon);
  EXPECT_NEAR(bracketed_root(line, 1.0, 2.0, 1.5, 1.0), 1.0, 2.0 * epsilon);
}

TEST(EdgeBracketedRoot, TinyAndHugeRoots) {
  for (const double root : {1e-300, 1e-200, 1e-100, 1e-20, 1.0, 1e20, 1e80}) {
    const auto no_slope = [&](double x) {  // nothing but bisection helps
      return ValueAndSlope{x < root ? -1.0 : (x > root ? 1.0 : 0.0), 0.0};
    };
    const double found = bracketed_root(no_slope, 0.0, 1e90, 1.0, 1.0);
    EXPECT_NEAR(found, root, 4.0 * epsilon * root) << root;
  }
}

TEST(EdgeBracketedRoot, AnInfiniteUpperEnd) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double root : {1e-12, 1e-3, 1.0, 12345.0, 1e12, 1e30}) {
    const auto line = [&](double x) { return ValueAndSlope{x - root, 1.0}; };
    const auto convex = [&](double x) {
      return ValueAndSlope{x * x * x - root * root * root, 3.0 * x * x, 6.0 * x};
    };
    const auto concave = [&](double x) {
      return ValueAndSlope{std::sqrt(x) - std::sqrt(root), 0.5 / std::sqrt(x)};
    };
    const auto no_slope = [&](double x) { return ValueAndSlope{x < root ? -1.0 : 1.0, 0.0}; };
    for (const double guess : {0.0, 1e-6, 0.5, 1.0, 1e6}) {
      EXPECT_NEAR(bracketed_root(line, 0.0, infinity, guess, 1.0), root, 4.0 * epsilon * root);
      EXPECT_NEAR(bracketed_root(convex, 0.0, infinity, guess, 1.0), root, 4.0 * epsilon * root);
      EXPECT_NEAR(bracketed_root(concave, 0.0, infinity, guess, 1.0), root, 4.0 * epsilon * root);
      EXPECT_NEAR(bracketed_root(no_slope, 0.0, infinity, guess, 1.0), root, 4.0 * epsilon * root);
    }
  }
}

// A line far out, bent near its root: the step from far out to near it is far longer than the next
// one, which says nothing of how near it is.
TEST(EdgeBracketedRoot, AStepFromFarAwayIsNoConvergence) {
  const auto bent = [](double x) {
    const double bend = 0.01 * std::exp(-40.0 * x);
    return ValueAndSlope{x + bend - 0.1, 1.0 - 40.0 * bend, 1600.0 * bend};
  };
  const double root = bracketed_root(bent, 0.0, 1.0, 0.1, 1.0);
  for (const double far : {1e3, 4e9, 1e20, 1e60}) {
    EXPECT_NEAR(bracketed_root(bent, 0.0, 1e90, far, 1.0), root, 4.0 * epsilon) << far;
  }
  EXPECT_NEAR(bent(root).value, 0.0, epsilon);
}

}  // namespace
}  // namespace gearlash::bracketed_root_test
