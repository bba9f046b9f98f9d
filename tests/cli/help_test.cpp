// --help everywhere, with examples and exit statuses, and --version.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/ioctl.h>

#include <algorithm>

#include "gearlash/output.hpp"
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

TEST(Help, ListsTheVerbsInGroupsAndThoseOf1960Last) {
  const std::string help = run_tool({"help"}).out;
  std::size_t last = 0;
  for (const char* text :
       {"\nAsk what a drive does:\n", "  limit-cycle ", "  simulate ", "  describe ", "  compare ",
        "\nFind what to change:\n", "  design ", "  tune ", "  tolerance ",
        "\nDraw and tabulate:\n", "  map ", "  chart ", "  sweep ", "  explore ", "  show ",
        "  motor ", "\nThe thesis of 1960:\n", "  thesis ",
        "\nExamples:\n  gearlash limit-cycle examples/robot-joint.toml --brief\n"}) {
    const std::size_t place = help.find(text, last);
    ASSERT_NE(place, std::string::npos) << text;
    last = place;
  }
}

TEST(Help, FlagsOf1960StandLast) {
  for (const char* verb : {"limit-cycle", "simulate", "describe", "compare", "design", "tune",
                           "tolerance", "map", "chart", "explore", "show"}) {
    const std::string help = run_tool({verb, "--help"}).out;
    const std::size_t group = help.find("\nServo of 1960, without a file:\n");
    ASSERT_NE(group, std::string::npos) << verb;
    for (const char* option :
         {"\n  --set", "\n  --sensor", "\n  --specification", "\n  --step", "\n  --band"}) {
      EXPECT_LT(help.find(option), group) << verb << option;
    }
    const std::size_t end = help.find("\n\n", group);
    EXPECT_GT(help.find("\n  --damping"), group) << verb;
    EXPECT_EQ(help.rfind("\n  --"), help.find("\n  --restitution")) << verb << ": nothing after it";
    EXPECT_LT(help.find("\n  --restitution"), end) << verb;
  }
}

/// No line is wider, but for one of a single word, quoted or followed by the shell's mark.
void expect_width(const std::string& text, std::size_t columns) {
  for (const std::string& line : test::lines_of(text)) {
    const std::size_t width = width_in_columns(line);
    const std::string words = line.substr(std::min(line.find_first_not_of(' '), line.size()));
    const std::string word = words.substr(0, words.find_last_not_of(" \\") + 1);
    const bool is_word = word.find(' ') == std::string::npos || word.starts_with('"');
    EXPECT_TRUE(width <= columns || is_word) << columns << ": " << line;
  }
}

TEST(Help, AndReportsFitTheWidthThatIsGiven) {
  for (const std::size_t columns : {40U, 57U, 80U, 160U}) {
    const std::string width = "COLUMNS=" + std::to_string(columns) + " \"$GEARLASH\" ";
    for (const char* verb : {"help", "limit-cycle --help", "design --help", "simulate --help",
                             "thesis run --help", "limit-cycle examples/elinco-fd162.toml",
                             "design examples/elinco-fd162.toml --target no-hunting",
                             "motor examples/elinco-fd162.toml"}) {
      const Outcome run = test::run_shell(width + verb);
      EXPECT_EQ(run.status, 0) << verb;
      expect_width(run.out, columns);
    }
  }
  // Documents are never folded.
  const std::string json = " limit-cycle examples/elinco-fd162.toml --format json";
  EXPECT_EQ(test::run_shell("COLUMNS=40 \"$GEARLASH\"" + json).out,
            test::run_shell("\"$GEARLASH\"" + json).out);
}

TEST(Help, TheTerminalsWidthIsKnown) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  ASSERT_EQ(grantpt(terminal) + unlockpt(terminal), 0);
  const std::string name = ptsname(terminal);
  const int held = open(name.c_str(), O_RDWR | O_NOCTTY);  // keeps what is written
  winsize window{};
  window.ws_col = 44;
  ASSERT_EQ(ioctl(terminal, TIOCSWINSZ, &window), 0);
  test::run_shell("COLUMNS=90 \"$GEARLASH\" limit-cycle examples/robot-joint.toml --brief >" +
                  name);
  std::string text(4096, '\0');
  text.resize(static_cast<std::size_t>(read(terminal, text.data(), text.size())));
  close(held);
  close(terminal);
  std::erase(text, '\r');
  EXPECT_GT(test::lines_of(text).size(), 1U);
  expect_width(text, 44);
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
