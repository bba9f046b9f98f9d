// A continuous controller on the edge of an encoder's count: refused before anything is computed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "gearlash/drive.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::encoder_edge_test {
namespace {

using testing::HasSubstr;

/// A count of 0.01 rad is 0.1 N m.
Drive counting_drive() {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 1.0};
  drive.gearbox.backlash = 0.05;
  drive.load = {.inertia = 1.0};
  drive.motor.friction.viscous = drive.load.friction.viscous = 0.1;
  drive.controller.law = PID{.terms = PIDTerms::PD, .proportional = 10.0, .derivative = 1.0};
  drive.sensor.encoder.resolution = 0.01;
  return drive;
}

TEST(EncoderEdge, OfAContinuousControllerIsRefused) {
  const std::vector<Fault> found = faults(counting_drive());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].path, "sensor.resolution");
  EXPECT_THAT(found[0].permitted, HasSubstr("must stand beside [sampling]"));
  EXPECT_THAT(found[0].permitted, HasSubstr("would switch without end at the edge of a count"));
  EXPECT_THAT(found[0].permitted, HasSubstr("changes by 0.1 N m at the load and friction holds 0"));
}

TEST(EncoderEdge, IsHeldByFrictionOrReadByAComputer) {
  Drive drive = counting_drive();
  drive.motor.friction.coulomb = 0.03;
  drive.load.friction.coulomb = 0.019;
  EXPECT_EQ(faults(drive).size(), 1U);  // half of the torque's change is 0.05
  drive.load.friction.coulomb = 0.021;
  EXPECT_TRUE(faults(drive).empty());
  drive = counting_drive();
  drive.sampling = Sampling{.period = 1e-3};
  EXPECT_TRUE(faults(drive).empty());
}

TEST(EncoderCounts, MeasureADeadBandThatIsAWholeNumberOfThem) {
  Drive drive = counting_drive();
  drive.sampling = Sampling{.period = 1e-3};
  drive.sensor = {.position = SensorPlace::motor, .encoder = {.counts_per_turn = 12.0}};
  constexpr double degree = std::numbers::pi / 180.0;
  for (const double ratio : {3.0, 7.0, 49.0, 100.0, 190.0, 343.0}) {
    drive.gearbox.ratio = ratio;
    for (int counts = 1; counts < 100; ++counts) {
      drive.controller.dead_band.width = counts * (30.0 / ratio) * degree;
      const drive::ReducedDrive reduced = reduce(drive);
      EXPECT_EQ(reduced.error_shape.begins, counts * reduced.sensing.resolution) << ratio;
      EXPECT_EQ(reduced.error_shape.ends, reduced.error_shape.begins) << ratio;
      EXPECT_EQ(reduced.error_shape.offset, -reduced.error_shape.begins) << ratio;
    }
    const double width = 2.00001 * (30.0 / ratio) * degree;
    drive.controller.dead_band.width = width;
    EXPECT_EQ(reduce(drive).error_shape.begins, width) << ratio;
  }
}

TEST(EncoderCounts, HaveFortyBitsAtMost) {
  Drive drive = counting_drive();
  drive.sampling = Sampling{.period = 1e-3};
  const auto fault_of = [&](Encoder Sensor::*place, const Encoder& encoder) {
    Drive other = drive;
    other.sensor.*place = encoder;
    const std::vector<Fault> found = faults(other);
    return found.empty() ? std::string("none") : found[0].path + " " + found[0].permitted;
  };
  const std::string counts = "must be at most 1099511627776, 40 bit";
  EXPECT_EQ(fault_of(&Sensor::encoder, {.counts_per_turn = 0x1p40}), "none");
  EXPECT_EQ(fault_of(&Sensor::encoder, {.counts_per_turn = 0x1p40 + 1.0}),
            "sensor.counts_per_turn " + counts);
  EXPECT_EQ(fault_of(&Sensor::speed_encoder, {.counts_per_turn = 1e300}),
            "sensor.speed_counts_per_turn " + counts);
  EXPECT_EQ(fault_of(&Sensor::encoder, {.resolution = 6e-12}), "none");
  EXPECT_THAT(fault_of(&Sensor::encoder, {.resolution = 5e-12}),
              testing::StartsWith("sensor.resolution must be 0 or at least 5.7"));
  EXPECT_THAT(fault_of(&Sensor::speed_encoder, {.resolution = 1e-300}),
              testing::StartsWith("sensor.speed_resolution must be 0 or at least 5.7"));
}

}  // namespace
}  // namespace gearlash::encoder_edge_test
