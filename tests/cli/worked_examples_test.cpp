// Every drive that the project shows is decided: the examples, the files on the pages of the
// documentation, and what commands there print (kept up to date by scripts/readme).
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tool.hpp"

namespace gearlash::worked_examples_test {
namespace {

using nlohmann::json;
using test::file_text;
using test::lines_of;
using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::HasSubstr;
using testing::Not;

const std::filesystem::path root = GEARLASH_SOURCE_DIRECTORY;

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            const std::string& extension) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::filesystem::path> pages() {
  std::vector<std::filesystem::path> all = files_in(root / "docs", ".md");
  all.push_back(root / "README.md");
  return all;
}

/// The lines of a page after one that starts with `begin` and up to one that starts with `end`.
std::vector<std::string> blocks_of(const std::filesystem::path& page, const std::string& begin,
                                   const std::string& end) {
  std::vector<std::string> blocks;
  bool is_inside = false;
  for (const std::string& line : lines_of(file_text(page))) {
    if (is_inside && line.starts_with(end)) {
      is_inside = false;
    } else if (is_inside) {
      blocks.back() += line + "\n";
    } else if (line.starts_with(begin)) {
      is_inside = true;
      blocks.emplace_back();
    }
  }
  return blocks;
}

bool is_drive(const std::string& toml) {
  const auto has = [&](const char* section) { return toml.find(section) != std::string::npos; };
  return (has("[gearbox]") || has("[servo]") || has("[joint]")) && !has("[sweep]");
}

void expect_decided(const std::filesystem::path& file) {
  const Outcome run = run_tool({"limit-cycle", file.string(), "--format", "json"});
  EXPECT_EQ(run.status, 0) << run.err;
  if (run.status != 0) return;
  const json answer = json::parse(run.out);
  EXPECT_NE(answer["verdict"], "undecided");
  if (answer["search"].is_null()) return;
  EXPECT_TRUE(answer["search"]["is_complete"].get<bool>());
  for (const json& start : answer["search"]["starts"]) EXPECT_NE(start["end"], "undecided");
}

TEST(WorkedExamples, OfTheProjectAreDecided) {
  int count = 0;
  for (const std::filesystem::path& file : files_in(root / "examples", ".toml")) {
    if (!is_drive(file_text(file)) || file.parent_path().filename() == "faulty") continue;
    SCOPED_TRACE(file.filename());
    expect_decided(file);
    ++count;
  }
  EXPECT_GE(count, 8);
}

/// A report that would be longer leaves out the step or other motions and says so.
TEST(WorkedExamples, OfProductsHaveReportsOfFortyLines) {
  std::string texts;
  for (const std::filesystem::path& file : files_in(root / "examples/products", ".toml")) {
    const Outcome run = run_tool({"limit-cycle", file.string()});
    EXPECT_LE(lines_of(run.out).size(), 40U) << file << "\n" << run.out;
    texts += run.out;
  }
  EXPECT_NE(texts.find("--verbose (with the step, left out here)"), std::string::npos);
}

TEST(WorkedExamples, OnPagesAreDecided) {
  const Scratch scratch;
  int count = 0;
  for (const std::filesystem::path& page : pages()) {
    for (const std::string& toml : blocks_of(page, "```toml", "```")) {
      if (!is_drive(toml)) continue;
      SCOPED_TRACE(testing::Message() << page.filename() << "\n" << toml);
      const std::filesystem::path file = scratch / "drive.toml";
      std::ofstream(file) << toml;
      expect_decided(file);
      ++count;
    }
  }
  EXPECT_GE(count, 5);
}

TEST(WorkedExamples, PrintNoUndecidedAnswerOnAnyPage) {
  int count = 0;
  for (const std::filesystem::path& page : pages()) {
    for (const std::string& printed : blocks_of(page, "<!-- output", "<!-- end of output -->")) {
      EXPECT_THAT(printed, Not(HasSubstr("undecided"))) << page.filename();
      ++count;
    }
  }
  EXPECT_GE(count, 30);
}

}  // namespace
}  // namespace gearlash::worked_examples_test
