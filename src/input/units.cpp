#include "gearlash/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "base/decimal.hpp"
#include "input/unit_expression.hpp"
#include "input/utf8.hpp"

namespace gearlash {
namespace {

/// The number that is the whole of `text`. Nothing for other text, NaN if no double holds it.
std::optional<double> decimal(std::string_view text) {
  if (text.empty() || number_length(text) != text.size()) return std::nullopt;
  if (text[0] == '+') text.remove_prefix(1);
  return nearest_double(text).value_or(std::numeric_limits<double>::quiet_NaN());
}

/// The parts of "1/9" or "43:1"; of another text itself, over 1.
struct Fraction {
  std::string_view above;
  std::string_view below = "1";
  bool has_bar = false;
};

Fraction fraction_in(std::string_view text) {
  const std::size_t bar = text.find_first_of("/:");
  if (bar == std::string_view::npos) return {.above = trimmed(text)};
  return {trimmed(text.substr(0, bar)), trimmed(text.substr(bar + 1)), true};
}

/// "an angle".
std::string with_article(const Dimension& dimension) {
  const std::string name(dimension.name);
  return (std::string_view("aeiou").find(name[0]) == std::string::npos ? "a " : "an ") + name;
}

std::string such_as(const Dimension& dimension) {
  return ", such as " + std::string(dimension.example);
}

bool same_but_for_angle(const UnitPowers& powers, const Dimension& expected) {
  return powers.metre == expected.metre && powers.kilogram == expected.kilogram &&
         powers.second == expected.second && powers.ampere == expected.ampere && !powers.foreign;
}

bool angle_fits(const UnitPowers& powers, const Dimension& expected) {
  if (powers.radian == expected.radian) return true;
  return expected.angle == AngleRule::optional && powers.radian == 0;
}

/// Advice on mistakes that data sheets invite, recognised by the difference in dimension.
std::string advice(std::string_view unit, const UnitPowers& powers, const Dimension& expected) {
  const int metre = powers.metre - expected.metre;
  const int second = powers.second - expected.second;
  const bool like_mass_for_force =
      powers.kilogram == expected.kilogram && powers.ampere == expected.ampere && !powers.foreign;
  if (like_mass_for_force && ((metre == -1 && second == 2) || (metre == 1 && second == -2))) {
    return "; oz, lb, g and kg are masses, the forces are ozf, lbf, gf and kgf";
  }
  if (expected.radian == 1 && expected.second == 0 && powers == UnitPowers{.second = 1}) {
    return "; minutes and seconds of arc are arcmin and arcsec";
  }
  if (expected.radian == 1 && expected.second == 0 && powers == UnitPowers{.metre = 1}) {
    return "; this is a length, milliradians are mrad";
  }
  const std::size_t slash = std::min(unit.find('/'), unit.find(" per "));
  const std::size_t divisor =
      slash == std::string_view::npos ? slash : unit.find_first_not_of("/per ", slash);
  if (divisor != std::string_view::npos && unit[divisor] >= '0' && unit[divisor] <= '9') {
    return "; x/1000 rpm is (x/1000) rpm, write x/(1000 rpm)";
  }
  const bool has_two = slash != std::string_view::npos && unit.find('/', slash + 1) != unit.npos;
  if (has_two && unit.find('(') == unit.npos) {
    return "; x/rad/s is x/(rad s), write x/(rad/s)";
  }
  if (!same_but_for_angle(powers, expected)) return "";
  if (expected.angle == AngleRule::absent) return "; it contains no angle";
  return powers.radian == 0 ? "; the angle must be written" : "";
}

void require_dimension(std::string_view field, std::string_view text, std::string_view name,
                       const Unit& unit, const Dimension& expected) {
  if (!same_but_for_angle(unit.powers, expected) || !angle_fits(unit.powers, expected)) {
    refuse(field, text, "must be " + described(expected) + advice(name, unit.powers, expected));
  }
  if (unit.powers.radian != expected.radian && unit.counts_minutes) {
    refuse(field, text,
           "must be " + described(expected) +
               "; per minute may mean rad or turns, write rpm, rev/min or rad/min");
  }
}

/// The value of a number, or of a fraction of two.
double number_or_fraction(std::string_view field, std::string_view text,
                          std::string_view permitted) {
  const std::string_view trimmed_text = trimmed(text);
  if (trimmed_text == "inf" || trimmed_text == "+inf") {
    return std::numeric_limits<double>::infinity();
  }
  const Fraction fraction = fraction_in(trimmed_text);
  const std::optional<double> numerator = decimal(fraction.above);
  const std::optional<double> denominator = decimal(fraction.below);
  if (!numerator || !denominator) refuse(field, text, std::string(permitted));
  if (*denominator == 0.0) refuse(field, text, "must not be divided by 0");
  const double value = *numerator / *denominator;
  if (!std::isfinite(value)) refuse(field, text, "must be a number from -1e308 to 1e308");
  return value + 0.0;
}

/// Whether `c` is a control character or another one that would break or disguise a line.
bool is_unfit_for_line(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029 ||
         (c >= 0x200B && c <= 0x200F) || (c >= 0x202A && c <= 0x202E) ||
         (c >= 0x2066 && c <= 0x2069) || c == 0xFEFF;
}

std::string hexadecimal(std::uint32_t value, std::size_t digits) {
  std::string text(digits, '0');
  for (std::size_t i = digits; i-- > 0; value >>= 4U) text[i] = "0123456789abcdef"[value & 0xFU];
  return text;
}

std::string escaped(char32_t c) {
  if (c == '\n') return "\\n";
  if (c == '\r') return "\\r";
  if (c == '\t') return "\\t";
  return c < 0x80 ? "\\x" + hexadecimal(c, 2) : "\\u" + hexadecimal(c, 4);
}

/// Whether `text` is a fraction of two decimals that is not proved to be the shortest decimal of
/// its double: both and the quotient must be exact in few decimals.
bool is_inexact_fraction(std::string_view text) {
  const Fraction fraction = fraction_in(text);
  const std::optional<double> above = decimal(fraction.above);
  const std::optional<double> below = decimal(fraction.below);
  if (!fraction.has_bar || !above || !below || *below == 0.0) return false;
  const double quotient = *above / *below;
  return !is_short_decimal(*above) || !is_short_decimal(*below) || !is_short_decimal(quotient) ||
         std::fma(quotient, *below, -*above) != 0.0;
}

std::string_view without_sign(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return text;
}

/// The value of a number or a fraction over 10^power. It is above 1 if these are, also where their
/// double is 1.
double not_down_to_one(double value, std::string_view text, int power) {
  if (value != 1.0) return value;
  const Fraction fraction = fraction_in(text);
  const bool is_larger =
      is_above(without_sign(fraction.above), without_sign(fraction.below), power);
  return is_larger ? std::nextafter(1.0, 2.0) : 1.0;
}

/// "/min", as in "1000/min"; "/2 rad" is half of a fraction.
bool is_reciprocal(std::string_view unit) {
  const std::string_view rest = unit.starts_with('/') ? trimmed(unit.substr(1)) : "";
  return !rest.empty() && !(rest[0] >= '0' && rest[0] <= '9');
}

}  // namespace

std::string with_unit(const Dimension& dimension) {
  return with_article(dimension) + " with its unit";
}

std::string described(const Dimension& dimension) {
  return with_article(dimension) + such_as(dimension);
}

Measured read_quantity(std::string_view field, std::string_view text, const Dimension& expected) {
  const std::string_view trimmed_text = trimmed(text);
  const std::size_t length = number_length(trimmed_text);
  const std::string_view name = trimmed(trimmed_text.substr(length));
  if (length > 0 && name.empty() && decimal(trimmed_text) == 0.0) {
    return {.si = 0.0, .unit = std::string(expected.unit)};  // in every unit
  }
  if (length == 0 || name.empty()) {
    const bool is_limit = trimmed_text.starts_with('<') || trimmed_text.starts_with("≤");
    refuse(field, text,
           "must be " + with_unit(expected) + such_as(expected) +
               (is_limit ? "; a limit is a range, { min = \"…\", max = \"…\" }" : ""));
  }
  if (name.starts_with(',')) {
    refuse(field, text, "must be " + described(expected) + "; the decimal sign is a point");
  }
  try {
    const Unit unit = read_unit(is_reciprocal(name) ? "1" + std::string(name) : std::string(name));
    require_dimension(field, text, name, unit, expected);
    const double number = *decimal(trimmed_text.substr(0, length));
    const double value = number * unit.factor;
    const bool vanished = value == 0.0 && number != 0.0;
    if (!std::isfinite(value) || !std::isnormal(unit.factor) || vanished) {
      refuse(field, text, "must be a number from 1e-308 to 1e308 in SI units, or zero");
    }
    // No negative zero: the ratio of two inertias must not be −infinity.
    return {.si = value + 0.0, .unit_in_si = unit.factor, .unit = std::string(name)};
  } catch (const NotAUnit& problem) {
    refuse(field, text, "must be " + described(expected) + "; " + problem.what());
  }
}

[[noreturn]] void refuse(std::string_view field, std::string_view text, std::string permitted) {
  throw InvalidInput({{std::string(field), shown(text), std::move(permitted)}});
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + separator.size());
  }
}

