// Exits of polynomials whose zeros are known.
#include "hybrid/first_exit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "base/traced_draws.hpp"

namespace gearlash::hybrid::first_exit_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::vector<double> times_linear(const std::vector<double>& p, double root) {
  std::vector<double> product(p.size() + 1, 0.0);
  for (std::size_t k = 0; k < p.size(); ++k) {
    product[k] += root * p[k];
    product[k + 1] -= p[k];
  }
  return product;  // p(τ) (root − τ)
}

double size_of(const std::vector<double>& p) {
  double sum = 0.0;
  for (const double c : p) sum += std::abs(c);
  return sum;
}

TEST(FirstExit, OfAPolynomialThatStaysPositiveIsNone) {
  EXPECT_FALSE(first_exit(std::vector{1.0, 2.0, 3.0}, 1e-16).at);
  EXPECT_FALSE(first_exit(std::vector{1.0, -0.5}, 1e-16).at);
  EXPECT_FALSE(first_exit(std::vector{1.0, -3.0, 3.0}, 1e-16).at);  // least 1/4
}

TEST(FirstExit, IsTheFirstOfThree) {
  const auto p = times_linear(times_linear(times_linear({1.0}, 0.25), 0.5), 0.75);
  const FirstExit exit = first_exit(p, 1e-16);
  ASSERT_TRUE(exit.at);
  EXPECT_NEAR(*exit.at, 0.25, 1e-15);
  EXPECT_FALSE(exit.touch);
}

TEST(EdgeFirstExit, ATouchIsNoExit) {
  const auto p = times_linear(times_linear({1.0}, 0.3), 0.3);
  const FirstExit exit = first_exit(p, 1e-15);
  EXPECT_FALSE(exit.at);
  ASSERT_TRUE(exit.touch);
  EXPECT_NEAR(*exit.touch, 0.3, 1e-7);
}

TEST(EdgeFirstExit, WhatComesDownToZeroAtTheEndIsLeftToWhatFollows) {
  for (const auto& p : {std::vector<double>{1.0, -1.0}, std::vector<double>{1.0, -2.0, 1.0},
                        std::vector<double>{1.0, 0.0, 0.0, -1.0}}) {
    const FirstExit exit = first_exit(p, 1e-15);
    EXPECT_FALSE(exit.at);
    EXPECT_EQ(exit.touch, 1.0);
  }
  EXPECT_FALSE(first_exit(std::vector<double>{1.0, -1.0 + 1e-14}, 1e-15).touch);
}

TEST(EdgeFirstExit, ATouchBeforeAnExitIsToldToo) {
  const auto p = times_linear(times_linear(times_linear({1.0}, 0.3), 0.3), 0.8);
  const FirstExit exit = first_exit(p, 1e-15);
  ASSERT_TRUE(exit.at);
  EXPECT_NEAR(*exit.at, 0.8, 1e-15);
  ASSERT_TRUE(exit.touch);
  EXPECT_NEAR(*exit.touch, 0.3, 1e-7);
}

TEST(EdgeFirstExit, TwoZerosSideBySideAreAnExit) {
  for (const double distance : {1e-2, 1e-4, 1e-6}) {
    const auto p = times_linear(times_linear({1.0}, 0.4), 0.4 + distance);
    const FirstExit exit = first_exit(p, 4.0 * epsilon);
    ASSERT_TRUE(exit.at) << distance;
    EXPECT_NEAR(*exit.at, 0.4, 16.0 * epsilon / distance) << distance;
  }
}

TEST(PropertyFirstExit, IsTheLeastOfRandomZeros) {
  TracedDraws draws(61);
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> p = {draws.log_uniform(1e-3, 1e3)};
    double least = 2.0;
    std::vector<double> roots;
    const int degree = 1 + i % 12;
    for (int k = 0; k < degree; ++k) {
      roots.push_back(draws.uniform(0.02, 3.0));
      p = times_linear(p, roots.back());
      least = std::min(least, roots.back());
    }
    // How far rounding of the coefficients moves the least one.
    double slope = p.back();
    for (const double root : roots) {
      if (root != least) slope *= root - least;
    }
    const double rounding = 4.0 * epsilon * size_of(p);
    const double moved = 4.0 * rounding / std::abs(slope);
    if (moved > 1e-6 || std::abs(least - 1.0) < 1e-6) continue;
    const FirstExit exit = first_exit(p, rounding);
    ASSERT_EQ(exit.at.has_value(), least < 1.0);
    if (least < 1.0) {
      EXPECT_NEAR(*exit.at, least, moved + epsilon);
    }
  }
}

