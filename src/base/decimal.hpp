// Converts decimal numbers to doubles and back, independently of locale and standard library.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gearlash {

/// The double nearest to a decimal number ([-] digits [. digits] [e [+-] digits]) that is the whole
/// of `text`. Empty if no normal or subnormal double holds it. Precondition: `text` is such a
/// number.
std::optional<double> nearest_double(std::string_view text);

/// The shortest decimal that reads back as a finite `value`, as std::to_chars() writes it: "0.3",
/// "1e-07", "6.02214076e+23".
std::string shortest_text(double value);
/// The same with an exponent always: "3e-01".
std::string shortest_scientific_text(double value);
/// With so many significant digits, 1 to 17, as printf's %g.
std::string rounded_text(double value, int digits);

/// digits · 10^exponent.
struct Decimal {
  std::uint64_t digits = 0;
  int exponent = 0;

  bool operator==(const Decimal&) const = default;
};

/// What shortest_text() writes: at most 17 digits, the last of them not 0. Precondition: `value` is
/// finite and not negative.
Decimal shortest_decimal(double value);

/// In twenty significant digits: "5.0000000000000000000e-01". is_long_decimal() holds of it.
std::string long_text(double value);

/// Whether a decimal number, as nearest_double() takes it, may be another number than the shortest
/// one that its double has: its digits are others, or more than seventeen, zeros at its end
/// included. Precondition: `text` is such a number.
bool is_long_decimal(std::string_view text);

/// Whether one decimal number is above another one times 10^power, exactly. Precondition: the texts
/// are such numbers, and not negative.
bool is_above(std::string_view one, std::string_view other, int power = 0);

/// Whether a double is itself a decimal of at most fifteen digits after the point.
bool is_short_decimal(double value);

namespace by_trial {

// What the above do where the standard library writes no doubles: they print ever more digits until
// the text reads back. The locale must be that of C, as in a browser.
std::string shortest_text(double value);
std::string shortest_scientific_text(double value);
std::string rounded_text(double value, int digits);
std::string long_text(double value);

}  // namespace by_trial

}  // namespace gearlash
