// Margins of searched drives beside those of the closed form, and put back into the drive.
#include "question/change/margins.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/stopping.hpp"
#include "closed_form/drive_box.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "question/change/overall_margin.hpp"
#include "question/change/target.hpp"
#include "question/faults_of.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::margins_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Drive with(Drive drive, std::string_view path, double value) {
  set(drive, path, value);
  return drive;
}

bool rests(const Drive& drive) { return is_met(always_at_rest(), analyse(drive)); }

/// A servo of 1960 that hunts: half its gain would end that.
Drive servo() {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 1.0 / 3.0, .friction = {.viscous = 0.3}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.3};
  drive.load = {.inertia = 2.0 / 3.0, .friction = {.viscous = 0.3}};
  drive.controller.law = PID{.proportional = 1.0};
  return drive;
}

/// The same, with a limit that it never meets and with which it must be searched.
Drive limited_servo() {
  Drive drive = servo();
  set(drive, "motor.torque_limit", 1e6);
  return drive;
}

/// With the gain and the load's friction times these factors.
double growth(double gain, double friction) {
  static const Drivetrain present = settled_servo(servo())->drivetrain;
  Drivetrain drive = present;
  drive.stiffness *= gain;
  drive.load_friction *= friction;
  return growth_at_rest(servo_dynamics(normalize(drive)));
}

// A search takes motion for hunting that dies by less than some 0.1 % a swing, as close to the
// servo's border. It places the border early, on the side of rest.
constexpr double early = 5e-3;

ParameterMargin exact(std::string_view parameter) {
  return parameter_margin(servo(), axis_to_search(servo(), parameter), true);
}

TEST(OracleSearchedMargin, OfAServoBehindAFarLimitIsThatOfTheClosedForm) {
  ASSERT_FALSE(analyse(limited_servo()).growth_at_rest);
  const Axis gain = logarithmic("controller.proportional", 0.5, 1.0, 2);
  const HuntingMargin margin = margins(limited_servo(), {gain});
  EXPECT_TRUE(margin.hunts && margin.is_known);
  EXPECT_FALSE(margin.overall || margin.growth_at_rest || margin.stopped);
  const ParameterMargin& found = margin.parameters.at(0);
  const double below = exact(gain.path).below.value();
  EXPECT_EQ(found.kind, SearchKind::searched);
  EXPECT_LE(found.below.value(), below * (1.0 + 1e-9));
  EXPECT_GE(found.below.value(), below * (1.0 - early));
  EXPECT_FALSE(found.above);
}

TEST(OracleSearchedMargin, OfTwoTogetherIsNearlyTheLeastChangeInTheirPlane) {
  const std::vector<Axis> axes = {logarithmic("controller.proportional", 0.4, 2.5, 3),
                                  logarithmic("load.friction", 0.15, 0.6, 3)};
  const std::vector<ParameterMargin> margins = {exact(axes[0].path), exact(axes[1].path)};
  const double gain_below = margins[0].below.value();
  const double friction_above = margins[1].above.value();
  const std::optional<CombinedMargin> combined = combined_margin(servo(), axes, margins, true);
  ASSERT_TRUE(combined);
  EXPECT_THAT(combined->parameters, ElementsAre("controller.proportional", "load.friction"));
  const double at_border = growth(combined->factors[0], combined->factors[1]);
  EXPECT_LE(at_border, 1.0);
  EXPECT_GT(at_border, 1.0 - 1e-8);
  double least = 1.0;
  for (double angle = 0.0; angle < 2.0 * std::numbers::pi; angle += 0.02) {
    for (double length = 0.0; length < least; length += 0.002) {
      const double gain = std::exp(length * std::cos(angle));
      if (growth(gain, std::exp(length * std::sin(angle))) <= 1.0) least = length;
    }
  }
  EXPECT_NEAR(combined->distance, least, 0.03 * least);
  // At right angles to the line through both borders, of logarithms.
  const double along_gain = std::log(combined->factors[0]);
  const double along_friction = std::log(combined->factors[1]);
  EXPECT_NEAR(std::hypot(along_gain, along_friction), combined->distance, 1e-12);
  EXPECT_NEAR(along_gain * std::log(gain_below), along_friction * std::log(friction_above / 0.3),
              1e-8);
}

