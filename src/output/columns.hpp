// Text laid out in the columns of a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gearlash {

/// The number of columns that the text takes; bytes that continue a UTF-8 character take none.
std::size_t width_in_columns(const std::string& text);

/// Rows of cells in aligned columns, two blanks before each, no blanks at the ends of lines.
std::string table_text(const std::vector<std::vector<std::string>>& rows);

/// The paragraph broken between words into lines of at most so many columns; ends with a newline.
std::string wrapped(const std::string& paragraph, std::size_t columns = 92);

}  // namespace gearlash
