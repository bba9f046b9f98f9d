// Tables as CSV that pandas, spreadsheets and gnuplot open directly.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/output.hpp"
#include "output/record.hpp"

namespace gearlash {

/// A row of column names, then rows of cells, and nothing else (RFC 4180, lines end with "\n").
/// Names end with the unit, as "time_s". Each row goes to the sink when it ends, so that a table of
/// ten million rows is never held in memory.
class CsvTable {
 public:
  /// Writes the row of names. Precondition: at least one.
  CsvTable(TextSink sink, const std::vector<std::string>& columns);

  /// The shortest number that reads back exactly; "inf"; empty for NaN, which means "not known".
  CsvTable& cell(double value);
  CsvTable& cell(const std::optional<double>& value);
  CsvTable& cell(std::integral auto value) { return plain(std::to_string(value)); }
  /// The text, quoted if CSV requires it.
  CsvTable& cell(std::string_view text);
  CsvTable& cell(const char* text) { return cell(std::string_view(text)); }

  /// Throws std::logic_error if the row's number of cells is not the number of columns.
  void end_row();

  /// Writes a whole row.
  template <class... Cells>
  void row(const Cells&... cells) {
    (cell(cells), ...);
    end_row();
  }

 private:
  CsvTable& plain(std::string_view text);

  TextSink sink_;
  std::string line_;
  std::size_t columns_ = 0;
  std::size_t cells_ = 0;  ///< of the current row
};

/// "motor_speed_rad_per_s": the name of a column with its SI unit; a bare number has none.
std::string column_in(std::string_view unit, std::string name);

/// A column for each number and text of a struct.
template <class Row>
void write_csv(const RowsOf<Row>& rows, const TextSink& sink) {
  std::vector<std::string> columns;
  records::for_each_leaf(Row{}, [&](const auto& member, const char* holder, const auto&) {
    columns.push_back(column_in(member.unit, leaf_name(member, holder)));
  });
  CsvTable table(sink, columns);
  rows.each([&](const Row& row) {
    records::for_each_leaf(row,
                           [&](const auto&, const char*, const auto& value) { table.cell(value); });
    table.end_row();
  });
}

}  // namespace gearlash
