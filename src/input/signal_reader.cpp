#include "input/signal_reader.hpp"

#define CSV_IO_NO_THREAD  // small files
#include <libfccp/csv.h>

#include <cmath>

#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "model/signal.hpp"

namespace gearlash {
namespace {

constexpr std::size_t largest_table = 64 * 1024 * 1024;  ///< bytes

// ---- tables -------------------------------------------------------------------------------------

/// A column's head, "position (deg)", with the unit of its numbers.
struct Column {
  std::string field;
  double unit_in_si = 1.0;
};

Column read_head(const std::string& place, const std::string& head, const Dimension& dimension) {
  const std::size_t open = head.find('(');
  const std::size_t close = head.rfind(')');
  const std::string permitted = "must be a name and a unit of " + std::string(dimension.name) +
                                ", such as \"" + std::string(dimension.name) + " (" +
                                std::string(dimension.unit) + ")\"";
  if (open == std::string::npos || close == std::string::npos || close < open) {
    refuse(place, head, permitted);
  }
  const std::string unit = head.substr(open + 1, close - open - 1);
  return {place, to_si(place, "1 " + unit, dimension)};
}

double read_cell(const std::string& place, const std::string& text, const Column& column) {
  const double value = read_number(place, text) * column.unit_in_si;
  if (!std::isfinite(value)) refuse(place, text, "must be finite");
  return value;
}

[[noreturn]] void refuse_row(const std::string& name, int line, const char* found) {
  refuse(name + ":" + std::to_string(line) + ": row", found,
         "must have two columns, separated by a comma: times and values");
}

}  // namespace

TableSignal parse_signal_table(std::string_view text, const std::string& name,
                               const Dimension& values) {
  using Reader = io::CSVReader<2, io::trim_chars<' ', '\t'>, io::no_quote_escape<','>,
                               io::throw_on_overflow, io::single_line_comment<'#'>>;
  TableSignal table;
  try {
    Reader reader(name, text.data(), text.data() + text.size());
    reader.set_header("time", "value");
    std::string time;
    std::string value;
    const auto place = [&](const char* column) {
      return name + ":" + std::to_string(reader.get_file_line()) + ": " + column;
    };
    if (!reader.read_row(time, value)) {
      refuse(name, "an empty table", "must have a row of names and rows of numbers");
    }
    const Column times = read_head(place("first column"), time, dimensions::time);
    const Column second = read_head(place("second column"), value, values);
    while (reader.read_row(time, value)) {
      table.times.push_back(read_cell(place("time"), time, times));
      table.values.push_back(read_cell(place("value"), value, second));
      const std::size_t count = table.times.size();
      if (count > drive::most_rows_of_a_table) {
        refuse(name, "a table of more rows",
               "must have at most " + std::to_string(drive::most_rows_of_a_table) + " rows");
      }
      if (count > 1 && !(table.times[count - 1] > table.times[count - 2])) {
        refuse(place("time"), time, "must be later than in the row before");
      }
    }
  } catch (const io::error::too_few_columns& fault) {
    refuse_row(name, fault.file_line, "one column");
  } catch (const io::error::too_many_columns& fault) {
    refuse_row(name, fault.file_line, "more than two columns");
  } catch (const io::error::base& fault) {
    refuse(name, "a table that cannot be read", fault.what());
  }
  if (table.times.empty()) {
    refuse(name, "a table without rows", "must have at least one");
  }
  return table;
}

TableSignal read_signal_table(const std::filesystem::path& path, const Dimension& values) {
  return parse_signal_table(read_text_file(path, largest_table),
                            shown(path.string(), std::string_view::npos), values);
}

}  // namespace gearlash
