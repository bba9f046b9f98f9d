// The grammar of products and quotients of units.
#pragma once

#include <stdexcept>
#include <string_view>

#include "input/unit_database.hpp"

namespace gearlash {

/// Why a text is not a unit; the text follows "must be …; " in an error line.
class NotAUnit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The unit that `text` stands for:
///
///   product := power (("*" | "." | "-" | "·" | blank) power | ("/" | "per") power)*
///   power   := word exponent? | "(" product ")" exponent? | number (after "/" or "(" only)
///   exponent := "2" | "-2" | "^2" | "^-2" | "**2" | "²" | "⁻²"     (−9 … 9)
///
/// read from left to right: a/b c is (a/b) c. UDUNITS-2's own grammar is not used, because it takes
/// numbers, logarithms, offsets and dates within a unit. Throws NotAUnit, also for a unit of more
/// than most_roundings.
Unit read_unit(std::string_view text);

/// The length of the decimal number that `text` begins with: [+-] digits [. digits] [e [+-] digits]
/// with a digit on either side of the point. 0 if there is none.
std::size_t number_length(std::string_view text);

}  // namespace gearlash
