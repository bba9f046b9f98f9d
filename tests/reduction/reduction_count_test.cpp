// A drive is reduced to the load's shaft once, however much is asked of it. This program counts:
// the linker leads the calls here that one room makes of another (--wrap).
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <optional>
#include <vector>

#include "gearlash/analyse.hpp"
#include "gearlash/design.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/tolerance.hpp"
#include "general/attractors/attractors.hpp"
#include "general/attractors/search_setting.hpp"
#include "model/reduced_drive.hpp"
#include "question/map/bifurcations.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::reduction_count_test {
namespace {

std::atomic<std::size_t> reductions{0};
std::atomic<std::size_t> drives{0};  // that were searched, or on which a cycle was followed
thread_local bool is_searching = false;

/// A search sets itself up.
struct Searching {
  Searching() { is_searching = true; }
  Searching(const Searching&) = delete;
  Searching& operator=(const Searching&) = delete;
  ~Searching() { is_searching = false; }
};

using drive::AttractorOptions;
using drive::AttractorSearch;
using drive::IsEnough;
using drive::ReducedDrive;
using drive::SearchSetting;
using drive::StartTolerances;

}  // namespace

// The functions of the library, and those that stand in their place, by the names of the linker.
#define GEARLASH_REAL(name) __asm__("__real_" name)
#define GEARLASH_COUNTED(name) __asm__("__wrap_" name)
#define GEARLASH_REDUCE "_ZN8gearlash6reduceERKNS_5DriveE"
#define GEARLASH_SETTING \
  "_ZN8gearlash5drive14search_settingERKNS0_14ReducedDriveOfIdEERKNS0_15StartTolerancesE"
#define GEARLASH_FIND                                                    \
  "_ZN8gearlash5drive15find_attractorsERKNS0_14ReducedDriveOfIdEERKNS0_" \
  "16AttractorOptionsERNS_8ProgressE"
#define GEARLASH_FOLLOW                                                    \
  "_ZN8gearlash5drive17follow_attractorsERKNS0_14ReducedDriveOfIdEERKNS0_" \
  "15AttractorSearchERNS_8ProgressERKSt8functionIFbS7_EERKNS0_16AttractorOptionsE"
#define GEARLASH_CYCLES \
  "_ZN8gearlash5drive13follow_cyclesERKNS0_14ReducedDriveOfIdEERKNS0_15AttractorSearchE"

ReducedDrive real_reduce(const Drive& drive) GEARLASH_REAL(GEARLASH_REDUCE);
ReducedDrive counted_reduce(const Drive& drive) GEARLASH_COUNTED(GEARLASH_REDUCE);
ReducedDrive counted_reduce(const Drive& drive) {
  ++reductions;
  return real_reduce(drive);
}

SearchSetting real_setting(const ReducedDrive& drive, const StartTolerances& tolerances)
    GEARLASH_REAL(GEARLASH_SETTING);
SearchSetting counted_setting(const ReducedDrive& drive, const StartTolerances& tolerances)
    GEARLASH_COUNTED(GEARLASH_SETTING);
SearchSetting counted_setting(const ReducedDrive& drive, const StartTolerances& tolerances) {
  if (!is_searching) ++drives;
  return real_setting(drive, tolerances);
}

AttractorSearch real_find(const ReducedDrive& drive, const AttractorOptions& options,
                          Progress& progress) GEARLASH_REAL(GEARLASH_FIND);
AttractorSearch counted_find(const ReducedDrive& drive, const AttractorOptions& options,
                             Progress& progress) GEARLASH_COUNTED(GEARLASH_FIND);
AttractorSearch counted_find(const ReducedDrive& drive, const AttractorOptions& options,
                             Progress& progress) {
  ++drives;
  const Searching searching;
  return real_find(drive, options, progress);
}

std::optional<AttractorSearch> real_follow(const ReducedDrive& drive, const AttractorSearch& near,
                                           Progress& progress, const IsEnough& suffices,
                                           const AttractorOptions& options)
    GEARLASH_REAL(GEARLASH_FOLLOW);
std::optional<AttractorSearch> counted_follow(const ReducedDrive& drive,
                                              const AttractorSearch& near, Progress& progress,
                                              const IsEnough& suffices,
                                              const AttractorOptions& options)
    GEARLASH_COUNTED(GEARLASH_FOLLOW);
std::optional<AttractorSearch> counted_follow(const ReducedDrive& drive,
                                              const AttractorSearch& near, Progress& progress,
                                              const IsEnough& suffices,
                                              const AttractorOptions& options) {
  const Searching searching;
  std::optional<AttractorSearch> found = real_follow(drive, near, progress, suffices, options);
  if (found) ++drives;  // else it is searched
  return found;
}

AttractorSearch real_cycles(const ReducedDrive& drive, const AttractorSearch& near)
    GEARLASH_REAL(GEARLASH_CYCLES);
