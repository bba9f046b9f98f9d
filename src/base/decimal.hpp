// Decimal numbers into doubles, whatever the locale and the standard library.
#pragma once

#include <optional>
#include <string_view>

namespace gearlash {

/// The double nearest to a decimal number ([-] digits [. digits] [e [+-] digits]) that is the whole
/// of `text`. Nothing where no normal or subnormal double holds it. Precondition: `text` is one.
std::optional<double> nearest_double(std::string_view text);

}  // namespace gearlash
