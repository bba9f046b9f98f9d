// Converting quantities as engineers write them ("28.2 ozf in/A", "12 arcmin") to SI.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "gearlash/drive.hpp"
#include "model/dimension.hpp"

namespace gearlash {

struct Measured {
  double si = 0.0;          ///< in the SI unit of the expected dimension
  double unit_in_si = 1.0;  ///< the author's unit in SI
  std::string unit = {};    ///< the unit as the author wrote it
};

/// Reads "<number> <unit>", or a plain 0, which needs no unit. The number is decimal with a point,
/// in every locale. The unit is a product or quotient of powers of UDUNITS-2's units and the
/// aliases of docs/reference/data-sheets.md ("oz in2", "oz-in^2", "N·m/A", "mNm/A", "V/(rad/s)",
/// "V/krpm").
///
/// Differences from UDUNITS: oz is the avoirdupois ounce (a mass), Hz is 2π rad/s (cycles per
/// second), and reciprocals, offsets and logarithms are not converted. A dimension that may omit
/// the radian then requires time in seconds, because "V min" could be per rad/min or per rpm.
///
/// Throws InvalidInput with one fault, of `field`, for text that is not a number and a unit, for an
/// unknown unit or another dimension, for one of so many factors that it loses digits, and for a
/// value that no double represents.
Measured read_quantity(std::string_view field, std::string_view text, const Dimension& expected);

/// "an angle with its unit".
std::string with_unit(const Dimension& dimension);
/// "an angle, such as 12 arcmin".
std::string described(const Dimension& dimension);

/// read_quantity(…).si
double to_si(std::string_view field, std::string_view text, const Dimension& expected);

/// Reads a dimensionless number: decimal ("0.19", "1e-3"), a fraction of two ("1/9", "43:1"), or
/// "inf". Throws InvalidInput with one fault, of `field`, for anything else (NaN, hexadecimal,
/// 1e999, 1/0).
double read_number(std::string_view field, std::string_view text);

/// Reads the text of a number without unit, as read_number() does.
using NumberText = double (*)(std::string_view field, std::string_view text);

/// read_number() of one that must not exceed 1: above 1, however little, it is not read as 1.
double read_part(std::string_view field, std::string_view text);

/// read_part() of a share, which may be in percent: "0.72", "72 %".
double read_share(std::string_view field, std::string_view text);

/// read_number(), but nothing for text that is not a number or has a unit.
std::optional<double> bare_number(std::string_view text);

/// Whether a number in a text may be another one than the shortest decimal of the double that it is
/// read as: is_long_decimal() of any number in it, which may have TOML's underscores, or a fraction
/// that is not a short decimal, such as "1/3".
bool has_long_decimal(std::string_view written);

/// Reads a whole number without sign, fraction or exponent. Throws InvalidInput, of `field`, for
/// anything else and for numbers outside `least` to `most`.
std::uint64_t read_whole(std::string_view field, std::string_view text, std::uint64_t least,
                         std::uint64_t most);

/// Reads a finite number in SI, or one with its unit ("12 arcmin"). Throws as read_number() and
/// read_quantity() do.
Measured read_measured(std::string_view field, std::string_view text, const Dimension& expected);

/// The unit of an angle as its author has it.
AngleUnit angle_unit_of(const Measured& angle);

/// The author's text, fit for one line of an error: control characters and invalid UTF-8 are
/// escaped, empty or blank text is quoted, and text beyond `limit` characters becomes "…".
std::string shown(std::string_view text, std::size_t limit = 60);

/// Throws InvalidInput with one fault: `field` has the value `text`.
[[noreturn]] void refuse(std::string_view field, std::string_view text, std::string permitted);

/// The text without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

/// The trimmed parts between separators, at least one.
std::vector<std::string_view> split(std::string_view text, std::string_view separator);

}  // namespace gearlash
