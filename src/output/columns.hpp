// Text laid out in the columns of a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gearlash {

/// Columns that the text takes: bytes that continue a UTF-8 character take none.
std::size_t width_in_columns(const std::string& text);

/// Rows of cells, their columns lined up, two blanks before each; no blanks at the ends of lines.
std::string table_text(const std::vector<std::vector<std::string>>& rows);

/// The lines of a paragraph, at most 92 columns each, broken between words; ends with a new line.
std::string wrapped(const std::string& paragraph);

}  // namespace gearlash
