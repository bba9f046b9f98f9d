// gearlash thesis, as typed.
#include <gmock/gmock.h>

#include <filesystem>

#include "tool.hpp"

namespace gearlash::thesis_command_test {
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

TEST(ThesisCommand, TheOneNumberLeftIsNamed) {
  EXPECT_THAT(run_tool({"thesis", "table-2", "--arithmetic", "1604"}).out,
              HasSubstr("\nline 1, motor speed: 77040631- 1 here, 77040630- 1 in 1960\n"));
}

TEST(ThesisCommand, MachinePrintsTheSameFromTheOctalWords) {
  const Outcome run = run_tool({"thesis", "machine"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\n189 of 190 numbers have the digits of 1960; 190 are within"));
  EXPECT_THAT(run.out, HasSubstr("\n174953 instructions were executed.\n"));
}

TEST(ThesisCommand, MachineShowsHowItsRulesWereFoundAndItsListing) {
  const std::string rules = run_tool({"thesis", "machine", "--rules"}).out;
  EXPECT_THAT(rules, testing::ContainsRegex("smaller operand cut off .* rounded +cut off +189\n"));
  EXPECT_THAT(rules, testing::ContainsRegex("exact sum, cut off +cut off +cut off +169\n"));
  EXPECT_THAT(rules, testing::ContainsRegex("exact sum, rounded +rounded +rounded +149\n"));
  EXPECT_THAT(run_tool({"thesis", "machine", "--listing"}).out,
              HasSubstr("  20103  listed     12 0 20074  15 0 20172\n"
                        "         assembled  12 0 20074  15 0 20167   LDA 0 BKTEST2 | SUB 0 "
                        "FACTOR2\n"));
}

TEST(ThesisCommand, TraceShowsRegistersAtEachInstruction) {
  const Outcome run = run_tool({"thesis", "machine", "--trace", "2"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\n  20000 U  SLJ  4 20022  0000000000000000 "));
  EXPECT_THAT(run.out, HasSubstr("\n  20022 L  SLJ  0 20022  0000000000000000 "));
  const Outcome none = run_tool({"thesis", "machine", "--trace", "0.5"});
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(none.err, "gearlash: --trace = 0.5: must be a whole number from 1 to 1000000\n");
}

TEST(ThesisCommand, RunTellsWhatTheProgramWouldHaveGivenAndTheTruth) {
  const Outcome run = run_tool(
      {"thesis", "run", "--damping", "0.1", "--inertia-ratio", "1", "--friction-ratio", "0.2"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\n  amplitude  ±0.51"));
  EXPECT_THAT(run.out, HasSubstr("\n  amplitude  ±0.497055172 rad\n"));
  EXPECT_THAT(run.out, HasSubstr("off by +2."));
}

TEST(ThesisCommand, RunSaysWhereTheFacesDoNotMeet) {
  const Outcome run = run_tool(
      {"thesis", "run", "--damping", "0.9", "--inertia-ratio", "1", "--friction-ratio", "0.5"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("for 100 s the faces have not met"));
  EXPECT_THAT(run.out, HasSubstr("no limit cycle: cannot hunt"));
}

TEST(ThesisCommand, RunSaysWhereTheStepIsTooLong) {
  for (const bool on_machine : {false, true}) {
    std::vector<std::string> words = {"thesis",          "run",  "--damping",        "0.2",
                                      "--inertia-ratio", "1000", "--friction-ratio", "0.2"};
    if (on_machine) words.emplace_back("--machine");
    const Outcome run = run_tool(words);
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("its step is too long for this servo"));
    EXPECT_THAT(run.out, HasSubstr("\n  amplitude  ±0.129299"));
    EXPECT_EQ(run.err, "");
  }
}

TEST(ThesisCommand, WhatThePropertiesDo) {
  const Outcome numbers = run_tool({"thesis", "table-2", "--properties"});
  EXPECT_EQ(numbers.status, 0);
  EXPECT_THAT(numbers.out,
              HasSubstr("  as it was                                             188\n"));
  EXPECT_THAT(numbers.out, HasSubstr("\n  1 mended: "));
  const Outcome causes = run_tool({"thesis", "run", "--causes"});
  EXPECT_EQ(causes.status, 0);
  EXPECT_THAT(causes.out,
              HasSubstr("\n  as it was                                               +2.80"));
}

TEST(ThesisCommand, OptionsThatWouldBeIgnoredAreRefused) {
  const auto refused = [](const std::vector<std::string>& words, const std::string& text) {
    const Outcome run = run_tool(words);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "gearlash: " + text + " --help\n");
  };
  refused({"thesis", "run", "--all", "--damping", "3"},
          "--damping excludes --all; see gearlash thesis run");
  refused({"thesis", "run", "--plot", "errors=a.svg"},
          "--plot requires --all; see gearlash thesis run");
  refused({"thesis", "run", "--causes", "--machine"},
          "--machine excludes --causes; see gearlash thesis run");
  refused({"thesis", "machine", "--rules", "--listing"},
          "--rules excludes --listing; see gearlash thesis machine");
  refused({"thesis", "table-2", "--properties", "--arithmetic", "1604"},
          "--arithmetic excludes --properties; see gearlash thesis table-2");
  refused({"thesis", "run", "a.toml", "b", "c"}, "not expected: b c; see gearlash thesis run");
}

TEST(ThesisCommand, FiguresAreWritten) {
  const test::Scratch scratch;
  const std::string file = (scratch / "phase.pdf").string();
  EXPECT_EQ(run_tool({"thesis", "figure", "13", "--output", file}).status, 0);
  EXPECT_GT(std::filesystem::file_size(file), 1000U);
  const std::string folder = (scratch / "figures" / "of 1960").string();
  EXPECT_EQ(run_tool({"thesis", "all", "--output", folder}).status, 0);
  for (int number = 2; number <= 15; ++number) {
    const auto figure =
        std::filesystem::path(folder) / ("figure-" + std::to_string(number) + ".svg");
    EXPECT_GT(std::filesystem::file_size(figure), 1000U) << number;
  }
}

TEST(ThesisCommand, ChartReadingFollowsTheFourSteps) {
  const Outcome run = run_tool({"thesis", "chart-reading", "--damping", ".19", "--inertia-ratio",
                                "2", "--friction-ratio", ".1", "--backlash", ".1"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("figure 7, for 0.1\n"));
  EXPECT_THAT(run.out, HasSubstr("\nExact: ±0.080537 rad; the reading is off by +"));
  EXPECT_THAT(run.out, HasSubstr("\n  the program's amplitudes  "));
  const Outcome resting = run_tool({"thesis", "chart-reading", "--damping", ".45",
                                    "--inertia-ratio", "2", "--friction-ratio", ".4"});
  EXPECT_EQ(resting.status, 0);
  EXPECT_THAT(resting.out, HasSubstr("the curve for 0.5 is absent (0);\n"));
  const Outcome outside = run_tool({"thesis", "chart-reading", "--damping", ".9", "--inertia-ratio",
                                    "20", "--friction-ratio", ".1"});
  EXPECT_EQ(outside.status, 2);
  EXPECT_EQ(outside.err,
            "gearlash: damping = 0.9: must be from 0.1 to 0.6\n"
            "gearlash: inertia_ratio = 20: must be from 1/9 to 9, where the charts of 1960 end\n");
}

TEST(ThesisCommand, ExtensionsAreDrawnAndSaidInWords) {
  const test::Scratch scratch;
  const std::string file = (scratch / "wide.svg").string();
  const Outcome run = run_tool({"thesis", "extension", "3", "--output", file});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("3. Extend the program to include a larger range"));
  EXPECT_GT(std::filesystem::file_size(file), 1000U);
  const Outcome five = run_tool({"thesis", "extension", "5"});
  EXPECT_EQ(five.status, 2);
  EXPECT_EQ(five.err,
            "gearlash: N = 5: must be 2, 3 or 4 (recommendation 1 is gearlash thesis run)\n");
}

TEST(ThesisCommand, AllRunsAreComparedWithTheExactAnswer) {
  const Outcome run = run_tool({"thesis", "run", "--all"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\n160 servos; "));
  EXPECT_THAT(run.out, HasSubstr("\nfriction ratio 0.04"));
  EXPECT_THAT(run.out, HasSubstr("\n  damping 0.6"));
  const test::Scratch scratch;
  const std::string map = (scratch / "map.svg").string();
  EXPECT_EQ(run_tool({"thesis", "run", "--all", "--plot", "errors=" + map}).status, 0);
  EXPECT_GT(std::filesystem::file_size(map), 1000U);
}

TEST(ThesisCommand, FiguresThereAre) {
  const Outcome run = run_tool({"thesis", "figure", "16"});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(
      run.err,
      "gearlash: N = 16: must be the number of a figure: 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, "
      "14 or 15\n");
}

TEST(ThesisCommand, FaultsAreOneLine) {
  const Outcome subcommand = run_tool({"thesis", "table-9"});
  EXPECT_EQ(subcommand.status, 2);
  EXPECT_EQ(subcommand.err,
            "gearlash: subcommand = table-9: must be table-2, machine, run, figure, chart-reading, "
            "extension or all (did you mean table-2?); see gearlash thesis --help\n");
  const Outcome none = run_tool({"thesis"});
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(none.err,
            "gearlash: subcommand is missing: must be table-2, machine, run, figure, "
            "chart-reading, extension or all; see gearlash thesis --help\n");
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
}  // namespace gearlash::thesis_command_test
