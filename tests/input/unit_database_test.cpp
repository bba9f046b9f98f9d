// The table of units against UDUNITS-2 itself, to the bit.
#include "input/unit_database.hpp"

#include <gtest/gtest.h>
#include <udunits2.h>

#include <fstream>
#include <memory>
#include <random>
#include <regex>
#include <sstream>
#include <string>

#include "input/unit_expression.hpp"

namespace gearlash::unit_database_test {
namespace {

struct Free {
  void operator()(ut_system* system) const { ut_free_system(system); }
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPointer = std::unique_ptr<ut_unit, Free>;

struct Expansion {
  Unit unit;
  bool by_factor = true;
};

ut_status take_powers(void* expansion, const ut_unit* base, int power) {
  UnitPowers& powers = static_cast<Expansion*>(expansion)->unit.powers;
  const char* symbol = ut_get_symbol(base, UT_ASCII);
  const std::string name = symbol != nullptr ? symbol : "";
  if (name == "m")
    powers.metre += power;
  else if (name == "kg")
    powers.kilogram += power;
  else if (name == "s")
    powers.second += power;
  else if (name == "A")
    powers.ampere += power;
  else if (name == "rad")
    powers.radian += power;
  else
    powers.foreign = true;
  return UT_SUCCESS;
}

extern const ut_visitor visitor;

const ut_visitor visitor = {
    [](const ut_unit* unit, void* expansion) { return take_powers(expansion, unit, 1); },
    [](const ut_unit*, int count, const ut_unit* const* units, const int* powers, void* expansion) {
      for (int i = 0; i < count; ++i) take_powers(expansion, units[i], powers[i]);
      return UT_SUCCESS;
    },
    [](const ut_unit*, double scale, const ut_unit* underlying, double offset, void* expansion) {
      auto& result = *static_cast<Expansion*>(expansion);
      result.unit.factor *= scale;
      if (offset != 0.0) result.by_factor = false;
      return ut_accept_visitor(underlying, &visitor, expansion);
    },
    [](const ut_unit*, const ut_unit*, double, void* expansion) {
      static_cast<Expansion*>(expansion)->by_factor = false;
      return UT_SUCCESS;
    },
    [](const ut_unit*, double, const ut_unit*, void* expansion) {
      static_cast<Expansion*>(expansion)->by_factor = false;
      return UT_SUCCESS;
    }};

/// UDUNITS-2 with our aliases defined in it, and the words of its database and ours.
class Udunits {
 public:
  Udunits() {
    ut_set_error_message_handler(ut_ignore);
    system_.reset(ut_read_xml(nullptr));
    ut_status status = UT_SUCCESS;
    const std::string top = ut_get_path_xml(nullptr, &status);
    for (const char* part : {"base", "derived", "accepted", "common", "prefixes"}) {
      read_words(top.substr(0, top.rfind(".xml")) + "-" + part + ".xml");
    }
    read_aliases();
  }

  /// One unit; or those of the parts, where the database has no such word and we run it together.
  [[nodiscard]] std::vector<Unit> find(const std::string& word) const {
    std::vector<Unit> units = find_single(word);
    for (const std::vector<std::string>& parts : together) {
      for (const std::string& prefix : prefixes_of_together) {
        if (!units.empty() || word != prefix + parts[0]) continue;
        units = find_single(prefix + parts[1]);
        for (std::size_t i = 2; i < parts.size(); ++i) units.push_back(find_single(parts[i]).at(0));
      }
    }
    return units;
  }

  std::vector<std::string> words, prefixes, prefixes_of_together = {""};
  std::vector<std::vector<std::string>> together;  ///< a word, and the parts that it runs together

 private:
  [[nodiscard]] std::vector<Unit> find_single(const std::string& word) const {
    const UnitPointer unit(ut_parse(system_.get(), word.c_str(), UT_UTF8));
    Expansion found;
    if (!unit || ut_accept_visitor(unit.get(), &visitor, &found) != UT_SUCCESS || !found.by_factor)
      return {};
    found.unit.counts_minutes =
        found.unit.powers == UnitPowers{.second = 1} && found.unit.factor >= 60.0;
    return {found.unit};
  }

  void read_words(const std::string& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    const std::string all = text.str();
    const std::regex word("<(singular|plural|symbol|name)>([A-Za-z_'\"%]+)<");
    for (std::sregex_iterator found(all.begin(), all.end(), word), end; found != end; ++found) {
      const bool is_prefix = path.find("prefixes") != std::string::npos;
      (is_prefix ? prefixes : words).push_back((*found)[2]);
    }
  }

  void read_aliases() {
    std::ifstream file(GEARLASH_SOURCE_DIRECTORY "/src/input/units_of_engineers.txt");
    for (std::string line; std::getline(file, line);) {
      std::istringstream rest(line);
      std::string kind, name, equals, part;
      rest >> kind >> name >> equals;
      if (kind == "unit") {
        const UnitPointer unit(
            ut_parse(system_.get(), line.substr(line.find('=') + 2).c_str(), UT_UTF8));
        ut_unmap_name_to_unit(system_.get(), name.c_str(), UT_ASCII);
        ut_unmap_symbol_to_unit(system_.get(), name.c_str(), UT_ASCII);
        ut_map_name_to_unit(name.c_str(), UT_ASCII, unit.get());
        words.push_back(name);
      } else if (kind == "refused") {
        ut_unmap_symbol_to_unit(system_.get(), name.c_str(), UT_ASCII);
        words.push_back(name);
      } else if (kind == "together") {
        together.push_back({name});
        while (rest >> part) together.back().push_back(part);
      } else if (kind == "prefixes") {
        prefixes_of_together.push_back(name);
        prefixes_of_together.push_back(equals);
        while (rest >> part) prefixes_of_together.push_back(part);
      }
    }
  }

  std::unique_ptr<ut_system, Free> system_;
};

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
  const Udunits udunits;
  std::vector<std::string> words = udunits.words;
  for (const std::string& word : udunits.words) words.push_back(word + "s");
  for (const std::vector<std::string>& parts : udunits.together) {
    for (const std::string& prefix : udunits.prefixes_of_together)
      words.push_back(prefix + parts[0]);
  }
  constexpr unsigned seed = 1960;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const auto one_of = [&](const auto& list) { return list[random() % list.size()]; };
  for (int i = 0; i < 2000; ++i) {
    words.push_back(one_of(udunits.prefixes) + one_of(udunits.words));
    words.push_back(one_of(udunits.prefixes) + words.back());
  }
  for (int i = 0; i < 1000; ++i) {
    std::string& word = words.emplace_back();
    for (auto letters = 1 + random() % 4; letters > 0; --letters) {
      word += one_of(std::string("abcdefghijklmnopqrstuvwxyzACGJKLMNPRTVW_"));
    }
  }
  std::size_t known = 0;
  for (const std::string& word : words) {
    const std::vector<Unit> expected = udunits.find(word);
    if (!expected.empty()) ++known;
    EXPECT_EQ(described(find_units(word)), described(expected)) << word;
  }
  EXPECT_GT(known, 2000U);
  EXPECT_LT(known, words.size() - 500U);
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
