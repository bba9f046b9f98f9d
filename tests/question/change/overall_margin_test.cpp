// Margins to the boundary of hunting against plain bisection, and against random directions.
#include "question/change/overall_margin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "base/described.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "question/change/drives.hpp"
#include "question/change/margins.hpp"
#include "question/change/target.hpp"

namespace gearlash::overall_margin_test {
namespace {

double growth_of(const Drivetrain& drive) {
  return growth_at_rest(servo_dynamics(normalize(drive)));
}
bool hunts(const Drivetrain& drive) { return growth_of(drive) > 1.0; }

/// One in eight has no load inertia, one in eight no motor inertia.
NormalizedServo drawn_servo(SeededDraws& draws) {
  const double kind = draws.uniform(0.0, 1.0);
  const double inertia_ratio = kind < 0.125  ? 0.0
                               : kind < 0.25 ? std::numeric_limits<double>::infinity()
                                             : draws.log_uniform(1e-2, 1e2);
  return {.damping = draws.log_uniform(0.01, 3.0),
          .inertia_ratio = inertia_ratio,
          .friction_ratio = draws.uniform(0.01, 0.99),
          .backlash = 0.1};
}

// ---- one parameter ------------------------------------------------------------------------------

/// The first value from the present one towards `end` at which hunting starts or stops, in 4,000
/// steps that grow by ratio, or evenly from 0; NaN if there is none.
double first_change(const Drive& drive, std::string_view parameter, double end) {
  const ServoLine line = line_of(drive, parameter);
  const double present = line.present();
  const bool now = hunts(drivetrain_of(drive));
  constexpr int steps = 4000;
  double last = present;
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    double value = present > 0.0 ? present * std::pow(end / present, share) : end * share;
    if (hunts(line.at(value)->drivetrain) == now) {
      last = value;
      continue;
    }
    for (double middle = 0.5 * (last + value); middle != last && middle != value;
         middle = 0.5 * (last + value)) {
      (hunts(line.at(middle)->drivetrain) == now ? last : value) = middle;
    }
    return value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

ParameterMargin margin_of(const Drive& drive, std::string_view parameter) {
  return parameter_margin(drive, axis_to_search(drive, parameter), hunts(drivetrain_of(drive)));
}

void expect_same(const std::optional<double>& found, double scanned) {
  ASSERT_EQ(!found, std::isnan(scanned)) << scanned;
  if (!found) return;
  EXPECT_NEAR(*found, scanned, 1e-10 * scanned);
}

TEST(PropertyHuntingMargin, OfEachParameterIsWhereBisectionEnds) {
  TracedDraws draws(2401);
  int found = 0;
  for (int i = 0; i < 20; ++i) {
    const NormalizedServo servo = drawn_servo(draws);
    SCOPED_TRACE(described(servo));
    const Drive drive = drive_of(servo);
    for (const std::string_view parameter :
         {"gearbox.ratio", "controller.proportional", "load.friction", "motor.friction",
          "controller.motor_speed_feedback", "load.inertia", "motor.inertia"}) {
      SCOPED_TRACE(parameter);
      const ParameterMargin margin = margin_of(drive, parameter);
      EXPECT_EQ(margin.kind, SearchKind::certified);
      EXPECT_EQ(margin.hunts, hunts(drivetrain_of(drive)));
      expect_same(margin.above, first_change(drive, parameter, margin.searched.high));
      found += margin.above.has_value() + margin.below.has_value();
      if (parameter == "controller.motor_speed_feedback") {
        EXPECT_FALSE(margin.below);
        continue;
      }
      const double low = std::max(margin.searched.low, 1e-6 * margin.present);
      expect_same(margin.below, first_change(drive, parameter, low));
    }
  }
  EXPECT_GT(found, 100);
}

TEST(HuntingMargin, InPerCentOfThePresentValue) {
  const Drive drive = drive_of(NormalizedServo{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3});
  const ParameterMargin gain = margin_of(drive, "controller.proportional");
  EXPECT_TRUE(gain.hunts);
  EXPECT_FALSE(gain.above);  // stiffer loops hunt
  ASSERT_TRUE(gain.below);
  EXPECT_LT(gain.per_cent_below().value(), 0.0);
  EXPECT_FALSE(hunts(line_of(drive, "controller.proportional").at(*gain.below)->drivetrain));
  EXPECT_TRUE(
      hunts(line_of(drive, "controller.proportional").at(*gain.below * (1.0 + 1e-12))->drivetrain));
  EXPECT_DOUBLE_EQ(gain.per_cent_below().value(), 100.0 * (*gain.below - 1.0));
  const ParameterMargin backlash = margin_of(drive, "backlash");
  EXPECT_FALSE(backlash.below || backlash.above);
}

// ---- all together -------------------------------------------------------------------------------

using Direction = std::array<double, 5>;

Direction unit(Direction direction) {
  double square = 0.0;
  for (const double component : direction) square += component * component;
  for (double& component : direction) component /= std::sqrt(square);
  return direction;
}

/// Evenly distributed.
Direction drawn_direction(SeededDraws& draws) {
  Direction direction;
  for (double& component : direction) {
    const double radius = std::sqrt(-2.0 * std::log(draws.uniform(1e-300, 1.0)));
    component = radius * std::cos(draws.uniform(0.0, 2.0 * std::numbers::pi));
  }
  return unit(direction);
}

Drivetrain changed(Drivetrain drive, const Direction& direction, double length) {
  drive.motor_inertia *= std::exp(length * direction[0]);
  drive.load_inertia *= std::exp(length * direction[1]);
  drive.motor_friction *= std::exp(length * direction[2]);
  drive.load_friction *= std::exp(length * direction[3]);
  drive.stiffness *= std::exp(length * direction[4]);
  return drive;
}

/// How many of `steps` places up to `length` along it are beyond the boundary.
int crossed(const Drivetrain& drive, const Direction& direction, double length, int steps) {
  int count = 0;
  for (int i = 1; i <= steps; ++i) {
    count += hunts(changed(drive, direction, length * i / steps)) != hunts(drive);
  }
  return count;
}

Direction direction_of(const OverallMargin& margin) {
  const LogChange& change = *margin.change;
  return unit({change.motor_inertia, change.load_inertia, change.motor_friction,
               change.load_friction, change.stiffness});
}

Drivetrain at_boundary(const Drivetrain& drive, const OverallMargin& margin) {
  return changed(drive, direction_of(margin), margin.change->length());
}

TEST(PropertyHuntingMargin, NoRandomDirectionIsShorter) {
  TracedDraws draws(2402);
  for (int i = 0; i < 40; ++i) {
    const NormalizedServo servo = drawn_servo(draws);
    SCOPED_TRACE(described(servo));
    const Drivetrain drive = drivetrain_of(drive_of(servo, draws.log_uniform(1.0, 100.0)));
    const OverallMargin margin = overall_margin(drive);
    ASSERT_EQ(margin.outcome, MarginOutcome::found);
    EXPECT_GE(margin.converged, 1U);
    EXPECT_NEAR(growth_of(at_boundary(drive, margin)), 1.0, 1e-10);
    const double shorter = margin.change->length() - 1e-6;
    for (int k = 0; k < 2000; ++k) {
      EXPECT_EQ(crossed(drive, drawn_direction(draws), shorter, 16), 0);
    }
    // And near the one found, where a shorter one would be likeliest.
    for (int k = 0; k < 200; ++k) {
      const double spread = draws.log_uniform(1e-3, 1.0);
      const Direction aside = drawn_direction(draws);
      Direction near = direction_of(margin);
      for (std::size_t n = 0; n < near.size(); ++n) near[n] += spread * aside[n];
      EXPECT_EQ(crossed(drive, unit(near), shorter, 4), 0);
    }
    EXPECT_NE(hunts(changed(drive, direction_of(margin), margin.change->length() + 1e-6)),
              hunts(drive));
  }
}

TEST(PropertyHuntingMargin, ChangesNoUnit) {
  TracedDraws draws(2403);
  for (int i = 0; i < 50; ++i) {
    const NormalizedServo servo = drawn_servo(draws);
    SCOPED_TRACE(described(servo));
    const OverallMargin margin = overall_margin(drivetrain_of(drive_of(servo)));
    ASSERT_EQ(margin.outcome, MarginOutcome::found);
    const LogChange& x = *margin.change;
    const double inertias = x.motor_inertia + x.load_inertia;
    const double frictions = x.motor_friction + x.load_friction;
    EXPECT_NEAR(inertias + frictions + x.stiffness, 0.0, 1e-7 * margin.change->length());
    EXPECT_NEAR(2.0 * inertias + frictions, 0.0, 1e-7 * margin.change->length());
  }
}

/// The margin by one parameter alone is a change of all, so it is no shorter.
TEST(PropertyHuntingMargin, OfAllTogetherIsShorterThanOfOne) {
  TracedDraws draws(2404);
  for (int i = 0; i < 10; ++i) {
    const NormalizedServo servo = drawn_servo(draws);
    SCOPED_TRACE(described(servo));
    const HuntingMargin margin = margins(drive_of(servo));
    ASSERT_EQ(margin.parameters.size(), all_parameters.size() - 1);  // all but restitution
    for (const ParameterMargin& one : margin.parameters) {
      const bool is_number = one.parameter == "load.friction" ||
                             one.parameter == "motor.friction" || one.parameter == "load.inertia" ||
                             one.parameter == "motor.inertia" ||
                             one.parameter == "controller.proportional";
      if (!is_number) continue;
      for (const std::optional<double>& end : {one.below, one.above}) {
        if (!end) continue;
        EXPECT_GE(std::abs(std::log(*end / one.present)), margin.overall->change->length() - 1e-9);
      }
    }
  }
}

Drive bouncing_drive() {
  return drive_of(NormalizedServo{.damping = 0.3,
                                  .inertia_ratio = 2.0,
                                  .friction_ratio = 0.3,
                                  .backlash = 0.3,
                                  .restitution = 0.2});
}

TEST(HuntingMargin, WithBouncesOfAllTogetherIsWhereRestTurnsStable) {
  const Drivetrain drive = drivetrain_of(bouncing_drive());
  const OverallMargin margin = overall_margin(drive);
  ASSERT_EQ(margin.outcome, MarginOutcome::found);
  EXPECT_TRUE(margin.hunts);
  EXPECT_NEAR(growth_of(at_boundary(drive, margin)), 1.0, 1e-10);
  const Direction along = direction_of(margin);
  EXPECT_EQ(closed_answer(changed(drive, along, margin.change->length() + 1e-3)).verdict,
            Verdict::cannot_hunt);
  EXPECT_EQ(closed_answer(changed(drive, along, margin.change->length() - 1e-3)).verdict,
            Verdict::hunts);
  TracedDraws draws(2405);
  for (int k = 0; k < 500; ++k) {
    EXPECT_EQ(crossed(drive, drawn_direction(draws), margin.change->length() - 1e-6, 8), 0);
  }
}

TEST(HuntingMargin, WithBouncesOfOneIsWhereTheVerdictChanges) {
  const ParameterMargin margin = margin_of(bouncing_drive(), "load.friction");
  EXPECT_EQ(margin.kind, SearchKind::scanned);
  EXPECT_TRUE(margin.hunts);
  EXPECT_FALSE(margin.below);
  const auto verdict_at = [](double value) {
    return line_of(bouncing_drive(), "load.friction").answer_at(value).verdict;
  };
  EXPECT_EQ(verdict_at(*margin.above), Verdict::cannot_hunt);
  EXPECT_EQ(verdict_at(*margin.above * (1.0 - 1e-4)), Verdict::hunts);
}

TEST(EdgeHuntingMargin, SaysWhatItIsNotWorkedOutFor) {
  const auto outcome_of = [](NormalizedServo servo) {
    return overall_margin(drivetrain_of(drive_of(servo))).outcome;
  };
  const NormalizedServo sample{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};
  NormalizedServo servo = sample;
  servo.friction_ratio = 0.0;
  EXPECT_EQ(outcome_of(servo), MarginOutcome::always_hunts);
  servo = sample;
  servo.backlash = 0.0;
  EXPECT_EQ(outcome_of(servo), MarginOutcome::never_hunts);
  servo.backlash = -1.0;
  EXPECT_THROW(outcome_of(servo), InvalidInput);
}

/// Where the faces never part again growth at rest is 0 with no slope: the rays show the way.
TEST(EdgeHuntingMargin, IsFoundWhereGrowthAtRestIsNought) {
  const NormalizedServo servo{
      .damping = 3.0, .inertia_ratio = 1.0, .friction_ratio = 0.5, .backlash = 0.1};
  const Drivetrain drive = drivetrain_of(drive_of(servo));
  ASSERT_EQ(growth_of(drive), 0.0);
  const OverallMargin margin = overall_margin(drive);
  ASSERT_EQ(margin.outcome, MarginOutcome::found);
  EXPECT_FALSE(margin.hunts);
  EXPECT_NEAR(growth_of(at_boundary(drive, margin)), 1.0, 1e-10);
}

}  // namespace
}  // namespace gearlash::overall_margin_test
