// The progress of long work on a terminal, and the limits that stop it.
#include "terminal.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

namespace gearlash::cli::terminal_test {
namespace {

constexpr double megabyte = 1e6;

bool goes_on(LimitedWork& work) { return TerminalProgress(work, "Searching").go_on(0.1); }

TEST(LimitedWork, StopsOnceTheProgramHasTakenMoreMemoryThanItMay) {
  if (!std::filesystem::exists("/proc/self/status")) GTEST_SKIP() << "needs /proc";
  LimitedWork much({.bytes = 1e6 * megabyte});
  EXPECT_TRUE(goes_on(much));
  LimitedWork little({.bytes = 0.5 * megabyte});
  EXPECT_FALSE(goes_on(little));
  EXPECT_EQ(little.why(), "--memory-limit");
}

TEST(LimitedWork, StopsAfterItsTime) {
  LimitedWork long_work({.seconds = 1e300});
  EXPECT_TRUE(goes_on(long_work));
  LimitedWork none({.seconds = 0.0});
  EXPECT_FALSE(goes_on(none));
  EXPECT_EQ(none.why(), "--time-limit");
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
}  // namespace gearlash::cli::terminal_test
