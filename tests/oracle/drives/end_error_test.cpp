// The error in the end of random drives, beside the fixed-step simulator and rest that stays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "drive_score.hpp"
#include "ending.hpp"
#include "following.hpp"
#include "gearlash/analyse.hpp"
#include "plain_drive.hpp"
#include "random_drive.hpp"

namespace gearlash::oracle::end_error_test {
namespace {

ShaftReadings readings_of(const StartOutcome& start) {
  return {.motor_position = start.motor_position,
          .motor_speed = start.motor_speed,
          .load_position = start.load_position,
          .load_speed = start.load_speed};
}

/// What was compared, and what differed.
struct Compared {
  std::size_t cycles = 0;
  std::size_t irregular = 0;
  std::size_t elsewhere = 0;  ///< motions that are others in the simulator
  std::size_t pieces = 0;
  std::string differences{};
};

/// The first start that leads to each motion is followed ten times longer than the search did.
void compare_motions(const Drive& drive, const Answer& answer, const std::string& name,
                     Compared& all) {
  const PlainDrive plain = settled(plain_drive(drive));
  const auto compare = [&](const char* end, std::size_t which, double amplitude, double error,
                           double share) {
    const auto& starts = answer.search->starts;
    const auto start = std::find_if(starts.begin(), starts.end(), [&](const StartOutcome& one) {
      return one.end == end && one.which == which;
    });
    if (start == starts.end()) return false;
    constexpr double longest = 200.0;  // s
    const double from = std::min(longest, 10.0 * start->watched);
    const double until = from + std::min(longest, 5.0 * start->watched);
    const bool is_cycle = std::string(end) == "cycle";
    const Extremes seen = extremes_between(plain, readings_of(*start), from, until);
    // A start may lead to another motion of the list, by a rounding; drive_score_test judges that.
    const double same = is_cycle ? 0.01 : 0.2;
    if (std::abs(seen.load.amplitude() - amplitude) > same * amplitude) {
      ++all.elsewhere;
      return false;
    }
    const double simulated =
        is_cycle ? std::max(std::abs(seen.error.low), std::abs(seen.error.high))
                 : error_exceeded_for(1e-3, plain, readings_of(*start), from, until);
    // Motion of few encoder steps goes on beside the reference, within a step of where it began.
    const double least = is_cycle ? 0.0 : plain.step;
    if (std::abs(simulated - error) > share * simulated + least) {
      all.differences += name + ": " + end + " " + std::to_string(which) + ": error " +
                         std::to_string(1e6 * error) + " µrad, simulated " +
                         std::to_string(1e6 * simulated) + "\n";
    }
    return true;
  };
  for (std::size_t i = 0; i < answer.cycles.size(); ++i) {
    constexpr double periodic = 0.01;
    if (compare("cycle", i, answer.cycles[i].amplitude, answer.cycles[i].error, periodic))
      ++all.cycles;
  }
  for (std::size_t i = 0; i < answer.irregular.size(); ++i) {
    const double irregular = ScoreOptions{}.irregular_share;  // its extremes scatter
    if (answer.irregular[i].is_motor_alone) continue;  // its load may stand anywhere in the gap
    const IrregularMotion& motion = answer.irregular[i];
    if (compare("irregular", i, motion.amplitude, motion.error, irregular)) ++all.irregular;
  }
}

/// GEARLASH_ERRORS=200 asks for as many drives.
TEST(OracleEndError, IsThatOfLongSimulationsAndOfRestThatStays) {
  const char* asked_for = std::getenv("GEARLASH_ERRORS");
  const std::uint64_t count = asked_for == nullptr ? 20 : std::strtoull(asked_for, nullptr, 10);
  constexpr DriveKind kinds[] = {DriveKind::industrial, DriveKind::filtered_cascade,
                                 DriveKind::state_space, DriveKind::without_integral};
  Compared all;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t seed = 4600 + i / 5;
    const bool is_frictionless = i % 5 == 4;
    const Drive drive =
        is_frictionless ? frictionless_drive(seed) : random_drive(seed, kinds[i % 5]);
    const std::string name = "kind " + std::to_string(i % 5) + ", seed " + std::to_string(seed);
    const Answer answer = analyse(drive, {.proofs = false, .borders = false});
    if (!answer.search) continue;
    compare_motions(drive, answer, name, all);
    const FollowedDrive rest = follow_pieces(drive, answer);
    all.pieces += rest.pieces;
    for (const std::string& one : rest.contradictions) all.differences += name + ": " + one + "\n";
    // The quantity is the largest of what was compared.
    const std::optional<double> error = answer.value(Quantity::error);
    if (error && answer.verdict == Verdict::comes_to_rest) {
      EXPECT_EQ(*error, answer.value(Quantity::static_error)) << name;
    }
  }
  EXPECT_EQ(all.differences, "");
  EXPECT_GT(all.cycles + all.irregular, all.elsewhere);
  EXPECT_GT(all.pieces, count / 10);
  std::printf("%zu cycles, %zu irregular motions, %zu that are others, %zu pieces of rest\n",
              all.cycles, all.irregular, all.elsewhere, all.pieces);
}

}  // namespace
}  // namespace gearlash::oracle::end_error_test
