// Text laid out in the columns of a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gearlash {

/// The number of columns that the text takes; bytes that continue a UTF-8 character take none.
std::size_t width_in_columns(const std::string& text);

/// The cells of rows. A row may end early.
using TextRow = std::vector<std::string>;
using TextRows = std::vector<TextRow>;

/// Rows of cells in aligned columns, two blanks before each, no blanks at the ends of lines.
std::string table_text(const TextRows& rows);

/// The paragraph broken between words into lines of at most so many columns, each after a prefix;
/// ends with a newline.
inline constexpr std::size_t usual_columns = 92;
std::string wrapped(const std::string& paragraph, std::size_t columns = usual_columns,
                    const std::string& prefix = "");
/// The paragraph of these sentences, of which some may be empty; nothing if all are.
std::string sentences(const std::vector<std::string>& parts);
/// An empty line and the paragraph; nothing if it is empty.
std::string further_paragraph(const std::string& paragraph);

}  // namespace gearlash
