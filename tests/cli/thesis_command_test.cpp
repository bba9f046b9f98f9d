// gearlash thesis, as typed.
#include <gmock/gmock.h>

#include "tool.hpp"

namespace gearlash {
namespace {

using test::Outcome;
using test::run_tool;
using testing::HasSubstr;

TEST(ThesisCommand, TableTwoStandsBesideThePrintoutOf1960) {
  const Outcome run = run_tool({"thesis", "table-2"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\n80000000- 1  77040631- 1  30333708- 2  68901844- 1  "
                                 "30007982- 2     79999999- 1  77040630- 1  30333708- 2  "
                                 "68901844- 1  30007982- 2\n"));
  EXPECT_THAT(run.out, HasSubstr("188 are within one unit of the eighth digit.\n"));
}

TEST(ThesisCommand, TheMachinesArithmeticGivesItsDigits) {
  const Outcome run = run_tool({"thesis", "table-2", "--arithmetic", "1604"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\n189 of 190 numbers have the digits of 1960; 190 are within"));
}

TEST(ThesisCommand, RunTellsWhatTheProgramWouldHaveGivenAndTheTruth) {
  const Outcome run = run_tool(
      {"thesis", "run", "--damping", "0.1", "--inertia-ratio", "1", "--friction-ratio", "0.2"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\n  size    ±0.51"));
  EXPECT_THAT(run.out, HasSubstr("\n  size    ±0.497055172 rad\n"));
  EXPECT_THAT(run.out, HasSubstr("off by +2."));
}

TEST(ThesisCommand, RunSaysWhereTheFacesMeetNoMore) {
  const Outcome run = run_tool(
      {"thesis", "run", "--damping", "0.9", "--inertia-ratio", "1", "--friction-ratio", "0.5"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("the faces meet no more"));
  EXPECT_THAT(run.out, HasSubstr("no limit cycle: cannot hunt"));
}

TEST(ThesisCommand, FaultsAreOneLine) {
  const Outcome subcommand = run_tool({"thesis", "table-9"});
  EXPECT_EQ(subcommand.status, 2);
  EXPECT_EQ(subcommand.err,
            "gearlash: subcommand = table-9: must be table-2 or run; see gearlash thesis --help\n");
  const Outcome none = run_tool({"thesis"});
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(
      none.err,
      "gearlash: subcommand is missing: must be table-2 or run; see gearlash thesis --help\n");
  const Outcome arithmetic = run_tool({"thesis", "table-2", "--arithmetic", "decimal"});
  EXPECT_EQ(arithmetic.status, 2);
  EXPECT_EQ(arithmetic.err, "gearlash: --arithmetic = decimal: must be double or 1604\n");
  const Outcome massless = run_tool(
      {"thesis", "run", "--damping", "0.1", "--inertia-ratio", "inf", "--friction-ratio", "0.2"});
  EXPECT_EQ(massless.status, 2);
  EXPECT_EQ(massless.err,
            "gearlash: inertia_ratio = inf: must be from 1e-9 to 1e9: the program of 1960 divides "
            "by both inertias\n");
}

}  // namespace
}  // namespace gearlash
