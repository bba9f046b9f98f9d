// Converts decimal numbers to doubles, independently of locale and standard library.
#pragma once

#include <optional>
#include <string_view>

namespace gearlash {

/// The double nearest to a decimal number ([-] digits [. digits] [e [+-] digits]) that is the whole
/// of `text`. Empty if no normal or subnormal double holds it. Precondition: `text` is such a
/// number.
std::optional<double> nearest_double(std::string_view text);

}  // namespace gearlash
