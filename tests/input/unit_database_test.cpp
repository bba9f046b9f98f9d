// The table of units against what UDUNITS-2 gave when it was asked at run time, to the bit.
#include "input/unit_database.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "input/unit_expression.hpp"

namespace gearlash::unit_database_test {
namespace {

std::string described(const std::vector<Unit>& units) {
  std::ostringstream text;
  for (const Unit& unit : units) {
    const UnitPowers& powers = unit.powers;
    text << (text.tellp() > 0 ? ";" : "") << std::hexfloat << unit.factor << ' ' << powers.metre
         << ' ' << powers.kilogram << ' ' << powers.second << ' ' << powers.ampere << ' '
         << powers.radian << ' ' << powers.foreign << ' ' << unit.counts_minutes;
  }
  return text.str();
}

TEST(OracleUnitDatabase, EveryWordIsWhatUdunitsMakesOfIt) {
  std::ifstream recorded(GEARLASH_SOURCE_DIRECTORY "/tests/input/data/units-of-udunits.txt");
  std::size_t words = 0;
  for (std::string line; std::getline(recorded, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t tab = std::min(line.find('\t'), line.size());
    const std::string expected = tab < line.size() ? line.substr(tab + 1) : "";
    EXPECT_EQ(described(find_units(line.substr(0, tab))), expected) << line;
    ++words;
  }
  EXPECT_GT(words, 1000U);
}

TEST(UnitDatabase, KnowsEveryUnitOfTheDocs) {
  std::ifstream page(GEARLASH_SOURCE_DIRECTORY "/docs/reference/data-sheets.md");
  const std::regex quoted("`([^`]+)`");
  bool in_table = false;
  std::size_t words = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| written | means |")) in_table = true;
    if (line.empty()) in_table = false;
    if (!in_table) continue;
    const std::string written = line.substr(0, line.find('|', 1));
    for (std::sregex_iterator word(written.begin(), written.end(), quoted), end; word != end;
         ++word) {
      EXPECT_NO_THROW(read_unit((*word)[1].str())) << (*word)[1];
      ++words;
    }
  }
  EXPECT_GT(words, 50U);
}

}  // namespace
}  // namespace gearlash::unit_database_test
