// The progress of long work on a terminal, and the limits that stop it.
#include "terminal.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace gearlash::cli::terminal_test {
namespace {

constexpr double megabyte = 1e6;

TEST(TerminalProgress, StopsOnceTheProgramHasTakenMoreMemoryThanItMay) {
  if (!std::filesystem::exists("/proc/self/status")) GTEST_SKIP() << "needs /proc";
  TerminalProgress progress("Searching");
  EXPECT_TRUE(progress.go_on(0.0));
  progress.stop_above(1e6 * megabyte);
  EXPECT_TRUE(progress.go_on(0.1));
  progress.stop_above(0.5 * megabyte);
  EXPECT_FALSE(progress.go_on(0.2));
}

TEST(TerminalProgress, StopsAfterItsTime) {
  TerminalProgress progress("Searching");
  progress.stop_after(1e9);
  EXPECT_TRUE(progress.go_on(0.0));
  progress.stop_after(0.0);
  EXPECT_FALSE(progress.go_on(0.1));
}

}  // namespace
}  // namespace gearlash::cli::terminal_test
