// The progress of long work on a terminal, and the limits that stop it.
#include "work.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

namespace gearlash::cli::work_test {
namespace {

constexpr double megabyte = 1e6;

bool goes_on(LimitedWork& work) { return TerminalProgress(work, "Searching").go_on(0.1); }

/// What stops work with these limits at once.
std::string what_stops(const Limits& limits) {
  LimitedWork work(limits);
  const bool is_going_on = goes_on(work);
  EXPECT_EQ(is_going_on, work.why().empty());
  return work.why();
}

TEST(LimitedWork, StopsOnceTheProgramHasTakenMoreMemoryThanItMay) {
  if (!std::filesystem::exists("/proc/self/status")) GTEST_SKIP() << "needs /proc";
  EXPECT_EQ(what_stops({.bytes = 1e6 * megabyte}), "");
  EXPECT_EQ(what_stops({.bytes = 0.5 * megabyte}), "--memory-limit");
}

TEST(LimitedWork, StopsAfterItsTime) {
  EXPECT_EQ(what_stops({.seconds = 1e300}), "");
  EXPECT_EQ(what_stops({.seconds = 0.0}), "--time-limit");
}

TEST(LimitedWork, StopsAtASignalAndStaysStopped) {
  LimitedWork work;
  EXPECT_TRUE(goes_on(work));
  EXPECT_FALSE(work.is_interrupted());
  std::raise(SIGTERM);
  EXPECT_TRUE(work.is_interrupted());
  EXPECT_FALSE(goes_on(work));
  EXPECT_FALSE(goes_on(work));
  EXPECT_EQ(work.why(), "a signal");
}

TEST(LimitedWork, EndsTheProgramByTheSignalOnceItsAnswerIsPrinted) {
  EXPECT_EXIT(
      {
        LimitedWork work;
        std::raise(SIGTERM);
        work.end();
      },
      testing::KilledBySignal(SIGTERM), "");
  EXPECT_EXIT(
      {
        LimitedWork work;
        work.end();
        std::raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace gearlash::cli::work_test