AttractorSearch counted_cycles(const ReducedDrive& drive, const AttractorSearch& near)
    GEARLASH_COUNTED(GEARLASH_CYCLES);
AttractorSearch counted_cycles(const ReducedDrive& drive, const AttractorSearch& near) {
  ++drives;
  const Searching searching;
  return real_cycles(drive, near);
}

namespace {

struct Count {
  std::size_t reductions = 0;
  std::size_t drives = 0;
};

template <class Work>
Count count_of(const Work& work) {
  const Count before{reductions, drives};
  work();
  const Count count{reductions - before.reductions, drives - before.drives};
  testing::Test::RecordProperty("reductions", static_cast<int>(count.reductions));
  testing::Test::RecordProperty("drives", static_cast<int>(count.drives));
  return count;
}

/// Drives that are reduced without being searched: the question's own, as it is checked, and those
/// at the corners of its axes.
constexpr std::size_t of_the_question = 3;
constexpr std::size_t corners_of_one_axis = 4;

Axis gains(std::size_t count) { return logarithmic("controller.proportional", 1.0, 8.0, count); }

TEST(Reductions, AreOneForADriveOfWhichAllIsAsked) {
  Drive drive = pd_drive();
  drive.load.gravity = 1e-3;
  drive.reference = StepSignal{.after = 0.1};
  const Count count =
      count_of([&] { (void)analyse(drive, {.ceiling = true, .loop = true, .step = true}); });
  EXPECT_EQ(count.drives, 1U);
  EXPECT_EQ(count.reductions, 1U);
}

TEST(Reductions, AreOneForEachDriveOfAGrid) {
  const Grid grid{.drive = pd_drive(), .axes = {gains(24)}};
  const Count count = count_of([&] { (void)evaluate(grid, {Quantity::amplitude}); });
  EXPECT_EQ(count.drives, 24U);
  EXPECT_LE(count.reductions, count.drives + of_the_question + corners_of_one_axis);
}

/// Figures of a table are computed beside the searches, which may be stopped.
TEST(Reductions, AreOneMoreForTheFiguresOfATable) {
  const Grid grid{.drive = pd_drive(), .axes = {gains(12)}};
  const Count count = count_of([&] {
    (void)evaluate(grid, {Quantity::amplitude, Quantity::ceiling, Quantity::bandwidth});
  });
  EXPECT_EQ(count.drives, 12U);
  EXPECT_LE(count.reductions, 2 * count.drives + of_the_question + corners_of_one_axis);
}

TEST(Reductions, AreOneForEachDriveOfAList) {
  const std::vector<double> values = {2.0, 2.2, 4.0, 4.4, 1.0};
  const DriveList list{
      .drive = pd_drive(), .paths = {"controller.proportional"}, .values = {values}};
  const Count count =
      count_of([&] { (void)evaluate(list, std::vector<Quantity>{Quantity::amplitude}); });
  EXPECT_EQ(count.drives, values.size());
  EXPECT_LE(count.reductions, count.drives + of_the_question + 2 * corners_of_one_axis);
}

TEST(Reductions, AreOneForEachDriveOfADesign) {
  const Count count = count_of([] { (void)values(pd_drive(), gains(9), always_at_rest()); });
  EXPECT_GT(count.drives, 9U);
  // The ends of the grid are checked before.
  EXPECT_LE(count.reductions, count.drives + of_the_question + 2);
}

TEST(Reductions, AreOneForEachDriveOfMargins) {
  const std::vector<Axis> axes = {gains(9), logarithmic("gearbox.backlash", 1e-3, 4e-3, 5)};
  const Count count = count_of([&] { (void)margins(pd_drive(), axes); });
  EXPECT_GT(count.drives, 14U);
  EXPECT_LE(count.reductions, count.drives + (of_the_question + 2) * (axes.size() + 1));
}

TEST(Reductions, AreOneForEachDriveOfAProductionRun) {
  const TolerancedDrive drive{pd_drive(), {{"controller.proportional", UniformBetween{2.0, 6.0}}}};
  const Count count = count_of([&] {
    (void)study_tolerances(drive, {.points = 16, .replicates = 2}, {.target = always_at_rest()});
  });
  EXPECT_GE(count.drives, 32U);
  EXPECT_LE(count.reductions, count.drives + of_the_question + 4 * corners_of_one_axis);
}

TEST(Reductions, AreOneForEachDriveOfABifurcationDiagram) {
  const Count count = count_of([] { (void)bifurcations_of(pd_drive(), gains(5)); });
  EXPECT_GT(count.drives, 5U);
  EXPECT_LE(count.reductions, count.drives + of_the_question + corners_of_one_axis);
}

}  // namespace
}  // namespace gearlash::reduction_count_test
