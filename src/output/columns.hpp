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

/// A text of such paragraphs and tables for a terminal of so many columns. Paragraphs are wrapped
/// again. A row that is too long is folded under its last cell; where that begins too far to the
/// right, the table is divided into groups of columns, each after the first column; a row of two
/// cells is folded between them. A command of the tool is folded for a shell, by "\\". Only a word
/// may be longer than a line. A text whose lines fit, and are no broken paragraphs, stays as it is.
std::string fitted(const std::string& text, std::size_t columns);

}  // namespace gearlash
