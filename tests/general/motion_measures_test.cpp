// What is measured of a motion.
#include "general/attractors/motion_measures.hpp"

#include <gtest/gtest.h>

#include "drives.hpp"

namespace gearlash::drive::motion_measures_test {
namespace {

/// Late in a long motion, events that follow each other have the same time.
TEST(MotionMeasures, OfSamplesOfOneTimeArePassingsAtThatTime) {
  const ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  const DriveSystem system = drive_system(drive);
  const Eigen::Index size = system.system.size();
  const auto number = [&](Eigen::Index which) {
    return hybrid::AffineForm{.normal = hybrid::Vector::Unit(size, which)};
  };
  const Watched load = watched(system.system, number(load_position), number(load_speed));
  const hybrid::Trajectory motion = hybrid::simulate(
      system.system, drive_start(drive, system, {.motor_position = 1.0, .load_position = 1.0}),
      {.until = 10.0});
  std::vector<Sample> of_load = samples(motion, load);
  const double middle = extent_of(of_load).middle();
  const std::vector<double> passings = upward_passings(motion, load, of_load, middle, 0.0);
  ASSERT_FALSE(passings.empty());
  EXPECT_NEAR(motion.at(passings[0]).numbers[load_position], middle, 1e-9);
  of_load = {{1.0, middle - 1.0}, {1.0, middle + 1.0}};
  EXPECT_EQ(upward_passings(motion, load, of_load, middle, 0.0), std::vector<double>{1.0});
}

}  // namespace
}  // namespace gearlash::drive::motion_measures_test
