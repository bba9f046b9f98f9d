#include "output/csv_table.hpp"

#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/range_check.hpp"

namespace gearlash {

CsvTable::CsvTable(TextSink sink, const std::vector<std::string>& columns)
    : sink_(std::move(sink)), columns_(columns.size()) {
  for (const std::string& name : columns) cell(name);
  end_row();
}

CsvTable& CsvTable::cell(double value) { return plain(std::isnan(value) ? "" : exact_text(value)); }

CsvTable& CsvTable::cell(const std::optional<double>& value) {
  return value ? cell(*value) : plain("");
}

CsvTable& CsvTable::cell(std::string_view text) {
  const bool has_blank_end = text.starts_with(' ') || text.ends_with(' ');
  if (!has_blank_end && text.find_first_of(",\"\r\n") == std::string_view::npos) return plain(text);
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c;
    if (c == '"') quoted += c;
  }
  return plain(quoted + '"');
}

CsvTable& CsvTable::plain(std::string_view text) {
  if (cells_ > 0) line_ += ',';
  line_ += text;
  ++cells_;
  return *this;
}

void CsvTable::end_row() {
  if (cells_ != columns_) throw std::logic_error("a row with another number of cells");
  line_ += '\n';
  sink_(line_);
  line_.clear();
  cells_ = 0;
}

std::string column_in(std::string_view unit, std::string name) {
  if (unit.empty() || unit == "1") return name;
  name += '_';
  for (const char c : unit) {
    if (c == '/') name += "_per_";
    if (c == ' ') name += '_';
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  }
  return name;
}

}  // namespace gearlash
