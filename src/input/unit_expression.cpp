#include "input/unit_expression.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/decimal.hpp"
#include "gearlash/units.hpp"
#include "input/utf8.hpp"

namespace gearlash {
namespace {

constexpr std::size_t longest_unit = 100;  // bytes; bounds the depth of parentheses too

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether `c` is a letter of a unit's word. Non-ASCII bytes are letters: in_ascii_signs() has
/// replaced the other signs.
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

struct Spelling {
  char32_t code_point;
  std::string_view ascii;
};
constexpr std::array spellings = {
    Spelling{U'\u00B7', "*"},  Spelling{U'\u22C5', "*"},  // middle dot, dot operator
    Spelling{U'\u2219', "*"},  Spelling{U'\u2022', "*"},  // bullet operator, bullet
    Spelling{U'\u00D7', "*"},                             // multiplication sign
    Spelling{U'\u00A0', " "},  Spelling{U'\u2009', " "},  // no-break space, thin space
    Spelling{U'\u202F', " "},  Spelling{U'\u2212', "-"},  // narrow no-break space, minus sign
    Spelling{U'\u2044', "/"},  Spelling{U'\u2215', "/"},  // fraction slash, division slash
    Spelling{U'\u207B', "^-"},                            // superscript minus
    Spelling{U'\u00B9', "^1"}, Spelling{U'\u00B2', "^2"},
    Spelling{U'\u00B3', "^3"}, Spelling{U'\u2074', "^4"},
};

std::string_view ascii_spelling(char32_t code_point) {
  for (const Spelling& spelling : spellings) {
    if (spelling.code_point == code_point) return spelling.ascii;
  }
  return {};
}

/// Replaces typographic signs by ASCII: "N·m⁻¹" becomes "N*m^-1".
std::string in_ascii_signs(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::string_view before = text;
    const std::optional<char32_t> code_point = take_code_point(text);
    if (!code_point) throw NotAUnit("text must be UTF-8");
    const std::string_view ascii = ascii_spelling(*code_point);
    if (ascii.starts_with('^') && result.ends_with("^-")) {
      result += ascii.substr(1);
    } else if (!ascii.empty()) {
      result += ascii;
    } else {
      result += before.substr(0, before.size() - text.size());
    }
  }
  return result;
}

class UnitReader {
 public:
  explicit UnitReader(std::string_view rest) : rest_(rest) {}

  Unit whole() {
    skip_blanks();
    // "1/s" has only a divisor.
    const bool is_reciprocal = rest_.starts_with("1/") || rest_.starts_with("1 /");
    const Unit unit = product(is_reciprocal);
    if (!rest_.empty()) throw NotAUnit("a \")\" has no \"(\"");
    return unit;
  }

 private:
  Unit product(bool begins_with_number_allowed = false) {
    Unit result;
    result.multiply(power(begins_with_number_allowed), 1);
    while (skip_blanks(), !rest_.empty() && rest_[0] != ')') {
      if (take("/") || take("per ")) {
        result.multiply(power(true), -1);
      } else {
        const bool number_allowed = take("*");  // "0.5 kg * 9.81 m/s2"
        if (!number_allowed && !take(".")) take("-");
        result.multiply(power(number_allowed), 1);
      }
    }
    return result;
  }

  Unit power(bool number_allowed) {
    skip_blanks();
    if (take("(")) {
      const Unit inner = product(true);
      if (!take(")")) throw NotAUnit("a \"(\" has no \")\"");
      return raised(inner);
    }
    if (!rest_.empty() && is_digit(rest_[0])) {
      if (!number_allowed) {
        throw NotAUnit(
            "within a unit a number may only be a power, a divisor or after *: V/(1000 rpm)");
      }
      return number();
    }
    return word();
  }

  Unit number() {
    const std::size_t length = number_length(rest_);
    const std::optional<double> value = nearest_double(rest_.substr(0, length));
    if (!value || !(*value > 0.0))
      throw NotAUnit("a divisor or factor must be positive and finite");
    rest_.remove_prefix(length);
    Unit result;
    result.factor = *value;
    result.roundings = 1;
    return result;
  }

