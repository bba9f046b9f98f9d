// Drives beside each other on a grid, followed from neighbour to neighbour.
#include "question/family/followed_drives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "gearlash/analyse.hpp"
#include "question/axis.hpp"
#include "question/map/grid_pieces.hpp"
#include "question/map/servo_grids.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::followed_drives_test {
namespace {

/// From rest to hunting.
Axis gains(std::size_t count) {
  return spaced_axis("x", "controller.proportional", 2.0, 6.0, count, Spacing::logarithmic);
}

std::vector<SoundDrive> drives_of(const Axis& axis) {
  std::vector<SoundDrive> drives;
  for (const double value : axis.values) {
    Drive drive = pd_drive();
    set_on(axis, drive, value);
    drives.emplace_back(std::move(drive));
  }
  return drives;
}

TEST(OracleFollowedDrives, HaveTheAnswersOfTheirOwnSearches) {
  const std::vector<SoundDrive> drives = drives_of(gains(24));
  std::vector<Answer> answers(drives.size());
  std::vector<int> times(drives.size());
  search_run(
      drives, {.proofs = false},
      [&](std::size_t index, const Answer& answer) {
        ++times[index];
        answers[index] = answer;
        return true;
      },
      no_progress());
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), 24);
  std::size_t hunting = 0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const Answer own = analyse(drives[i].given());
    EXPECT_EQ(answers[i].verdict, own.verdict) << i;
    const double amplitude = own.value(Quantity::amplitude).value();
    EXPECT_NEAR(answers[i].value(Quantity::amplitude).value(), amplitude, 1e-9 * amplitude) << i;
    hunting += amplitude > 0.0 ? 1 : 0;
  }
  EXPECT_GT(hunting, 3U);  // both kinds are there
  EXPECT_LT(hunting, 21U);
}

/// A search watches many starts, following few.
TEST(FollowedDrives, AreSearchedAfreshWhereTheirKindChanges) {
  const std::vector<SoundDrive> drives = drives_of(gains(24));
  std::vector<bool> is_afresh(drives.size());
  std::vector<Verdict> verdicts(drives.size());
  search_run(
      drives, {.proofs = false},
      [&](std::size_t index, const Answer& answer) {
        is_afresh[index] = !answer.search || answer.search->starts.size() > 10;
        verdicts[index] = answer.verdict;
        return true;
      },
      no_progress());
  EXPECT_TRUE(is_afresh[0]);
  EXPECT_TRUE(is_afresh[23]);
  for (std::size_t i = 1; i < drives.size(); ++i) {
    if (verdicts[i] == verdicts[i - 1]) continue;
    EXPECT_TRUE(is_afresh[i]) << i;
    EXPECT_TRUE(is_afresh[i - 1]) << i;
  }
  EXPECT_LE(std::count(is_afresh.begin(), is_afresh.end(), true), 16);
}

TEST(FollowedDrives, HaveTheSameAnswersInPiecesOfAGrid) {
  const Grid grid{.drive = pd_drive(),
                  .axes = {spaced_axis("y", "gearbox.backlash", 1e-3, 2e-3, 2, Spacing::linear),
                           gains(longest_run + 5)}};
  const std::vector quantities = {Quantity::amplitude, Quantity::period};
  const Table whole = evaluate(grid, quantities);
  std::size_t next = 0;
  evaluate_in_pieces(grid, quantities, 0, longest_run, [&](const GridPiece& piece) {
    for (std::size_t row = 0; row < piece.table.rows(); ++row, ++next) {
      EXPECT_EQ(piece.table.verdict(row), whole.verdict(next)) << next;
      for (const Quantity quantity : quantities) {
        EXPECT_EQ(std::memcmp(&piece.table[quantity][row], &whole[quantity][next], sizeof(double)),
                  0)
            << next;
      }
    }
  });
  EXPECT_EQ(next, grid.size());
}

TEST(EdgeFollowedDrives, StopWhenAsked) {
  const std::vector<SoundDrive> drives = drives_of(gains(8));
  std::size_t taken = 0;
  search_run(
      drives, {.proofs = false}, [&](std::size_t, const Answer&) { return ++taken < 3; },
      no_progress());
  EXPECT_EQ(taken, 3U);
  search_run(
      {}, {}, [](std::size_t, const Answer&) { return true; }, no_progress());
}

}  // namespace
}  // namespace gearlash::followed_drives_test
