// From which start a searched drive is shown over time.
#include "picture/attractor_picture.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "model/reduced_drive.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::attractor_picture_test {
namespace {

using drive::MotionEnd;

/// The load's position in the first moment of the picture.
double shown_start(const std::vector<drive::Outcome>& outcomes) {
  const Drive drive = pd_drive();
  drive::AttractorSearch search;
  search.outcomes = outcomes;
  search.swing_time = 0.1;
  const MotionPicture picture = hunting_picture("title", drive, reduce_settled(drive), search);
  return picture.motions.at(0).motion.at(0.0).shafts.load_position;
}

drive::Outcome at_rest(double position, MotionEnd end) {
  drive::Outcome outcome;
  outcome.start.motor_position = outcome.start.load_position = position;
  outcome.end = end;
  return outcome;
}

TEST(HuntingPicture, OfADriveThatRestsBeginsAtTheMiddleStart) {
  drive::Outcome passing = at_rest(0.4, MotionEnd::rest);
  passing.start.load_speed = 1.0;
  EXPECT_EQ(shown_start({at_rest(-9.0, MotionEnd::rest), at_rest(1e-3, MotionEnd::rest), passing,
                         at_rest(0.5, MotionEnd::rest)}),
            0.5);
}

TEST(HuntingPicture, OfADriveThatRunsAwayBeginsWhereItDoes) {
  EXPECT_EQ(shown_start({at_rest(0.25, MotionEnd::diverges), at_rest(0.5, MotionEnd::rest)}), 0.25);
}

}  // namespace
}  // namespace gearlash::attractor_picture_test
