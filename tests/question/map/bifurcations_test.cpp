// Branches of cycles and their borders, against single analyses and simulated motions beside them.
#include "question/map/bifurcations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/stopping.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/motion.hpp"
#include "question/analyse.hpp"

namespace gearlash::bifurcations_test {
namespace {

/// Integral action against friction, with a limited torque and anti-windup: beyond a fold a stable
/// cycle of the limit stands beside rest, with an unstable one between.
Drive limited_integral(double integral) {
  Drive drive;
  drive.motor = {.inertia = 1e-4, .friction = {.viscous = 2e-4, .coulomb = 0.01}, .limit = 0.5};
  drive.gearbox = {.ratio = 50.0, .backlash = 2.9e-7};
  drive.load = {.inertia = 0.3, .friction = {.viscous = 0.05}};
  drive.controller.law = PID{.terms = PIDTerms::PID,
                             .proportional = 2.0,
                             .integral = integral,
                             .derivative = 0.02,
                             .tracking_time = 0.2};
  return drive;
}

std::vector<MarkedBorder> borders_called(const BifurcationDiagram& diagram,
                                         const std::string& word) {
  std::vector<MarkedBorder> found;
  std::copy_if(diagram.borders.begin(), diagram.borders.end(), std::back_inserter(found),
               [&](const MarkedBorder& border) { return border.word == word; });
  return found;
}

/// The largest error of the load in the last of `until` seconds, from rest at `position`.
double last_error(const Drive& drive, double position, double until) {
  const Motion motion =
      simulate(drive, {.until = until, .start = Start{.load_position = position}});
  double largest = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    largest = std::max(largest, std::abs(motion.at(until - 1.0 + i / 1000.0).shafts.load_position));
  }
  return largest;
}

TEST(Bifurcations, AFoldJoinsAStableAndAnUnstableBranch) {
  const BifurcationDiagram diagram =
      bifurcations_of(limited_integral(8.0), linear("controller.integral", 5.5, 7.5, 3));
  ASSERT_TRUE(diagram.is_complete);
  EXPECT_EQ(diagram.searched, 3U);
  ASSERT_EQ(diagram.branches.size(), 2U);
  EXPECT_NE(diagram.branches[0].stability, diagram.branches[1].stability);
  const std::vector<MarkedBorder> folds = borders_called(diagram, "fold");
  ASSERT_EQ(folds.size(), 1U);
  const double fold = folds.front().parameter;
  const double amplitude = folds.front().cycle->amplitude;
  for (const CycleBranch& branch : diagram.branches) {
    EXPECT_EQ(branch.points.front().parameter, fold);
    EXPECT_EQ(branch.points.front().amplitude, amplitude);
    EXPECT_EQ(branch.points.back().parameter, 7.5);
    // The branches open to both sides of the fold.
    const bool is_stable = branch.stability == Stability::stable;
    for (std::size_t i = 1; i < branch.points.size(); ++i) {
      EXPECT_GE(branch.points[i].parameter, branch.points[i - 1].parameter);
      EXPECT_EQ(branch.points[i].amplitude > amplitude, is_stable);
    }
  }
  // Wherever the branches were left, it is followed to the same place.
  const BifurcationDiagram wider =
      bifurcations_of(limited_integral(8.0), linear("controller.integral", 5.0, 8.0, 2));
  ASSERT_EQ(borders_called(wider, "fold").size(), 1U);
  EXPECT_NEAR(borders_called(wider, "fold").front().parameter, fold, 1e-8 * fold);
  // From the amplitude of the fold the drive hunts on one side of it alone.
  EXPECT_GT(last_error(limited_integral(1.01 * fold), 1.1 * amplitude, 60.0), 0.9 * amplitude);
  EXPECT_LT(last_error(limited_integral(0.97 * fold), 1.1 * amplitude, 60.0), 0.2 * amplitude);
}

TEST(Bifurcations, BranchesPassThroughTheCyclesOfSingleSearches) {
  const BifurcationDiagram diagram =
      bifurcations_of(limited_integral(8.0), linear("controller.integral", 7.5, 8.5, 2));
  for (const double integral : {7.5, 8.5}) {
    const Answer answer = analyse(limited_integral(integral));
    const Cycle* cycle = answer.largest_stable();
    ASSERT_NE(cycle, nullptr);
    const bool is_passed = std::any_of(
        diagram.branches.begin(), diagram.branches.end(), [&](const CycleBranch& branch) {
          return std::any_of(branch.points.begin(), branch.points.end(), [&](const CycleAt& at) {
            return at.parameter == integral && at.stability == Stability::stable &&
                   std::abs(at.amplitude - cycle->amplitude) < 1e-9;
          });
        });
    EXPECT_TRUE(is_passed) << integral;
  }
  EXPECT_TRUE(borders_called(diagram, "cycle is lost").empty());
}

/// The border that design and charts know: growth at rest 1.
TEST(Bifurcations, ThePlasticCycleVanishesWhereRestIsLost) {
  const Drive servo = normal_form(0.5, 2.0, 0.1, 0.3);
  const BifurcationDiagram diagram = bifurcations_of(servo, linear("servo.damping", 0.1, 0.9, 9));
  ASSERT_EQ(diagram.branches.size(), 1U);
  const std::vector<MarkedBorder> losses = borders_called(diagram, "loss of rest");
  ASSERT_EQ(losses.size(), 1U);
  const double border = losses.front().parameter;
  EXPECT_EQ(diagram.branches.front().points.back().parameter, border);
  EXPECT_EQ(diagram.branches.front().points.back().amplitude, 0.0);
  ASSERT_EQ(diagram.rests.size(), 1U);
  EXPECT_EQ(diagram.rests.front().low, border);
  EXPECT_EQ(diagram.rests.front().high, 0.9);
  Drive above = servo;
  above.servo->damping = border * (1.0 + 1e-9);
  Drive below = servo;
  below.servo->damping = border * (1.0 - 1e-9);
  EXPECT_LE(*analyse(above).growth_at_rest, 1.0);
  EXPECT_GT(*analyse(below).growth_at_rest, 1.0);
}

TEST(Bifurcations, BouncingCyclesLoseTheirStability) {
  const BifurcationDiagram diagram = bifurcations_of(normal_form(0.19, 2.0, 0.1, 0.3),
                                                     linear("contact.restitution", 0.3, 0.6, 16));
  EXPECT_FALSE(borders_called(diagram, "stability changes").empty());
  const auto& first = diagram.branches.front().points.front();
  EXPECT_NEAR(first.amplitude, 0.24010464, 1e-8);
  EXPECT_TRUE(diagram.rests.empty());
}

TEST(Bifurcations, StoppedWorkIsIncomplete) {
  test::Stopping stop;
  EXPECT_FALSE(
      bifurcations_of(limited_integral(8.0), linear("controller.integral", 7.0, 8.0, 2), stop)
          .is_complete);
}

}  // namespace
}  // namespace gearlash::bifurcations_test
