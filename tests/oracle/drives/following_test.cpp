// The library's answers beside its own exact motions, followed for longer than the search did.
#include "following.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "gearlash/analyse.hpp"
#include "random_drive.hpp"

namespace gearlash::oracle::following_test {
namespace {

std::string text_of(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

/// One drive of each kind that is followed within a second; score_drives --follow follows many.
TEST(PropertyFollowed, StartsDoForLongerWhatTheAnswerSays) {
  for (const auto& [kind, seed] :
       {std::pair{DriveKind::filtered_cascade, 4U}, std::pair{DriveKind::weight_at_limit, 2U},
        std::pair{DriveKind::state_space, 2U}, std::pair{DriveKind::moving_reference, 2U},
        std::pair{DriveKind::two_rates, 1U}, std::pair{DriveKind::industrial, 6U}}) {
    const Drive drive = random_drive(seed, kind);
    const Answer answer = analyse(drive, {.proofs = false});
    const FollowedDrive followed = follow_all(drive, answer, {.most_events = 100'000});
    EXPECT_TRUE(followed.contradictions.empty()) << "seed " << seed << "\n"
                                                 << text_of(followed.contradictions);
    EXPECT_GT(followed.starts + followed.cut_short, 20U) << "seed " << seed;
  }
}

/// 20 rests with its faces together until it is disturbed; 345 has chaotic transients that end in
/// its only cycle.
TEST(PropertyFollowed, DrivesWithoutFrictionDoForLongerWhatTheAnswerSays) {
  for (const std::uint64_t seed : {1U, 20U, 345U}) {
    const Drive drive = frictionless_drive(seed);
    const Answer answer = analyse(drive, {.proofs = false});
    EXPECT_EQ(answer.rests_engaged, seed == 20U) << "seed " << seed;
    EXPECT_EQ(answer.irregular.size(), 0U) << "seed " << seed;
    const FollowedDrive followed = follow_all(drive, answer);
    EXPECT_TRUE(followed.contradictions.empty()) << "seed " << seed << "\n"
                                                 << text_of(followed.contradictions);
  }
}

/// What follow_all finds where an answer is made wrong.
TEST(Followed, ContradictsAWrongAnswer) {
  const Drive hunting = frictionless_drive(1);
  Answer answer = analyse(hunting, {.proofs = false});
  ASSERT_EQ(answer.cycles.size(), 1U);
  const std::size_t all = answer.search->starts.size();
  answer.cycles[0].amplitude *= 1.5;
  EXPECT_EQ(follow_all(hunting, answer).contradictions.size(), all);
  answer.cycles[0].amplitude /= 1.5;  // the right motion is listed, and yet no start rests
  for (StartOutcome& start : answer.search->starts) start.end = "rest";
  answer.rest = Rest{.time = TimeToRest{.band = 0.01 * hunting.gearbox.backlash}};
  EXPECT_EQ(follow_all(hunting, answer).contradictions.size(), all);

  const Drive resting = random_drive(4, DriveKind::filtered_cascade);
  answer = analyse(resting, {.proofs = false});
  const FollowedDrive right = follow_all(resting, answer);
  EXPECT_TRUE(right.contradictions.empty()) << text_of(right.contradictions);
  ASSERT_GT(right.times, 10U);
  for (StartOutcome& start : answer.search->starts) {
    if (start.time_to_rest) *start.time_to_rest *= 1.05;
  }
  EXPECT_EQ(follow_all(resting, answer).contradictions.size(), right.times);
}

/// A P controller against the dry friction of a known drive: the ends of its rest are by hand.
TEST(Followed, ContradictsWrongEndsOfRest) {
  Drive drive;
  drive.motor = {.inertia = 0.01, .friction = {.viscous = 0.2, .coulomb = 0.3}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.02};
  drive.load = {.inertia = 0.01, .friction = {.viscous = 0.2, .coulomb = 0.1}};
  drive.controller = {PID{.terms = PIDTerms::PD, .proportional = 10.0, .derivative = 0.5}};
  Answer answer = analyse(drive, {.proofs = false});
  ASSERT_TRUE(answer.rest);
  ASSERT_EQ(answer.rest->pieces.size(), 1U);
  EXPECT_NEAR(answer.rest->pieces[0].load.high, 0.04, 1e-12);
  EXPECT_EQ(follow_all(drive, answer).pieces, 1U);
  EXPECT_TRUE(follow_all(drive, answer).contradictions.empty());
  answer.rest->pieces[0].load.high = 0.042;  // leaves from there
  EXPECT_EQ(follow_all(drive, answer).contradictions.size(), 1U);
  answer.rest->pieces[0].load.high = 0.036;  // stays 1 % beyond it
  EXPECT_EQ(follow_all(drive, answer).contradictions.size(), 1U);
}

}  // namespace
}  // namespace gearlash::oracle::following_test
