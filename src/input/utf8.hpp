// UTF-8, one code point at a time.
#pragma once

#include <optional>
#include <string_view>

namespace gearlash {

/// Takes the first code point off `text`. Empty, with nothing taken, where the bytes are not UTF-8
/// (truncated, overlong, a surrogate, above U+10FFFF) or there are none.
std::optional<char32_t> take_code_point(std::string_view& text);

}  // namespace gearlash
