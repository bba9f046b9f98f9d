// The library's answers about industrial drives against the fixed-step simulator.
#include "drive_score.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "random_drive.hpp"

namespace gearlash::oracle {
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

}  // namespace
}  // namespace gearlash::oracle
