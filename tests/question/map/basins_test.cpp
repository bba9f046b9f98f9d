// Basins of a drive that runs away beyond an unstable cycle, against motions simulated one by one.
#include "question/map/basins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/stopping.hpp"
#include "gearlash/motion.hpp"
#include "question/analyse.hpp"

namespace gearlash::basins_test {
namespace {

/// Integral action that its friction alone keeps from growing: it dies down from small starts and
/// runs away from large ones. The gap is far below both.
Drive friction_against_integral() {
  Drive drive;
  drive.motor = {.inertia = 1e-4, .friction = {.viscous = 2e-4, .coulomb = 0.01}};
  drive.gearbox = {.ratio = 50.0, .backlash = 2.9e-7};
  drive.load = {.inertia = 0.3, .friction = {.viscous = 0.05}};
  drive.controller.law =
      PID{.terms = PIDTerms::PID, .proportional = 2.0, .integral = 8.0, .derivative = 0.02};
  return drive;
}

double largest_error(const Motion& motion, double from, double to) {
  double largest = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const MotionSample sample = motion.at(from + (to - from) * i / 1000.0);
    largest = std::max(largest, std::abs(sample.shafts.load_position));
  }
  return largest;
}

/// Whether the motion from a start grows over its next ten swings, of 0.47 s each.
bool grows(const Drive& drive, double position, double speed) {
  const Motion motion = simulate(
      drive, {.until = 5.0, .start = Start{.load_position = position, .load_speed = speed}});
  return largest_error(motion, 4.5, 5.0) > largest_error(motion, 0.5, 1.0);
}

TEST(Basins, BorderSeparatesMotionsThatGrowFromThoseThatDieDown) {
  const Drive drive = friction_against_integral();
  const Analysis analysis = analyse_in_full(drive);
  ASSERT_EQ(analysis.answer.verdict, Verdict::runs_away_if_disturbed);
  const Basins basins = basins_of(analysis.reduced, *analysis.search,
                                  {.position = 0.15, .speed = 2.0, .columns = 7, .rows = 7});
  ASSERT_TRUE(basins.is_complete);
  EXPECT_TRUE(basins.has(BasinKind::rest));
  EXPECT_TRUE(basins.has(BasinKind::running_away));
  EXPECT_FALSE(basins.has(BasinKind::hunting));
  ASSERT_EQ(basins.borders.size(), 1U);
  const MapCurve& border = basins.borders.front();
  EXPECT_GT(border.size(), 8U);
  EXPECT_EQ(border.front(), border.back());
  for (std::size_t i = 0; i + 1 < border.size(); i += 2) {
    const MapPoint& place = border[i];
    EXPECT_FALSE(grows(drive, 0.95 * place.x, 0.95 * place.y)) << place.x << " " << place.y;
    EXPECT_TRUE(grows(drive, 1.1 * place.x, 1.1 * place.y)) << place.x << " " << place.y;
  }
}

TEST(Basins, MirroredPlaneIsItsOwnImage) {
  const Drive drive = friction_against_integral();
  const Analysis analysis = analyse_in_full(drive);
  const Basins basins = basins_of(analysis.reduced, *analysis.search,
                                  {.position = 0.15, .speed = 2.0, .columns = 5, .rows = 3});
  ASSERT_EQ(basins.kinds.size(), 15U);
  EXPECT_EQ(basins.kinds[7], BasinKind::rest);
  EXPECT_TRUE(std::equal(basins.kinds.begin(), basins.kinds.end(), basins.kinds.rbegin()));
}

TEST(Basins, StartsStandOnTheFaceThatIsPressed) {
  drive::ReducedDrive drive;
  drive.backlash = 0.2;
  drive.reference = 1.0;
  EXPECT_NEAR(start_on_face(drive, {}, 0.5, 0.0).load_position, 1.5, 1e-15);
  EXPECT_NEAR(start_on_face(drive, {}, 0.5, 0.0).motor_position, 1.4, 1e-15);
  EXPECT_NEAR(start_on_face(drive, {}, -0.5, 3.0).motor_position, 0.6, 1e-15);
  EXPECT_EQ(start_on_face(drive, {}, -0.5, 3.0).motor_speed, 3.0);
  const StartPlane of_motor{.is_of_motor = true};
  EXPECT_NEAR(start_on_face(drive, of_motor, 0.5, 0.0).motor_position, 1.5, 1e-15);
  EXPECT_NEAR(start_on_face(drive, of_motor, 0.5, 0.0).load_position, 1.6, 1e-15);
}

TEST(Basins, StoppedWorkIsIncomplete) {
  test::Stopping stop;
  const Analysis analysis = analyse_in_full(friction_against_integral());
  EXPECT_FALSE(basins_of(analysis.reduced, *analysis.search,
                         {.position = 0.15, .speed = 2.0, .columns = 3, .rows = 3}, stop)
                   .is_complete);
}

}  // namespace
}  // namespace gearlash::basins_test