/// As a step's: the terms of order k are some 2ᵏ/k!.
std::vector<double> drawn_series(SeededDraws& draws, std::size_t count) {
  std::vector<double> p = {draws.log_uniform(1e-3, 3.0)};
  double size = 1.0;
  for (std::size_t k = 1; k < count; ++k) {
    size *= 2.0 / static_cast<double>(k);
    p.push_back(size * draws.uniform(-1.0, 1.0));
  }
  return p;
}

TEST(PropertyRoughExit, IsNearThatOfTheWholeSeries) {
  TracedDraws draws(62);
  constexpr int series = 5000;
  int stays = 0;
  int falls = 0;
  for (int i = 0; i < series; ++i) {
    const std::vector<double> p =
        drawn_series(draws, most_leading + 1 + static_cast<std::size_t>(i % 14));
    const double rounding = 4.0 * epsilon * size_of(p);
    double rest = rounding;
    for (std::size_t k = most_leading; k < p.size(); ++k) rest += std::abs(p[k]);
    const auto rough =
        rough_exit(std::span(p).first(most_leading), rest, static_cast<int>(p.size()) - 1);
    if (!rough) continue;
    const FirstExit exit = first_exit(p, rounding);
    ASSERT_EQ(rough->at.has_value(), exit.at.has_value());
    ++(exit.at ? falls : stays);
    if (!exit.at) continue;
    EXPECT_LE(std::abs(*rough->at - *exit.at), rough->within);
    EXPECT_LT(rough->within, 1e-2);
  }
  EXPECT_GT(stays, series / 3);
  EXPECT_GT(falls, series / 5);
}

TEST(EdgeRoughExit, LeadingTermsDoNotTellWhatTheRestMayHide) {
  const auto touching = times_linear(times_linear({1.0}, 0.3), 0.3);
  EXPECT_FALSE(rough_exit(touching, 1e-9, 20));
  const auto two_zeros = times_linear(times_linear({1.0}, 0.3), 0.301);
  EXPECT_FALSE(rough_exit(two_zeros, 1e-9, 20));
  for (const double end : {0.001, -0.001}) {  // beyond the end or not
    EXPECT_FALSE(rough_exit(std::vector{1.0, end - 1.0}, 1e-2, 20));
  }
  EXPECT_FALSE(rough_exit(std::vector{1e-3, 1.0, -2.0}, 1e-2, 20));  // from which side it comes
  const auto thrice = times_linear(times_linear(times_linear({1.0}, 0.25), 0.5), 0.75);
  EXPECT_FALSE(rough_exit(thrice, 1e-9, 20));
}

/// p(τ) = c − s τ: with the slope 16 E M ≤ D² just holds or just fails, D = s − E last and
/// M = E last (last − 1).
TEST(EdgeRoughExit, TellsNothingWhereTheRestMayBendTheCurveBack) {
  constexpr double rest = 0.01;
  constexpr int last = 20;
  const double steepest = 4.0 * rest * std::sqrt(last * (last - 1.0)) + rest * last;
  const auto falling = [](double slope) {
    return std::vector{slope * 5.5 / (most_leading - 1.0), -slope};  // between two coefficients
  };
  EXPECT_TRUE(rough_exit(falling(1.01 * steepest), rest, last));
  EXPECT_FALSE(rough_exit(falling(0.99 * steepest), rest, last));
}

/// Below −uncertainty without its last term, above it with that.
TEST(EdgeFirstExit, LastTermsThatAreLeftOutMayHoldItUp) {
  constexpr double uncertainty = 1e-6;
  constexpr double touching = 0.75;
  const double least = -uncertainty * (1.0 + 0.25 * negligible_share);
  std::vector<double> p = {1.0 + least, -2.0 / touching, 1.0 / (touching * touching)};
  EXPECT_TRUE(first_exit(p, uncertainty).at);
  p.push_back(0.99 * negligible_share * uncertainty);
  EXPECT_FALSE(first_exit(p, uncertainty).at);
}

}  // namespace
}  // namespace gearlash::hybrid::first_exit_test
