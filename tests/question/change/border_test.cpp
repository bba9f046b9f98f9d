// What happens at the ends of the intervals of a design: named, and where.
#include "question/change/border.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "general/attractors/search_setting.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::border_test {
namespace {

/// Hunts if disturbed.
Drive hunting_drive() {
  Drive drive = pd_drive();
  drive.motor.inertia = 2e-6;
  drive.controller.law =
      PID{.terms = PIDTerms::PD, .proportional = 20.0, .derivative = 0.02, .filter = 1e-3};
  return drive;
}

const Target still{.no_hunting = true, .no_hunting_if_disturbed = true};

/// The stable cycle near the one of another drive, by Newton's method alone.
std::optional<hybrid::PeriodicOrbit> cycle_beside(const Drive& drive, const Analysis& near) {
  const auto setting = drive::search_setting(reduce_settled(drive));
  const auto at = drive::search_setting(near.reduced);
  return neighbouring_orbit(setting.system, near.search->cycles.at(0).orbit, at.system);
}

TEST(OracleBorder, AtAFoldTheCycleHasAMultiplierOfOneAndNoneIsBeyond) {
  Drive drive = hunting_drive();
  const auto with = [&](double coulomb) {
    drive.motor.friction.coulomb = coulomb;
    return analyse_in_full(drive);
  };
  const Analysis rests = with(0.0081);
  const Analysis hunts = with(0.0078);
  const Border fold = border_between(
      [&](double coulomb) {
        Drive along = drive;
        along.motor.friction.coulomb = coulomb;
        return along;
      },
      {0.0081, rests}, {0.0078, hunts}, 0.007, no_progress());
  EXPECT_EQ(fold.kind, BorderKind::fold);
  EXPECT_LE(fold.located, 1e-9);
  EXPECT_GT(fold.at, 0.0078);
  EXPECT_LT(fold.at, 0.0081);
  // Two cycles meet as the root of the distance: 1 − multiplier halves where that is a quarter.
  drive.motor.friction.coulomb = fold.at * (1.0 - 1e-3);
  const Analysis beside = analyse_in_full(drive);
  ASSERT_FALSE(beside.search->cycles.empty());
  const auto loss_at = [&](double share) {
    Drive nearer = drive;
    nearer.motor.friction.coulomb = fold.at * (1.0 - share);
    const auto orbit = cycle_beside(nearer, beside);
    if (!orbit) throw std::runtime_error("no cycle beside the fold");
    return 1.0 - std::abs(orbit->multipliers.at(0));
  };
  EXPECT_NEAR(loss_at(1e-4) / loss_at(2.5e-5), 2.0, 0.05);
  Drive beyond = drive;
  beyond.motor.friction.coulomb = fold.at * (1.0 + 1e-6);
  EXPECT_FALSE(cycle_beside(beyond, beside));
}

/// The speed of the load just before the impact that meets it slowest.
double speed_at_impact(const Analysis& analysis) {
  const drive::SearchSetting setting = drive::search_setting(analysis.reduced);
  double least = std::numeric_limits<double>::infinity();
  for (const hybrid::Event& event : analysis.search->cycles.at(0).orbit.events) {
    const auto& mode = setting.system.system().mode(event.mode);
    if (mode.transitions[event.transition].name.find("impact") == std::string::npos) continue;
    least = std::min(least, std::abs(setting.load.speed.at(event.before)));
  }
  return least;
}

TEST(OracleBorder, AtAGrazingTheLoadAllButStopsBeforeAnImpactAndNoCycleIsBeyond) {
  Drive drive = hunting_drive();
  const FeasibleValues found =
      values(drive, linear("controller.proportional", 4.0, 10.0, 7), still);
  ASSERT_EQ(found.borders.size(), 1U);
  const Border& grazing = found.borders[0];
  EXPECT_EQ(grazing.kind, BorderKind::grazing);
  EXPECT_NE(grazing.event.find("load stops"), std::string::npos) << grazing.event;
  EXPECT_NEAR(grazing.at, grazing.end, 1e-3 * grazing.at);
  const auto with = [&](double share) {
    std::get<PID>(drive.controller.law).proportional = grazing.at * (1.0 + share);
    return drive;
  };
  // In proportion to the distance from the border.
  const Analysis beside = analyse_in_full(with(0.001));
  EXPECT_NEAR(speed_at_impact(analyse_in_full(with(0.004))) / speed_at_impact(beside), 4.0, 0.5);
  EXPECT_TRUE(cycle_beside(with(0.0005), beside));
  EXPECT_FALSE(cycle_beside(with(-0.0005), beside));
}

TEST(Border, AtALimitOfAQuantityNothingElseHappens) {
  Target small;
  small.require(Quantity::amplitude, {0.0, 5e-4});
  const FeasibleValues found =
      values(hunting_drive(), linear("gearbox.backlash", 1.5e-3, 2.0e-3, 3), small);
  ASSERT_EQ(found.borders.size(), 1U);
  EXPECT_EQ(found.borders[0].kind, BorderKind::limit);
  EXPECT_EQ(found.borders[0].at, found.intervals.at(0).high);
  EXPECT_LE(found.borders[0].located, 2e-9);
}

}  // namespace
}  // namespace gearlash::border_test
