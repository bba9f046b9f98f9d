// UTF-8, one code point at a time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearlash {

/// Removes and returns the first code point of `text`. Returns nothing and leaves `text` unchanged
/// if it is empty or does not begin with valid UTF-8 (truncated, overlong, a surrogate, above
/// U+10FFFF).
std::optional<char32_t> take_code_point(std::string_view& text);

/// The text with every byte that is not of UTF-8 read as Latin-1.
std::string as_utf8(std::string_view text);

}  // namespace gearlash
