// README.md and docs/command-line.md show what the program prints and draws today.
#include "tool.hpp"

namespace gearlash {
namespace {

TEST(Readme, ShowsWhatTheToolPrintsNow) {
  const test::Outcome run = test::run_shell("scripts/readme --check --tool \"$GEARLASH\"");
  EXPECT_EQ(run.status, 0) << run.err;
}

}  // namespace
}  // namespace gearlash
