#include <algorithm>
#include <sstream>
#include <utility>

#include "base/lists.hpp"
#include "gearlash/output.hpp"

namespace gearlash {

std::size_t width_in_columns(const std::string& text) {
  return count_of(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

std::string table_text(const TextRows& rows) {
  std::vector<std::size_t> widths;
  for (const TextRow& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], width_in_columns(row[i]));
    }
  }
  std::string text;
  for (const TextRow& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += "  " + row[i] + std::string(widths[i] - width_in_columns(row[i]), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string wrapped(const std::string& paragraph, std::size_t columns, const std::string& prefix) {
  std::string text;
  std::string line;
  std::istringstream words(paragraph);
  for (std::string word; words >> word;) {
    if (!line.empty() && width_in_columns(line) + 1 + width_in_columns(word) > columns) {
      text += prefix + line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + prefix + line + '\n';
}

std::string sentences(const std::vector<std::string>& parts) {
  const std::string paragraph = listed(parts, std::identity(), " ");
  return paragraph.empty() ? "" : wrapped(paragraph);
}

std::string further_paragraph(const std::string& paragraph) {
  return paragraph.empty() ? "" : "\n" + wrapped(paragraph);
}

// ---- a terminal's width -------------------------------------------------------------------------

namespace {

using Lines = std::vector<std::string>;

std::size_t indent_of(const std::string& line) {
  return std::min(line.find_first_not_of(' '), line.size());
}

/// The bytes of the first columns.
std::size_t bytes_of(const std::string& line, std::size_t columns) {
  std::size_t end = 0;
  while (end < line.size() && width_in_columns(line.substr(0, end + 1)) <= columns) ++end;
  return end;
}

/// Where the last cell begins, in bytes.
std::size_t last_cell(const std::string& line) {
  const std::size_t gap = line.rfind("  ");
  return gap == std::string::npos ? 0 : gap + 2;
}

/// Whether wrapped() broke a paragraph between the two lines.
bool is_continued(const std::string& line, const std::string& next) {
  const std::size_t width = width_in_columns(line);
  const std::string word = next.substr(0, next.find(' '));
  return !word.empty() && indent_of(line) == 0 && width <= usual_columns &&
         width + 1 + width_in_columns(word) > usual_columns;
}

/// Without the line breaks that wrapped() made in paragraphs, and that commands have for a shell.
Lines unwrapped(const std::string& text) {
  Lines lines;
  std::string last;  // as it stood
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line); last = line) {
    const bool is_command = last.ends_with(" \\");
    if (is_command) lines.back().pop_back();
    if (is_command || (!lines.empty() && is_continued(last, line))) {
      lines.back() += (is_command ? "" : " ") + line.substr(indent_of(line));
    } else {
      lines.push_back(line);
    }
  }
  return lines;
}

/// A command, broken outside of quotes so that it can be typed.
std::string folded_command(const std::string& command, std::size_t columns) {
  std::string text;
  std::string line(indent_of(command), ' ');
  std::string word;
  std::istringstream parts(command);
  for (std::string part; parts >> part;) {
    word += (word.empty() ? "" : " ") + part;
    if (std::count(word.begin(), word.end(), '"') % 2 != 0) continue;
    const std::size_t mark = 2;  // " \"
    if (width_in_columns(line + " " + word) + mark > columns) {
      text += line + " \\\n";
      line = std::string(indent_of(command) + 2, ' ');
    }
    line += (line.ends_with(' ') ? "" : " ") + std::exchange(word, "");
  }
  return text + line + '\n';
}

/// A row, its last cell folded: in its place, or where that is too far to the right, below.
std::string folded_row(const std::string& line, std::size_t columns) {
  constexpr std::size_t least_room = 24;
  if (width_in_columns(line) <= columns) return line + '\n';
  const std::size_t cell = std::max(last_cell(line), indent_of(line));
  std::string before = line.substr(0, cell);
  std::size_t indent = width_in_columns(before);
  std::string text;
  if (indent + least_room > columns) {
    indent = std::min<std::size_t>(indent, 6);
    before.erase(before.find_last_not_of(' ') + 1);
    if (!before.empty()) text = folded_row(before, columns);
    before = std::string(indent, ' ');
  }
  const std::string cell_text =
      wrapped(line.substr(cell), columns - indent, std::string(indent, ' '));
  return text + before + cell_text.substr(indent);
}

/// Where the columns of a table begin; last, the width and two blanks.
std::vector<std::size_t> column_starts(const Lines& rows) {
  std::vector<bool> is_used;
  for (const std::string& row : rows) {
    is_used.resize(std::max(is_used.size(), width_in_columns(row)));
    std::size_t column = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0 && width_in_columns(row.substr(i, 1)) > 0) ++column;
      if (row[i] != ' ') is_used[column] = true;
    }
  }
  std::vector<std::size_t> starts;
  for (std::size_t i = 2; i < is_used.size(); ++i) {
    if (is_used[i] && !is_used[i - 1] && !is_used[i - 2]) starts.push_back(i);
  }
  starts.push_back(is_used.size() + 2);
  return starts;
}

/// The columns from `first` to before `last` of each row, after its first column.
std::string columns_text(const Lines& rows, const std::vector<std::size_t>& starts,
                         std::size_t first, std::size_t last, std::size_t columns) {
  std::string text;
  for (const std::string& row : rows) {
    const std::size_t begin = bytes_of(row, starts[first]);
    const std::string cells = row.substr(begin, bytes_of(row, starts[last]) - begin);
    std::string line = first > 0 ? row.substr(0, bytes_of(row, starts[1])) : "  ";
    if (first > 0 && indent_of(cells) == cells.size()) continue;
    line.resize(line.size() + (first > 0 ? starts[1] - width_in_columns(line) : 0), ' ');
    line += cells;
    line.erase(line.find_last_not_of(' ') + 1);
    text += folded_row(line, columns);
  }
  return text;
}

/// A table: its rows folded, or groups of its columns below one another.
std::string folded_table(const Lines& rows, std::size_t columns) {
  constexpr std::size_t least_columns = 4;  // of a table that is divided
  const std::vector<std::size_t> starts = column_starts(rows);
  const std::size_t count = starts.size() - 1;
  if (count < least_columns || starts.back() <= columns + 2) {
    return listed(
        rows, [&](const std::string& row) { return folded_row(row, columns); }, "");
  }
  std::string text;
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    const std::size_t before = first > 0 ? starts[1] : starts[0];
    last = first + 1;
    while (last < count && before + starts[last + 1] - 2 - starts[first] <= columns) ++last;
    text += (first > 0 ? "\n" : "") + columns_text(rows, starts, first, last, columns);
  }
  return text;
}

}  // namespace

std::string fitted(const std::string& text, std::size_t columns) {
  std::string all;
  Lines table;
  const auto end_table = [&] {
    if (!table.empty()) all += folded_table(std::exchange(table, {}), columns);
  };
  for (const std::string& line : unwrapped(text)) {
    const std::size_t indent = indent_of(line);
    const bool is_command = indent > 0 && line.find("gearlash ", indent) == indent;
    const bool is_row = indent >= 2 && !is_command;
    if (is_row) {
      table.push_back(line);
      continue;
    }
    end_table();
    all += is_command ? folded_command(line, columns) : wrapped(line, columns);
  }
  end_table();
  return all;
}

}  // namespace gearlash
