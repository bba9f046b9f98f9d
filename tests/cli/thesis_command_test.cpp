// gearlash thesis: what docs/explanation/thesis.md does not show, and what is refused.
#include <gmock/gmock.h>

#include <filesystem>

#include "tool.hpp"

namespace gearlash::thesis_command_test {
namespace {

using test::Outcome;
using test::run_tool;
using testing::HasSubstr;

TEST(ThesisCommand, RunSaysWhereTheFacesDoNotMeet) {
  const Outcome run = run_tool(
      {"thesis", "run", "--damping", "0.9", "--inertia-ratio", "1", "--friction-ratio", "0.5"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("for 100 s the faces have not met"));
  EXPECT_THAT(run.out, HasSubstr("no limit cycle: cannot hunt"));
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

TEST(ThesisCommand, TableTwoStandsBesideThePrintoutOf1960) {
  EXPECT_THAT(run_tool({"thesis", "table-2"}).out,
              HasSubstr("\n80000000- 1  77040631- 1  30333708- 2  68901844- 1  30007982- 2     "
                        "79999999- 1  77040630- 1  30333708- 2  68901844- 1  30007982- 2\n"));
}

TEST(ThesisCommand, TraceShowsRegistersAtEachInstruction) {
  const Outcome run = run_tool({"thesis", "machine", "--trace", "2"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\n  20000 U  SLJ  4 20022  0000000000000000 "));
  EXPECT_THAT(run.out, HasSubstr("\n  20022 L  SLJ  0 20022  0000000000000000 "));
}

TEST(ThesisCommand, ATooLongStepIsNoResultInEitherArithmetic) {
  std::vector<std::string> words = {"thesis",          "run",  "--damping",        "0.2",
                                    "--inertia-ratio", "1000", "--friction-ratio", "0.2"};
  for (const bool on_machine : {false, true}) {
    if (on_machine) words.emplace_back("--machine");
    const Outcome run = run_tool(words);
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("its step is too long for this servo"));
    EXPECT_THAT(run.out, HasSubstr("\n  amplitude  ±0.129299"));
    EXPECT_EQ(run.err, "");
  }
}

TEST(ThesisCommand, AChartIsReadWhereACurveIsAbsent) {
  const Outcome run = run_tool({"thesis", "chart-reading", "--damping", ".45", "--inertia-ratio",
                                "2", "--friction-ratio", ".4"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("the curve for 0.5 is absent (0);\n"));
}

TEST(ThesisCommand, EachFaultIsOneLine) {
  const std::string verbs = "table-2, machine, run, figure, chart-reading, extension or all";
  const struct {
    std::vector<std::string> words;
    std::string fault;
  } cases[] = {
      {{}, "verb is missing: must be " + verbs + "; see gearlash thesis --help"},
      {{"table-9"},
       "verb = table-9: must be " + verbs + " (did you mean table-2?); see gearlash thesis --help"},
      {{"table-2", "--arithmetic", "decimal"}, "--arithmetic = decimal: must be double or 1604"},
      {{"table-2", "--properties", "--arithmetic", "1604"},
       "--arithmetic and --properties must not be given together; see gearlash thesis table-2 "
       "--help"},
      {{"machine", "--rules", "--listing"},
       "--rules and --listing must not be given together; see gearlash thesis machine --help"},
      {{"machine", "--trace", "0.5"}, "--trace = 0.5: must be a whole number from 1 to 1000000"},
      {{"run", "--damping", "0.1", "--inertia-ratio", "inf", "--friction-ratio", "0.2"},
       "inertia_ratio = inf: must be from 1e-9 to 1e9: the program of 1960 divides by both "
       "inertias"},
      {{"run", "--all", "--damping", "3"},
       "--damping and --all must not be given together; see gearlash thesis run --help"},
      {{"run", "--plot", "errors=a.svg"},
       "--plot must come with --all; see gearlash thesis run --help"},
      {{"run", "--causes", "--machine"},
       "--machine and --causes must not be given together; see gearlash thesis run --help"},
      {{"run", "a.toml", "b"},
       "b: one word too many: run takes one DRIVE.toml; a value with blanks needs quotes; see "
       "gearlash thesis run --help"},
      {{"figure", "16"},
       "N = 16: must be the number of a figure: 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14 or "
       "15"},
      {{"extension", "5"}, "N = 5: must be 2, 3 or 4 (recommendation 1 is gearlash thesis run)"},
      {{"chart-reading", "--damping", ".9", "--inertia-ratio", "20", "--friction-ratio", ".1"},
       "damping = 0.9: must be from 0.1 to 0.6\n"
       "gearlash: inertia_ratio = 20: must be from 1/9 to 9, where the charts of 1960 end"}};
  for (const auto& [words, fault] : cases) {
    std::vector<std::string> all = words;
    all.insert(all.begin(), "thesis");
    const Outcome run = run_tool(all);
    EXPECT_EQ(run.status, 2) << fault;
    EXPECT_EQ(run.err, "gearlash: " + fault + "\n");
  }
}

}  // namespace
}  // namespace gearlash::thesis_command_test
