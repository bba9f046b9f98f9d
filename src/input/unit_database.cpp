#include "input/unit_database.hpp"

#include <locale.h>
#include <udunits2.h>

#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

#include "base/fault.hpp"

namespace gearlash {
namespace {

struct Alias {
  const char* name;
  const char* definition;
};

/// Defined in this order, over what UDUNITS-2 has by the same name. It holds the ounces and the
/// slug rounded to 7 digits, reads oz as a fluid ounce and Hz as 1/s, an angle or not.
constexpr std::array aliases = {
    Alias{"avoirdupois_ounce", "0.028349523125 kg"},  // lb/16
    Alias{"oz", "avoirdupois_ounce"},
    Alias{"ounce", "avoirdupois_ounce"},
    Alias{"ounces", "avoirdupois_ounce"},
    Alias{"ounce_force", "0.27801385095378125 N"},  // lbf/16
    Alias{"ounces_force", "ounce_force"},
    Alias{"force_ounce", "ounce_force"},
    Alias{"ozf", "ounce_force"},
    Alias{"lbs", "lb"},
    Alias{"lbm", "lb"},
    Alias{"slug", "lbf s2/ft"},
    Alias{"slugs", "slug"},
    Alias{"kp", "kgf"},
    Alias{"dyn", "dyne"},
    Alias{"deg", "arc_degree"},
    Alias{"degs", "arc_degree"},
    Alias{"MOA", "arc_minute"},
    Alias{"moa", "arc_minute"},
    Alias{"gon", "0.9 arc_degree"},
    Alias{"gons", "gon"},
    Alias{"rev", "turn"},
    Alias{"revs", "turn"},
    Alias{"rpm", "turn/min"},
    Alias{"Hz", "turn/s"},
    Alias{"hertz", "turn/s"},
};

/// Grain to UDUNITS-2, gram to those who write it on a data sheet: better refused than 15 times
/// too small.
constexpr std::array ambiguous_symbols = {"gr"};

/// Spellings that run two units together, as data sheets do. The first may carry a prefix.
struct RunTogether {
  const char* word;
  std::array<const char*, 3> parts;
};
constexpr std::array run_together = {
    RunTogether{"Nm", {"N", "m"}},       RunTogether{"Ncm", {"N", "cm"}},
    RunTogether{"Nmm", {"N", "mm"}},     RunTogether{"Nms", {"N", "m", "s"}},
    RunTogether{"Vs", {"V", "s"}},       RunTogether{"kgm", {"kg", "m"}},
    RunTogether{"gcm", {"g", "cm"}},     RunTogether{"gmm", {"g", "mm"}},
    RunTogether{"gfcm", {"gf", "cm"}},   RunTogether{"kgfm", {"kgf", "m"}},
    RunTogether{"ozin", {"oz", "in"}},   RunTogether{"inoz", {"in", "oz"}},
    RunTogether{"ozfin", {"ozf", "in"}}, RunTogether{"inozf", {"in", "ozf"}},
    RunTogether{"lbin", {"lb", "in"}},   RunTogether{"inlb", {"in", "lb"}},
    RunTogether{"lbft", {"lb", "ft"}},   RunTogether{"ftlb", {"ft", "lb"}},
    RunTogether{"lbfin", {"lbf", "in"}}, RunTogether{"inlbf", {"in", "lbf"}},
    RunTogether{"lbfft", {"lbf", "ft"}}, RunTogether{"ftlbf", {"ft", "lbf"}},
};
constexpr std::array prefixes = {"", "k", "c", "m", "u", "\u00B5", "\u03BC", "n", "M"};

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPointer = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeSystem {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
using SystemPointer = std::unique_ptr<ut_system, FreeSystem>;

/// UDUNITS-2 prints its errors to standard error unless told not to.
class SilentErrors {
 public:
  SilentErrors() : previous_(ut_set_error_message_handler(ut_ignore)) {}
  ~SilentErrors() { ut_set_error_message_handler(previous_); }
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;

 private:
  ut_error_message_handler previous_;
};

/// UDUNITS-2 reads the numbers of its own database by the locale, and fails where the decimal sign
/// is a comma.
class DecimalPoint {
 public:
  DecimalPoint() : c_(newlocale(LC_ALL_MASK, "C", nullptr)), previous_(uselocale(c_)) {}
  ~DecimalPoint() {
    uselocale(previous_);
    freelocale(c_);
  }
  DecimalPoint(const DecimalPoint&) = delete;
  DecimalPoint& operator=(const DecimalPoint&) = delete;

 private:
  locale_t c_;
  locale_t previous_;
};

void define(ut_system* system, const Alias& alias) {
  // Parsed before the old meaning goes: no alias is defined by itself.
  const UnitPointer unit(ut_parse(system, alias.definition, UT_ASCII));
  ut_unmap_name_to_unit(system, alias.name, UT_ASCII);
  ut_unmap_symbol_to_unit(system, alias.name, UT_ASCII);
  ut_map_name_to_unit(alias.name, UT_ASCII, unit.get());
}

SystemPointer load_system() {
  SystemPointer system(ut_read_xml(nullptr));
  if (!system) {
    ut_status status = UT_SUCCESS;
    const char* path = ut_get_path_xml(nullptr, &status);
    throw InvalidInput({{"UDUNITS2_XML_PATH", path != nullptr ? path : "(unknown)",
                         "must be the unit database of UDUNITS-2", ""}});
  }
  for (const Alias& alias : aliases) define(system.get(), alias);
  for (const char* symbol : ambiguous_symbols) {
    ut_unmap_symbol_to_unit(system.get(), symbol, UT_ASCII);
  }
  return system;
}

/// What the visitor of UDUNITS-2 finds out about a unit.
struct Expansion {
  Unit unit;
  bool convertible = true;  ///< by a factor alone
};

void add_power(UnitPowers& powers, const ut_unit* base, int power) {
  const char* symbol = ut_get_symbol(base, UT_ASCII);
  const std::string_view name = symbol != nullptr ? symbol : "";
  if (name == "m") {
    powers.metre += power;
  } else if (name == "kg") {
    powers.kilogram += power;
  } else if (name == "s") {
    powers.second += power;
  } else if (name == "A") {
    powers.ampere += power;
  } else if (name == "rad") {
    powers.radian += power;
  } else {
    powers.foreign = true;
  }
}

extern "C" {

ut_status visit_basic(const ut_unit* unit, void* expansion) {
  add_power(static_cast<Expansion*>(expansion)->unit.powers, unit, 1);
  return UT_SUCCESS;
}

ut_status visit_product(const ut_unit*, int count, const ut_unit* const* units, const int* powers,
                        void* expansion) {
  for (int i = 0; i < count; ++i) {
    add_power(static_cast<Expansion*>(expansion)->unit.powers, units[i], powers[i]);
  }
  return UT_SUCCESS;
}

ut_status visit_galilean(const ut_unit*, double scale, const ut_unit* underlying, double offset,
                         void* expansion);

ut_status visit_timestamp(const ut_unit*, const ut_unit*, double, void* expansion) {
  static_cast<Expansion*>(expansion)->convertible = false;
  return UT_SUCCESS;
}

ut_status visit_logarithmic(const ut_unit*, double, const ut_unit*, void* expansion) {
  static_cast<Expansion*>(expansion)->convertible = false;
  return UT_SUCCESS;
}

}  // extern "C"

constexpr ut_visitor visitor = {visit_basic, visit_product, visit_galilean, visit_timestamp,
                                visit_logarithmic};

ut_status visit_galilean(const ut_unit*, double scale, const ut_unit* underlying, double offset,
                         void* expansion) {
  Expansion& result = *static_cast<Expansion*>(expansion);
  result.unit.factor *= scale;
  if (offset != 0.0) result.convertible = false;
  return ut_accept_visitor(underlying, &visitor, expansion);
}

std::optional<Unit> expand(const ut_unit* unit) {
  Expansion expansion;
  if (ut_accept_visitor(unit, &visitor, &expansion) != UT_SUCCESS) return std::nullopt;
  if (!expansion.convertible) return std::nullopt;
  // min, h, d, … but not ms, µs.
  expansion.unit.counts_minutes =
      expansion.unit.powers == UnitPowers{.second = 1} && expansion.unit.factor >= 60.0;
  return expansion.unit;
}

std::optional<Unit> find_single(ut_system* system, const std::string& word) {
  const UnitPointer unit(ut_parse(system, word.c_str(), UT_UTF8));
  return unit ? expand(unit.get()) : std::nullopt;
}

std::vector<Unit> find_run_together(ut_system* system, const std::string& word) {
  for (const RunTogether& entry : run_together) {
    for (const char* prefix : prefixes) {
      if (word != std::string(prefix) + entry.word) continue;
      std::vector<Unit> units;
      for (const char* part : entry.parts) {
        if (part == nullptr) break;
        const std::optional<Unit> unit =
            find_single(system, units.empty() ? std::string(prefix) + part : part);
        if (!unit) return {};
        units.push_back(*unit);
      }
      return units;
    }
  }
  return {};
}

}  // namespace

Unit& Unit::multiply(const Unit& other, int power) {
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

std::vector<Unit> find_units(const std::string& word) {
  static std::mutex
      mutex;  // for UDUNITS-2 and for the database, loaded once: it takes milliseconds
  const std::lock_guard lock(mutex);
  const SilentErrors silent;
  const DecimalPoint point;
  static const SystemPointer system = load_system();
  if (const std::optional<Unit> unit = find_single(system.get(), word)) return {*unit};
  return find_run_together(system.get(), word);
}

}  // namespace gearlash
