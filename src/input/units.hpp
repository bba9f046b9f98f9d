// Quantities as engineers write them ("28.2 ozf in/A", "12 arcmin"), into SI.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "model/dimension.hpp"

namespace gearlash {

struct Measured {
  double si = 0.0;          ///< in the SI unit of the dimension asked for
  double unit_in_si = 1.0;  ///< one of the author's units, in SI
  std::string unit = {};    ///< the unit as the author wrote it
};

/// Reads "<number> <unit>". The number is a decimal one with a point, whatever the locale; the unit
/// is a product or quotient of powers of UDUNITS-2's units and the aliases of docs/data-sheets.md
/// ("oz in2", "oz-in^2", "N·m/A", "mNm/A", "V/(rad/s)", "V/krpm").
///
/// Beyond UDUNITS: oz is the avoirdupois ounce (a mass), Hz is 2π rad/s (cycles per second), and
/// nothing is converted by its reciprocal, an offset or a logarithm. Where a radian may be left
/// out, time must then be in seconds, since "V min" could be per rad/min or per rpm.
///
/// Throws InvalidInput with one fault, of `field`, for a text that is no number and unit,
/// for an unknown unit, another dimension, or a value that is not representable.
Measured read_quantity(std::string_view field, std::string_view text, const Dimension& expected);

/// read_quantity(…).si
double to_si(std::string_view field, std::string_view text, const Dimension& expected);

/// A dimensionless number: decimal ("0.19", "1e-3"), a fraction of two ("1/9", "43:1"), or "inf".
/// Throws InvalidInput with one fault, of `field`, for anything else (NaN, hexadecimal, 1e999,
/// 1/0).
double read_number(std::string_view field, std::string_view text);

/// The number that `text` is, as read_number() has it; nothing where it is none, or has a unit.
std::optional<double> bare_number(std::string_view text);

/// A whole number without sign, fraction or exponent. Throws InvalidInput, of `field`, for anything
/// else and outside `least` to `most`.
std::uint64_t read_whole(std::string_view field, std::string_view text, std::uint64_t least,
                         std::uint64_t most);

/// A finite angle: a number of radians, or a number with its unit ("12 arcmin"). Throws as
/// read_number() and read_quantity() do.
Measured read_angle(std::string_view field, std::string_view text);

/// Author's text made fit for one line of an error: control characters and invalid UTF-8 escaped,
/// an empty or blank text quoted, at most `limit` characters and then "…".
std::string shown(std::string_view text, std::size_t limit = 60);

/// Throws InvalidInput with one fault, of what `field` has been given.
[[noreturn]] void refuse(std::string_view field, std::string_view text, std::string permitted);

/// Without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

/// The trimmed parts between separators, one at least.
std::vector<std::string_view> split(std::string_view text, std::string_view separator);

/// The unit in which an author thinks of angles.
struct AngleUnit {
  std::string name = "rad";  ///< as written: "arcmin", "deg", "mrad", …
  double radians = 1.0;      ///< one of it, > 0

  /// `angle` (rad) in this unit.
  double from_radians(double angle) const { return angle / radians; }

  bool operator==(const AngleUnit&) const = default;
};

}  // namespace gearlash
