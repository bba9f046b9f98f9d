#include "thesis/printout.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "thesis/thesis_data.hpp"

namespace gearlash::thesis {
namespace {

constexpr int digits_printed = 8;

/// "77040630- 1", or "15278417" with nothing after it.
PrintedNumber read_printed(const std::string& text) {
  const bool negative = text.starts_with('-');
  const std::size_t begin = negative ? 1 : 0;
  PrintedNumber number;
  number.digits = std::stoi(text.substr(begin, digits_printed));
  if (negative) number.digits = -number.digits;
  std::string exponent = text.substr(begin + digits_printed);
  std::erase(exponent, ' ');
  if (!exponent.empty()) number.exponent = std::stoi(exponent);
  return number;
}

std::vector<PrintedRow> read_table_2() {
  std::vector<PrintedRow> rows;
  std::istringstream lines{std::string(table_2_text)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    PrintedRow row;
    std::istringstream cells(line);
    for (PrintedNumber& number : row) {
      std::string cell;
      if (!std::getline(cells, cell, '\t')) throw std::logic_error("Table II: " + line);
      number = read_printed(cell);
    }
    rows.push_back(row);
  }
  return rows;
}

/// Adds the comparison of one row. `line` counts from 0.
void compare(const PrintedRow& printed, const PrintedRow& now, std::size_t line,
             Reproduction& result) {
  constexpr std::array names = {"time", "motor speed", "motor position", "load speed",
                                "load position"};
  for (std::size_t k = 0; k < printed.size(); ++k) {
    const bool same = printed[k] == now[k];
    // 99999999 and 1.0000000 are neighbours although their exponents differ.
    const double value = now[k].digits * std::pow(10.0, now[k].exponent - digits_printed);
    constexpr double one_and_rounding = 1.0 + 1e-6;
    const bool neighbours = std::abs(units_apart(value, printed[k])) <= one_and_rounding;
    result.exact += same ? 1 : 0;
    result.within_one += neighbours ? 1 : 0;
    if (same) continue;
    (neighbours ? result.near : result.others)
        .push_back(fmt::format("line {}, {}: {} here, {} in 1960", line + 1, names[k],
                               printed_text(now[k]), printed_text(printed[k])));
  }
}

}  // namespace

PrintedNumber printed_number(double value) {
  if (value == 0.0) return {};
  // More digits than a 36-bit fraction has, so that truncating them truncates the exact number.
  const std::string exact = fmt::format("{:.40e}", std::abs(value));  // d.ddd…e±xx
  const std::string digits = exact.substr(0, 1) + exact.substr(2, digits_printed - 1);
  const int exponent = std::stoi(exact.substr(exact.find('e') + 1)) + 1;
  const int whole = std::stoi(digits);
  return {value < 0.0 ? -whole : whole, exponent};
}

std::string printed_text(const PrintedNumber& number) {
  std::string text = fmt::format("{}{:08}", number.digits < 0 ? "-" : "", std::abs(number.digits));
  if (number.exponent == 0) return text;
  return text + (number.exponent < 0 ? fmt::format("-{:2}", -number.exponent)
                                     : fmt::format(" {}", number.exponent));
}

double units_apart(double value, const PrintedNumber& printed) {
  const double unit = std::pow(10.0, printed.exponent - digits_printed);
  return value / unit - printed.digits;
}

PrintedRow printed_row(const PrintedLine& line) {
  return {printed_number(line.time), printed_number(line.motor_speed),
          printed_number(line.motor_position), printed_number(line.load_speed),
          printed_number(line.load_position)};
}

Reproduction reproduction_of(const std::vector<PrintedLine>& lines) {
  Reproduction result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    compare(thesis_table_2()[i], printed_row(lines[i]), i, result);
  }
  return result;
}

const std::vector<PrintedRow>& thesis_table_2() {
  static const std::vector<PrintedRow> table = read_table_2();
  return table;
}

}  // namespace gearlash::thesis
