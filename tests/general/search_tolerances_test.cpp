// Every tolerance of a search does what its line says.
#include <gtest/gtest.h>

#include <vector>

#include "controllers.hpp"
#include "drives.hpp"
#include "general/attractors/attractors.hpp"
#include "general/attractors/found_cycle.hpp"
#include "general/attractors/irregular_motion.hpp"
#include "general/attractors/motion_watch.hpp"

namespace gearlash::drive::search_tolerances_test {
namespace {

const ReducedDrive hunting = servo_drive(0.19, 2.0, 0.1);
const ReducedDrive fading = servo_drive(0.4284, 3.023, 0.7225);

/// Two starts, and no edges between them.
AttractorOptions few_starts() {
  AttractorOptions options;
  options.starts = {{1.0, 0.0, 1.0, 0.0}, {0.1, 0.0, 0.1, 0.0}};
  options.most_edges = 0;
  options.swing_times = 40.0;
  options.budget.patience = 1.0;
  return options;
}

TEST(SearchTolerances, TheShaftsOfACycleReturn) {
  AttractorOptions options = few_starts();
  const AttractorSearch found = find_attractors(hunting, options);
  ASSERT_EQ(found.cycles.size(), 1U);
  EXPECT_LT(found.cycles[0].mismatch, 1e-12);
  const SearchSetting setting = search_setting(hunting);
  hybrid::PeriodicOrbit not_closed = found.cycles[0].orbit;
  not_closed.period *= 1.0 + 1e-4;  // its residual is still that of the orbit
  EXPECT_FALSE(
      returns(measured(setting, not_closed, options.tolerances), options.tolerances.cycle));
  options.tolerances.cycle.return_of_shafts = -1.0;
  EXPECT_EQ(find_attractors(hunting, options).count(MotionEnd::cycle), 0U);
}

TEST(SearchTolerances, DefaultsFindTheCycleAndTheRest) {
  EXPECT_EQ(find_attractors(hunting, few_starts()).count(MotionEnd::cycle), 2U);
  AttractorOptions patient = few_starts();
  patient.budget.patience = 20.0;
  EXPECT_EQ(find_attractors(fading, patient).count(MotionEnd::rest), 2U);
}

TEST(SearchTolerances, RunningAway) {
  AttractorOptions options = few_starts();
  options.tolerances.far_away = 1e-6;
  EXPECT_EQ(find_attractors(hunting, options).count(MotionEnd::diverges), 0U);
  options.tolerances.far_grown = 1e-6;
  EXPECT_EQ(find_attractors(hunting, options).count(MotionEnd::diverges), 2U);
}

/// 100 swings in 100 s, with this mean period from middle to middle.
SteadyMotion scattering(double period) {
  SteadyMotion motion;
  motion.ranges.resize(static_cast<std::size_t>(search_setting(hunting).own));
  for (Extent& range : motion.ranges) range.include(Bounds{-1.0, 1.0});
  IrregularFound& found = motion.found;
  found.amplitude = found.motor_amplitude = found.half_swing = 1.0;
  found.period = period;
  found.watched = 100.0;
  found.swings = 100;
  return motion;
}

TEST(SearchTolerances, SwingsThatTakeAsLongAreThoseOfOneMotion) {
  const SearchSetting setting = search_setting(hunting);
  IrregularTolerances tolerances;
  const auto are_one = [&](const SteadyMotion& one, const SteadyMotion& other) {
    return is_same(one, other, setting, tolerances);
  };
  EXPECT_TRUE(are_one(scattering(2.0), scattering(2.05)));
  SteadyMotion other = scattering(3.0);
  EXPECT_FALSE(are_one(scattering(2.0), other));
  tolerances.pace_suffices = true;
  EXPECT_TRUE(are_one(scattering(2.0), other));
  other.found.watched = 104.0;
  EXPECT_FALSE(are_one(scattering(2.0), other));
  SteadyMotion few = scattering(3.0);
  few.found.swings = 30;
  few.found.watched = 30.0;
  EXPECT_FALSE(are_one(scattering(2.0), few));
}

/// What a load did that swung about 0 with these amplitudes.
Watch swung(const std::vector<double>& amplitudes) {
  Watch watch;
  double time = 0.0;
  double way = 1.0;
  for (const double amplitude : amplitudes) {
    watch.load.push_back({time, way * amplitude});
    time += 1.0;
    way = -way;
  }
  watch.load.push_back({time, 0.0});
  return watch;
}

/// As the integral of a limited torque winds up: ever larger, by as much each time.
TEST(SearchTolerances, SwingsThatGrowFarBeyondTheDriveRunAway) {
  const SearchSetting setting = search_setting(hunting, {});
  ASSERT_EQ(setting.farthest_length, 0.3);
  std::vector<double> growing;
  for (int i = 0; i < 12; ++i) growing.push_back(100.0 + 10.0 * i);
  const auto runs_away = [&](const std::vector<double>& amplitudes, const SearchSetting& of) {
    Watch watch = swung(amplitudes);
    watch.here = of.start({});
    return has_run_away(watch, of, {});
  };
  EXPECT_TRUE(runs_away(growing, setting));  // the last swing: 210 + 200 > 1e3 · 0.3
  for (const double nearer : {0.7, 0.1}) {
    std::vector<double> small = growing;
    for (double& amplitude : small) amplitude *= nearer;
    EXPECT_FALSE(runs_away(small, setting)) << nearer;
  }
  EXPECT_FALSE(runs_away({growing.end() - 9, growing.end()}, setting));  // too few
  std::vector<double> slowing = growing;
  slowing.back() -= 5.0;
  EXPECT_FALSE(runs_away(slowing, setting));
  std::vector<double> shrunk = growing;
  shrunk[6] = 60.0;
  EXPECT_FALSE(runs_away(shrunk, setting));
  ReducedDrive limited = hunting;
  limited.torque_limit = 1.0;
  EXPECT_FALSE(runs_away(growing, search_setting(limited, {})));  // 410 < 1e3 · 1 N m/(1 N m/rad)
  limited.controller = at_load(
      TransferFunctionController{1.0, {1.0}, {1.0, 1.0}});  // lets no leap of the error through
  EXPECT_FALSE(runs_away(growing, search_setting(limited, {})));
}

TEST(SearchTolerances, Rest) {
  AttractorOptions options = few_starts();
  options.tolerances.rest.still = 1e3;
  EXPECT_EQ(find_attractors(hunting, options).count(MotionEnd::rest), 2U);
  options.tolerances.rest.still = 1e-3;  // it swings by more than that of all that it has moved
  EXPECT_EQ(find_attractors(hunting, options).count(MotionEnd::cycle), 2U);
  for (double RestTolerances::*limit :
       {&RestTolerances::vanishing_limit, &RestTolerances::small_swing,
        &RestTolerances::small_motion}) {
    AttractorOptions strict = few_starts();
    strict.budget.patience = 20.0;
    strict.budget.counted_between_events = 1e9;  // else watched until nothing moves
    strict.tolerances.rest.*limit = 0.0;
    EXPECT_EQ(find_attractors(fading, strict).count(MotionEnd::rest), 0U);
  }
}

TEST(SearchTolerances, WhatIsClosedMustFitItselfAndTheMotion) {
  for (double CycleTolerances::*limit : {&CycleTolerances::residual, &CycleTolerances::agreement}) {
    AttractorOptions options = few_starts();
    options.tolerances.cycle.*limit = 0.0;
    EXPECT_EQ(find_attractors(hunting, options).count(MotionEnd::cycle), 0U);
  }
  AttractorOptions options = few_starts();
  options.tolerances.cycle.least_amplitude = 1e3;
  EXPECT_EQ(find_attractors(hunting, options).count(MotionEnd::cycle), 0U);
}

TEST(SearchTolerances, StabilityAndSymmetry) {
  AttractorOptions options = few_starts();
  options.tolerances.cycle.neutral_band = 10.0;
  options.tolerances.cycle.recurrence = 0.0;
  const AttractorSearch found = find_attractors(hunting, options);
  ASSERT_EQ(found.cycles.size(), 1U);
  EXPECT_EQ(found.cycles[0].stability, Stability::neutral);
  EXPECT_FALSE(found.cycles[0].is_symmetric);
  const double beside = std::abs(found.cycles[0].multiplier - 1.0);
  options.tolerances.cycle.neutral_band = 0.99 * beside;
  EXPECT_EQ(find_attractors(hunting, options).cycles.at(0).stability, Stability::stable);
  options.tolerances.cycle.neutral_band = 1.01 * beside;
  EXPECT_EQ(find_attractors(hunting, options).cycles.at(0).stability, Stability::neutral);
}

TEST(SearchTolerances, IrregularMotion) {
  AttractorOptions open = few_starts();
  open.tolerances.cycle.residual = 0.0;  // nothing closes
  const AttractorSearch found = find_attractors(hunting, open);
  EXPECT_EQ(found.count(MotionEnd::irregular), 2U);
  EXPECT_EQ(found.irregular.size(), 1U);
  AttractorOptions strict = open;
  strict.tolerances.irregular.steadiness = 0.0;
  EXPECT_LT(find_attractors(hunting, strict).count(MotionEnd::irregular), 2U);
  strict = open;
  strict.tolerances.irregular.least_turns = 1000;
  EXPECT_EQ(find_attractors(hunting, strict).count(MotionEnd::undecided), 2U);
}

TEST(SearchTolerances, SwingsThatShrinkAreNotSteady) {
  AttractorOptions options = few_starts();
  options.tolerances.cycle.residual = 0.0;  // nothing closes
  options.starts = {{100.0, 0.0, 100.0, 0.0}};
  const ReducedDrive slow = servo_drive(1e-3, 1.0, 0.5);
  options.tolerances.irregular.steadiness = 0.1;
  EXPECT_EQ(find_attractors(slow, options).count(MotionEnd::undecided), 1U);
  EXPECT_EQ(find_attractors(slow, options).outcomes[0].reason.find("may still decay"),
            std::string::npos);
  options.tolerances.irregular.steadiness = 0.3;
  const AttractorSearch found = find_attractors(slow, options);
  EXPECT_EQ(found.count(MotionEnd::undecided), 1U);
  EXPECT_NE(found.outcomes[0].reason.find("may still decay"), std::string::npos);
}

TEST(SearchTolerances, ChosenStarts) {
  AttractorOptions options = few_starts();
  options.starts.clear();
  options.chosen_starts.most_steps = 2;
  const AttractorSearch found = find_attractors(hunting, options);
  ASSERT_EQ(found.outcomes.size(), 8U);  // three steps beside each face, two passings
  EXPECT_DOUBLE_EQ(found.outcomes[0].start.load_position, 1e-2 * 0.3);
  EXPECT_DOUBLE_EQ(found.outcomes[2].start.load_position, 1e2 * 0.3);
  options.chosen_starts.largest_step = 10.0;
  EXPECT_DOUBLE_EQ(find_attractors(hunting, options).outcomes[2].start.load_position, 10.0 * 0.3);
}

}  // namespace
}  // namespace gearlash::drive::search_tolerances_test
