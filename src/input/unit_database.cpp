#include "input/unit_database.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace gearlash {
namespace {

struct NamedUnit {
  std::string_view word;
  Unit unit;  ///< factor 0: no factor alone converts it (degC, dB)
};

struct Prefix {
  std::string_view word;
  double factor;
};

/// A spelling that runs units together, as in data sheets. The first may carry a prefix.
struct RunTogether {
  std::string_view word;
  std::array<std::string_view, 3> parts;
};

// Generated when the project is built, from UDUNITS-2's database and units_of_engineers.txt:
//   named_units (in lower case, sorted), unit_symbols (sorted), name_prefixes (in lower case) and
//   symbol_prefixes (the longest first), run_together, run_together_prefixes
#include "base/lists.hpp"
#include "input/unit_table.inc"

/// Of the factors in the table: at most 3.2 of all its 839 words (tests/scripts).
constexpr int roundings_of_table = 4;

/// UDUNITS-2 takes a factor this near to 1 for 1, since only rounding makes the difference.
constexpr double almost_one = 10 * std::numeric_limits<double>::epsilon();

/// Lowers ASCII letters only, in every locale, as UDUNITS-2 compares names.
std::string in_lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

const Unit* find_in(std::span<const NamedUnit> units, std::string_view word) {
  const auto found =
      std::lower_bound(units.begin(), units.end(), word,
                       [](const NamedUnit& unit, std::string_view w) { return unit.word < w; });
  return found != units.end() && found->word == word ? &found->unit : nullptr;
}

const Prefix* find_prefix(std::span<const Prefix> prefixes, std::string_view word) {
  return first_of(prefixes, [&](const Prefix& prefix) { return word.starts_with(prefix.word); });
}

/// UDUNITS-2's rule: look up the whole word, then the remainder after each prefix, each first as a
/// name in any case and then as a symbol. A word may have any number of name prefixes and one
/// symbol prefix.
std::optional<Unit> find_single(std::string_view word) {
  const std::string lower = in_lower_case(word);
  std::string_view name = lower;
  double factor = 1.0;
  int roundings = roundings_of_table;
  bool symbol_seen = false;
  while (!word.empty()) {
    const Unit* unit = find_in(named_units, name);
    if (unit == nullptr) unit = find_in(unit_symbols, word);
    if (unit != nullptr) {
      if (unit->factor == 0.0) return std::nullopt;
      Unit result = *unit;
      result.factor *= factor;
      if (std::abs(result.factor - 1.0) < almost_one) result.factor = 1.0;  // kl is m3
      if (result.factor != 1.0) result.roundings = roundings;
      // min, h, d, … but not ms, µs.
      result.counts_minutes = result.powers == UnitPowers{.second = 1} && result.factor >= 60.0;
      return result;
    }
    const Prefix* prefix = find_prefix(name_prefixes, name);
    if (prefix == nullptr && !symbol_seen) {
      prefix = find_prefix(symbol_prefixes, word);
      symbol_seen = true;
    }
    if (prefix == nullptr) break;
    factor *= prefix->factor;
    roundings += 2;  // its own and the product's
    word.remove_prefix(prefix->word.size());
    name.remove_prefix(prefix->word.size());
    if (word.find_first_of("'\"%") == 0) break;  // signs take no prefix
  }
  return std::nullopt;
}

std::vector<Unit> find_run_together(std::string_view word) {
  for (const RunTogether& entry : run_together) {
    if (!word.ends_with(entry.word)) continue;
    const std::string prefix(word.substr(0, word.size() - entry.word.size()));
    if (!contains(run_together_prefixes, prefix)) continue;
    std::vector<Unit> units;
    for (const std::string_view part : entry.parts) {
      if (part.empty()) break;
      const std::optional<Unit> unit =
          units.empty() ? find_single(prefix + std::string(part)) : find_single(part);
      if (!unit) return {};
      units.push_back(*unit);
    }
    return units;
  }
  return {};
}

}  // namespace

Unit& Unit::multiply(const Unit& other, int power) {
  // The power of the C library is off by at most a unit in the last place, two of these.
  const int of_power = other.factor == 1.0 || power == 1 ? 0 : 2;
  const int of_product = other.factor == 1.0 || factor == 1.0 ? 0 : 1;
  roundings += std::abs(power) * other.roundings + of_power + of_product;
  factor *= std::pow(other.factor, power);
  powers.metre += power * other.powers.metre;
  powers.kilogram += power * other.powers.kilogram;
  powers.second += power * other.powers.second;
  powers.ampere += power * other.powers.ampere;
  powers.radian += power * other.powers.radian;
  powers.foreign = powers.foreign || other.powers.foreign;
  counts_minutes = counts_minutes || other.counts_minutes;
  return *this;
}

std::vector<Unit> find_units(std::string_view word) {
  if (const std::optional<Unit> unit = find_single(word)) return {*unit};
  return find_run_together(word);
}

}  // namespace gearlash
