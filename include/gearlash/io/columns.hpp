// Text laid out in the columns of a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace gearlash {

/// Columns that the text takes: bytes that continue a UTF-8 character take none.
std::size_t width_in_columns(const std::string& text);

/// The lines of a paragraph, at most 92 columns each, broken between words; ends with a new line.
std::string wrapped(const std::string& paragraph);

}  // namespace gearlash
