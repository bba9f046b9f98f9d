// Tables as CSV that pandas, a spreadsheet and gnuplot open as they are.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/output_file.hpp"

namespace gearlash {

/// A row of column names, then rows of cells, with nothing above or below them (RFC 4180, lines end
/// with "\n"). Names have the unit at their end, "time_s". Each row goes to the sink as it ends: a
/// table of ten million rows is never held in memory.
class CsvTable {
 public:
  /// Writes the row of names. Precondition: at least one.
  CsvTable(TextSink sink, const std::vector<std::string>& columns);

  /// The shortest number that reads back exactly; "inf"; empty for NaN, which is "not known".
  CsvTable& cell(double value);
  CsvTable& cell(const std::optional<double>& value);
  CsvTable& cell(std::integral auto value) { return plain(std::to_string(value)); }
  /// In quotes where it has to be.
  CsvTable& cell(std::string_view text);
  CsvTable& cell(const char* text) { return cell(std::string_view(text)); }

  /// Throws std::logic_error where the row has not as many cells as there are columns.
  void end_row();

  /// A whole row.
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
  std::size_t cells_ = 0;  ///< of the row under way
};

}  // namespace gearlash
