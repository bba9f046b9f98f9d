// The library's answers about industrial drives against the fixed-step simulator.
#include "drive_score.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "random_drive.hpp"

namespace gearlash::oracle::drive_score_test {
namespace {

class OracleIndustrialDrive : public testing::TestWithParam<std::uint64_t> {};

/// Drives that the library decides within a second, of every kind of contact and controller, at
/// rest and hunting. score_drives compares many more.
TEST_P(OracleIndustrialDrive, EndsWhereTheSimulatorEnds) {
  const DriveScore score = score_of(random_drive(GetParam()), {.starts = 4});
  EXPECT_TRUE(score.is_decided());
  for (const ScoredStart& scored : score.starts) {
    EXPECT_TRUE(scored.agreement == Agreement::right ||
                scored.agreement == Agreement::right_as_it_fades)
        << "seed " << GetParam() << ", load at " << scored.start.load_position << ", motor at "
        << scored.start.motor_position << ": " << name_of(scored.agreement) << "; library "
        << scored.start.end << ", simulator " << name_of(scored.ending.kind) << ", amplitudes "
        << scored.amplitude << " and " << scored.ending.amplitude;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OracleIndustrialDrive,
                         testing::Values(3U, 12U, 43U, 47U, 49U, 52U, 53U, 57U, 75U));

TEST(OracleEndingsAgree, ByKindAndAmplitudesToAShareOrAnEncoderStep) {
  const PlainDrive drive{.step = 0.01};
  const Ending hunting{.kind = EndKind::hunts, .amplitude = 1.0, .motor_amplitude = 1.5};
  Ending other = hunting;
  other.amplitude = 1.015;
  EXPECT_TRUE(agree(hunting, other, drive, 0.02));
  other.amplitude = 1.03;
  EXPECT_FALSE(agree(hunting, other, drive, 0.02));
  const Ending small{.kind = EndKind::hunts, .amplitude = 0.004, .motor_amplitude = 0.004};
  Ending smaller = small;
  smaller.amplitude = 0.001;
  EXPECT_TRUE(agree(small, smaller, drive, 0.02));
  smaller.motor_amplitude = 0.02;
  EXPECT_FALSE(agree(small, smaller, drive, 0.02));
  EXPECT_FALSE(agree(hunting, {.kind = EndKind::rest}, drive, 0.02));
  EXPECT_TRUE(agree({.kind = EndKind::fades}, {.kind = EndKind::rest}, drive, 0.02));
  EXPECT_FALSE(agree({.kind = EndKind::unclear}, {.kind = EndKind::unclear}, drive, 0.02));
}

}  // namespace
}  // namespace gearlash::oracle::drive_score_test
