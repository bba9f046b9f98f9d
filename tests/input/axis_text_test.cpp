// Axes as they are typed on the command line.
#include "input/axis_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace gearlash {
namespace {

std::string fault(std::string_view text) {
  try {
    read_axis("--x", text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "none";
}

TEST(AxisText, IsReadInItsThreeForms) {
  EXPECT_EQ(read_axis("--x", "damping=0.1,0.2,1/2"), (Axis{Input::damping, {0.1, 0.2, 0.5}}));
  const Axis linear = read_axis("--x", "friction_ratio=0:1:5");
  EXPECT_EQ(linear, (Axis{Input::friction_ratio, {0.0, 0.25, 0.5, 0.75, 1.0}}));
  const Axis logarithmic = read_axis("--x", "inertia-ratio=1/9:9:3:log");
  EXPECT_EQ(logarithmic.input, Input::inertia_ratio);
  EXPECT_TRUE(logarithmic.logarithmic);
  EXPECT_THAT(logarithmic.values,
              testing::ElementsAre(1.0 / 9.0, testing::DoubleNear(1.0, 1e-15), 9.0));
}

TEST(AxisText, BacklashMayHaveItsUnit) {
  const Axis axis = read_axis("--x", "backlash=6 arcmin,1 deg");
  EXPECT_THAT(axis.values,
              testing::ElementsAre(testing::DoubleNear(std::numbers::pi / 1800, 1e-15),
                                   testing::DoubleNear(std::numbers::pi / 180, 1e-15)));
}

TEST(EdgeAxisText, EachFaultIsOneLine) {
  const std::string forms = "must be NAME=FROM:TO:COUNT, NAME=FROM:TO:COUNT:log or NAME=A,B,C";
  EXPECT_EQ(fault(""), "--x = \"\": " + forms);
  EXPECT_EQ(fault("damping"), "--x = damping: " + forms);
  EXPECT_EQ(fault("damping="), "--x = damping=: " + forms);
  EXPECT_EQ(fault("damping=1:2"), "--x = damping=1:2: " + forms);
  EXPECT_EQ(fault("damping=0.1:0.2:5:lin"), "--x = damping=0.1:0.2:5:lin: " + forms);
  EXPECT_EQ(fault("stiffness=1:2:3"),
            "--x = stiffness: must name an input: damping, inertia_ratio, friction_ratio, "
            "backlash or restitution");
  EXPECT_EQ(fault("damping=0.1:0.6:0"), "--x = 0 values: must be from 1 to 1000000");
  EXPECT_EQ(fault("damping=0.1:0.6:1000000000000"),
            "--x = 1000000000000 values: must be from 1 to 1000000");
  EXPECT_EQ(fault("damping=0.1:0.6:-3"),
            "--x = -3: must be a count, a whole number from 1 to 1000000");
  EXPECT_EQ(fault("damping=0.6:0.1:5:log"), "--x = 0.6 to 0.1: must rise: the smaller value first");
  EXPECT_EQ(fault("inertia-ratio=0:9:5:log"), "--x = 0: must be positive on a logarithmic axis");
  EXPECT_EQ(fault("friction-ratio=0.5,1.5"), "--x = 1.5: friction_ratio must be from 0 to 1");
  EXPECT_THAT(fault("damping=0.1,,0.3"), testing::StartsWith("--x = \"\": must be"));
}

}  // namespace
}  // namespace gearlash