TEST(SearchedMargin, EndsWhereADriveThatRestsBeginsToHunt) {
  const Drive drive = pd_drive();
  ASSERT_TRUE(rests(drive));
  const std::vector<Axis> axes = {logarithmic("controller.proportional", 0.2, 20.0, 9),
                                  logarithmic("gearbox.backlash", 2e-4, 2e-2, 5)};
  const HuntingMargin margin = margins(drive, axes);
  EXPECT_FALSE(margin.hunts);
  const ParameterMargin& gain = margin.parameters[0];
  ASSERT_TRUE(gain.above);
  EXPECT_TRUE(rests(with(drive, gain.parameter, *gain.above)));
  EXPECT_FALSE(rests(with(drive, gain.parameter, *gain.above * (1.0 + 3.0 * gain.located))));
  for (int i = 1; i < 20; ++i) {
    EXPECT_TRUE(rests(with(drive, gain.parameter, std::lerp(gain.present, *gain.above, 0.05 * i))));
  }
  ASSERT_TRUE(margin.combined);
  const auto along = [&](double share) {
    Drive changed = drive;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const double factor = std::pow(margin.combined->factors[i], share);
      set(changed, axes[i].path, get(drive, axes[i].path) * factor);
    }
    return changed;
  };
  EXPECT_TRUE(rests(along(1.0)));
  EXPECT_FALSE(rests(along(1.0 + 3.0 * margin.combined->located)));
  EXPECT_LE(margin.combined->distance, std::log(*gain.above / gain.present));
}

TEST(SearchedMargin, OfAWordAreTheChoicesThatChangeTheVerdict) {
  const Drive drive = with(pd_drive(), "controller.proportional", 20.0);
  const HuntingMargin margin = margins(drive, {usual_axis(drive, "sensor.position")});
  const ParameterMargin& place = margin.parameters[0];
  EXPECT_FALSE(place.below || place.above || margin.combined);
  for (const double word : place.grid) {
    Drive changed = drive;
    changed.sensor.position = static_cast<SensorPlace>(static_cast<int>(word));
    const bool is_listed =
        std::find(place.choices.begin(), place.choices.end(), word) != place.choices.end();
    EXPECT_EQ(is_listed, rests(changed) != rests(drive)) << word;
  }
}

/// Above 6e-3 breakaway friction would be below Coulomb friction.
TEST(EdgeSearchedMargin, WhereADriveIsUnsoundItDoesNotBeginToHunt) {
  Drive drive = pd_drive();
  drive.load.friction.breakaway = 6e-3;
  ASSERT_TRUE(rests(drive));
  const ParameterMargin margin =
      parameter_margin(drive, linear("load.coulomb", 4e-3, 1e-2, 4), false);
  EXPECT_FALSE(margin.below || margin.above);
}

/// As of integral action against static friction: only none of it comes to rest.
TEST(EdgeSearchedMargin, MayBeNought) {
  const ParameterMargin margin =
      margin_of({.present = 1.0, .searched = {0.0, 10.0}, .intervals = {{0.0, 0.0}}});
  EXPECT_EQ(margin.below, 0.0);
  EXPECT_FALSE(margin.above);
  EXPECT_TRUE(margin.hunts);
  const ParameterMargin none =
      margin_of({.present = 1.0, .searched = {0.0, 10.0}, .intervals = {{0.0, 10.0}}});
  EXPECT_FALSE(none.below || none.above || none.hunts);
}

TEST(EdgeSearchedMargin, OfOneParameterIsTheLeastChangeWhereNoneCombinedIsLess) {
  const Drive drive = pd_drive();
  const std::vector<Axis> axes = {logarithmic("controller.proportional", 0.2, 20.0, 3)};
  const ParameterMargin one = parameter_margin(drive, axes[0], false);
  const auto combined = combined_margin(drive, axes, {one}, false);
  ASSERT_TRUE(one.above && combined);
  EXPECT_NEAR(combined->factors[0], *one.above / one.present, 2e-4 * combined->factors[0]);
  ParameterMargin none = one;
  none.above.reset();
  EXPECT_FALSE(combined_margin(drive, axes, {none}, false));
}

TEST(EdgeSearchedMargin, CanBeStopped) {
  auto stop = test::Stopping::at(0.5);
  const HuntingMargin margin =
      margins(pd_drive(), {logarithmic("controller.proportional", 0.2, 20.0, 9)}, stop);
  EXPECT_TRUE(margin.stopped);
  EXPECT_FALSE(margin.combined);
  ASSERT_EQ(margin.parameters.size(), 1U);
  EXPECT_FALSE(margin.parameters[0].undecided.empty());
}

TEST(SearchedMargin, IsByDefaultOfTheGapAndTheController) {
  EXPECT_THAT(usual_parameters(pd_drive()),
              ElementsAre("gearbox.backlash", "controller.proportional", "controller.derivative",
                          "controller.filter"));
  EXPECT_THAT(usual_parameters(normal_form(0.19, 2.0, 0.1, 0.3)),
              ElementsAre("servo.backlash", "gearbox.ratio", "controller.proportional",
                          "load.friction", "motor.friction", "controller.motor_speed_feedback",
                          "load.inertia", "motor.inertia", "contact.restitution"));
}

TEST(EdgeSearchedMargin, FaultsAreTold) {
  EXPECT_THAT(test::faults_of([] {
                (void)margins(pd_drive(), {Axis{"load.colour", {1.0}}});
              }),
              ElementsAre(HasSubstr("load.colour")));
}

}  // namespace
}  // namespace gearlash::margins_test
