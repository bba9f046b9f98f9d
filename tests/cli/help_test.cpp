// --help everywhere, with examples and exit statuses, and --version.
#include <gmock/gmock.h>

#include "gearlash/version.hpp"
#include "tool.hpp"

namespace gearlash::help_test {
namespace {

using test::Outcome;
using test::run_tool;
using testing::HasSubstr;

class Help : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Help, OpensWithWhatTheVerbGivesAndEndsWithExamples) {
  const Outcome run = run_tool(GetParam());
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, testing::MatchesRegex("[A-Z][a-z]+ .*[^.?]\n.*")) << "an imperative";
  for (const char* status : {"Exit status:\n  0  done", "\n  1  undecided", "\n  2  bad input",
                             "\n  3  the machine failed", "\n  130, 143  "}) {
    EXPECT_THAT(run.out, HasSubstr(status));
  }
  const std::size_t examples = run.out.find("\nExamples:\n  gearlash ");
  ASSERT_NE(examples, std::string::npos);
  EXPECT_EQ(run.out.find("\n\n", examples), std::string::npos) << "nothing after them";
}

INSTANTIATE_TEST_SUITE_P(
    Everywhere, Help,
    testing::Values(
        std::vector<std::string>{"--help"}, std::vector<std::string>{"-h"},
        std::vector<std::string>{"limit-cycle", "--help"},
        std::vector<std::string>{"simulate", "--help"},
        std::vector<std::string>{"describe", "--help"}, std::vector<std::string>{"motor", "--help"},
        std::vector<std::string>{"chart", "--help"}, std::vector<std::string>{"map", "--help"},
        std::vector<std::string>{"sweep", "--help"}, std::vector<std::string>{"compare", "--help"},
        std::vector<std::string>{"design", "--help"}, std::vector<std::string>{"tune", "--help"},
        std::vector<std::string>{"tolerance", "--help"}, std::vector<std::string>{"show", "--help"},
        std::vector<std::string>{"thesis", "--help"},
        std::vector<std::string>{"thesis", "table-2", "--help"},
        std::vector<std::string>{"thesis", "machine", "--help"},
        std::vector<std::string>{"thesis", "figure", "--help"},
        std::vector<std::string>{"thesis", "all", "--help"},
        std::vector<std::string>{"thesis", "chart-reading", "-h"},
        std::vector<std::string>{"thesis", "extension", "-h"},
        std::vector<std::string>{"thesis", "run", "--help"}));

TEST(Help, EveryOptionOfTheContractIsNamed) {
  const std::string limit_cycle = run_tool({"limit-cycle", "--help"}).out;
  const std::string simulate = run_tool({"simulate", "--help"}).out;
  for (const char* option : {"--damping", "--inertia-ratio", "--friction-ratio", "--backlash",
                             "--restitution", "--sensor", "--format", "--plot"}) {
    EXPECT_THAT(limit_cycle, HasSubstr(option));
    EXPECT_THAT(simulate, HasSubstr(option));
  }
  for (const char* option : {"--initial-position", "--initial-speed", "--reference", "--until",
                             "--every", "--events", "--output"}) {
    EXPECT_THAT(simulate, HasSubstr(option));
  }
}

TEST(Help, IsAVerbToo) {
  EXPECT_EQ(run_tool({"help", "design"}).out, run_tool({"design", "--help"}).out);
  EXPECT_EQ(run_tool({"help"}).out, run_tool({"--help"}).out);
  EXPECT_THAT(run_tool({"help", "limit"}).err, HasSubstr("did you mean limit-cycle?"));
}

TEST(Help, Version) {
  const Outcome run = run_tool({"--version"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, std::string("gearlash ") + version + "\n");
}

}  // namespace
}  // namespace gearlash::help_test