  /// The word's unit with its power. If several units are run together, the power applies to the
  /// last.
  Unit word() {
    std::size_t length = 0;
    while (length < rest_.size() && is_letter(rest_[length])) ++length;
    // The signs for minutes and seconds of arc are words of their own.
    if (length == 0 && (rest_.starts_with('\'') || rest_.starts_with('"'))) length = 1;
    if (length == 0) throw NotAUnit("there is no unit at \"" + shown(rest_, 20) + "\"");
    std::string text(rest_.substr(0, length));
    rest_.remove_prefix(length);
    if (text == "arc" && (rest_.starts_with("-") || rest_.starts_with(" "))) {  // arc-min, arc sec
      length = 1;
      while (length < rest_.size() && is_letter(rest_[length])) ++length;
      text += rest_.substr(1, length - 1);
      rest_.remove_prefix(length);
    }
    std::vector<Unit> units = find_units(text);
    if (units.empty()) throw NotAUnit("\"" + shown(text, 20) + "\" is no known unit");
    const bool sign_of_angle = text == "\u00B0" || text == "'" || text == "\"";
    if (sign_of_angle && !rest_.empty() && is_digit(rest_[0])) {
      throw NotAUnit("an angle takes one unit: 1.5\u00B0 or 90'");
    }
    units.back() = raised(units.back());
    Unit result;
    for (const Unit& unit : units) result.multiply(unit, 1);
    return result;
  }

  Unit raised(const Unit& base) {
    const bool announced = take("^") || take("**");
    const bool negative = rest_.size() > 1 && rest_[0] == '-' && is_digit(rest_[1]);
    const std::size_t digit = negative ? 1 : 0;
    if (rest_.size() <= digit || !is_digit(rest_[digit])) {
      if (announced) throw NotAUnit("\"^\" needs a whole number after it");
      return base;
    }
    if (rest_.size() > digit + 1 && is_digit(rest_[digit + 1])) {
      throw NotAUnit("powers go from -9 to 9");
    }
    const int exponent = (negative ? -1 : 1) * (rest_[digit] - '0');
    rest_.remove_prefix(digit + 1);
    Unit result;
    return result.multiply(base, exponent);
  }

  bool take(std::string_view sign) {
    if (!rest_.starts_with(sign)) return false;
    rest_.remove_prefix(sign.size());
    return true;
  }

  void skip_blanks() {
    while (rest_.starts_with(' ') || rest_.starts_with('\t')) rest_.remove_prefix(1);
  }

  std::string_view rest_;
};

}  // namespace

Unit read_unit(std::string_view text) {
  if (text.size() > longest_unit) {
    throw NotAUnit("a unit takes at most " + std::to_string(longest_unit) + " bytes");
  }
  const std::string ascii = in_ascii_signs(text);
  const Unit unit = UnitReader(ascii).whole();
  if (unit.roundings > most_roundings)
    throw NotAUnit("its factor has too many products to be exact");
  return unit;
}

std::size_t number_length(std::string_view text) {
  const auto digits_from = [&](std::size_t at) {
    while (at < text.size() && is_digit(text[at])) ++at;
    return at;
  };
  const auto sign_at = [&](std::size_t at) {
    return at < text.size() && (text[at] == '+' || text[at] == '-');
  };
  const std::size_t begin = sign_at(0) ? 1 : 0;
  std::size_t end = digits_from(begin);
  std::size_t digits = end - begin;
  if (end < text.size() && text[end] == '.') {
    const std::size_t fraction_end = digits_from(end + 1);
    digits += fraction_end - end - 1;
    end = fraction_end;
  }
  if (digits == 0) return 0;
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    const std::size_t exponent = sign_at(end + 1) ? end + 2 : end + 1;
    const std::size_t exponent_end = digits_from(exponent);
    if (exponent_end > exponent) end = exponent_end;
  }
  return end;
}

}  // namespace gearlash
