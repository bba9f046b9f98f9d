// Text for a terminal: paragraphs wrapped again, rows folded, tables divided, commands still typed.
#include <gmock/gmock.h>

#include <iterator>
#include <random>
#include <sstream>

#include "gearlash/output.hpp"

namespace gearlash::columns_test {
namespace {

using testing::HasSubstr;

constexpr unsigned seed = 46;

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// No line is longer than the terminal, but for a word.
void expect_lines_fit(const std::string& text, std::size_t columns) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const bool is_one_word = words_of(line).size() == 1;
    EXPECT_TRUE(is_one_word || width_in_columns(line) <= columns) << line;
  }
}

std::string random_words(std::mt19937& random, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text +=
        (i > 0 ? " " : "") + std::string(1 + random() % 9, 'a') + (random() % 4 == 0 ? "ω" : "");
  }
  return text;
}

TEST(Fitted, WrapsAParagraphAgain) {
  std::mt19937 random(seed);
  for (int i = 0; i < 200; ++i) {
    const std::string paragraph = random_words(random, 1 + random() % 80);
    const std::size_t columns = 40 + random() % 121;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << i);
    EXPECT_EQ(fitted(wrapped(paragraph), columns), wrapped(paragraph, columns));
  }
}

TEST(Fitted, EveryWordOfATableStaysAndEveryLineFits) {
  std::mt19937 random(seed);
  for (int i = 0; i < 300; ++i) {
    TextRows rows(1 + random() % 5, TextRow(1 + random() % 7));
    for (TextRow& row : rows) {
      for (std::string& cell : row) cell = random_words(random, 1 + random() % 3);
      row.back() = random_words(random, 1 + random() % 12);
    }
    const std::size_t columns = 40 + random() % 121;
    const std::string text = table_text(rows);
    const std::string narrow = fitted(text, columns);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << i << "\n" << text);
    expect_lines_fit(narrow, columns);
    const auto all = words_of(narrow);
    for (const std::string& word : words_of(text)) EXPECT_THAT(all, testing::Contains(word));
  }
}

TEST(Fitted, LeavesWhatFitsAsItIs) {
  const std::string text = "hunts: ±1 deg\n\nRest\n  load   1 deg  a remark\n  motor  2\n\nEnd.\n";
  EXPECT_EQ(fitted(text, 40), text);
}

TEST(Fitted, FoldsARemarkUnderItself) {
  EXPECT_EQ(fitted("  mean period  5.72 s that is spread over many swings of the motor\n", 44),
            "  mean period  5.72 s that is spread over\n"
            "               many swings of the motor\n");
}

TEST(Fitted, DividesATableAndRepeatsItsFirstColumn) {
  const TextRows rows = {{"parameter", "now", "meets the target", "change"},
                         {"gearbox.ratio", "50", "at most 30 000", "−40 %"},
                         {"load.inertia", "0.025 kg m2", "at most 0.01 kg m2", "−60 %"}};
  EXPECT_EQ(fitted(table_text(rows), 48),
            "  parameter      now          meets the target\n"
            "  gearbox.ratio  50           at most 30 000\n"
            "  load.inertia   0.025 kg m2  at most 0.01 kg m2\n"
            "\n"
            "  parameter      change\n"
            "  gearbox.ratio  −40 %\n"
            "  load.inertia   −60 %\n");
}

TEST(Fitted, ACommandCanStillBeTyped) {
  const std::string command =
      "  gearlash design a.toml --target \"amplitude <= 1 deg and frequency >= 3 Hz\" --vary a,b\n";
  const std::string narrow = fitted(command, 50);
  EXPECT_THAT(narrow, HasSubstr("\"amplitude <= 1 deg and frequency >= 3 Hz\""));
  EXPECT_THAT(narrow, HasSubstr(" \\\n"));
  expect_lines_fit(narrow, 50);
  EXPECT_EQ(fitted(narrow, 160), command) << "the same command";
}

}  // namespace
}  // namespace gearlash::columns_test
