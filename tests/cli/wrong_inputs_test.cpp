// Every wrong command line of wrong_inputs.txt with its message, the whole of it.
// GEARLASH_REWRITE=1 runs them and writes the messages anew, to be read before they are committed.
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "tool.hpp"

namespace gearlash::wrong_inputs_test {
namespace {

using test::Outcome;

std::filesystem::path table() {
  return std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) / "tests/cli/wrong_inputs.txt";
}

constexpr std::string_view prompt = "$ gearlash";

/// A command after the prompt, and the lines of its message.
struct Entry {
  std::string command;
  std::string message;
};

std::vector<Entry> entries() {
  std::vector<Entry> all;
  for (const std::string& line : test::lines_of(test::file_text(table()))) {
    if (line.starts_with(prompt)) {
      all.push_back({line.substr(prompt.size()), ""});
    } else if (!line.empty() && !line.starts_with("#")) {
      all.back().message += line + "\n";
    }
  }
  return all;
}

Outcome run(const Entry& entry) { return test::run_shell("exec \"$GEARLASH\"" + entry.command); }

void rewrite() {
  std::string text;
  for (const std::string& line : test::lines_of(test::file_text(table()))) {
    const bool is_command = line.starts_with(prompt);
    if (line.starts_with("#") || line.empty() || is_command) text += line + "\n";
    if (is_command) text += run({line.substr(prompt.size()), ""}).err;
  }
  std::ofstream(table(), std::ios::binary) << text;
}

TEST(WrongInputs, EachGivesItsMessageAndStatus2) {
  if (std::getenv("GEARLASH_REWRITE") != nullptr) rewrite();
  const std::vector<Entry> all = entries();
  EXPECT_GE(all.size(), 200U);
  for (const Entry& entry : all) {
    const Outcome outcome = run(entry);
    EXPECT_EQ(outcome.status, 2) << entry.command;
    EXPECT_EQ(outcome.out, "") << entry.command;
    EXPECT_EQ(outcome.err, entry.message) << entry.command;
  }
}

}  // namespace
}  // namespace gearlash::wrong_inputs_test
