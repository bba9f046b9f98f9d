#include "output/columns.hpp"

#include <algorithm>
#include <sstream>

#include "base/lists.hpp"

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

}  // namespace gearlash