double to_si(std::string_view field, std::string_view text, const Dimension& expected) {
  return read_quantity(field, text, expected).si;
}

double read_number(std::string_view field, std::string_view text) {
  return number_or_fraction(field, text,
                            "must be a number without unit, such as 0.25, 1e-3 or 1/9");
}

double read_part(std::string_view field, std::string_view text) {
  return not_down_to_one(read_number(field, text), text, 0);
}

double read_share(std::string_view field, std::string_view text) {
  constexpr double percent = 100.0;
  constexpr std::string_view permitted = "must be a number without unit, such as 0.25 or \"25 %\"";
  std::string_view number = trimmed(text);
  const bool is_percent = number.ends_with('%');
  if (is_percent) number.remove_suffix(1);
  const double value = number_or_fraction(field, number, permitted);
  return not_down_to_one(is_percent ? value / percent : value, number, is_percent ? 2 : 0);
}

std::optional<double> bare_number(std::string_view text) {
  try {
    return read_number("", text);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

bool has_long_decimal(std::string_view written) {
  std::string plain(written);
  std::erase(plain, '_');
  std::string_view text = trimmed(plain);
  if (is_inexact_fraction(text)) return true;
  while (!text.empty()) {
    const std::size_t length = number_length(text);
    std::string_view number = text.substr(0, length);
    if (number.starts_with('+')) number.remove_prefix(1);
    if (length > 0 && is_long_decimal(number)) return true;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return false;
}

std::uint64_t read_whole(std::string_view field, std::string_view text, std::uint64_t least,
                         std::uint64_t most) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  if (is_whole && number >= least && number <= most) return number;
  refuse(field, text,
         "must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
}

Measured read_measured(std::string_view field, std::string_view text, const Dimension& expected) {
  const std::optional<double> bare = bare_number(text);
  if (!bare) return read_quantity(field, text, expected);
  if (!std::isfinite(*bare)) refuse(field, text, "must be finite");
  return {.si = *bare, .unit = std::string(expected.unit)};
}

AngleUnit angle_unit_of(const Measured& angle) {
  return {.name = angle.unit, .radians = angle.unit_in_si};
}

std::string shown(std::string_view text, std::size_t limit) {
  if (trimmed(text).empty()) return "\"" + std::string(text.substr(0, limit)) + "\"";
  std::string result;
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == limit) return result + "…";
    const std::string_view before = text;
    const std::optional<char32_t> c = take_code_point(text);
    if (!c) {
      result += "\\x" + hexadecimal(static_cast<unsigned char>(text[0]), 2);
      text.remove_prefix(1);
    } else if (is_unfit_for_line(*c)) {
      result += escaped(*c);
    } else {
      result += before.substr(0, before.size() - text.size());
    }
  }
  return result;
}

}  // namespace gearlash
