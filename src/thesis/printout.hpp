// Numbers as the thesis prints them, and its Table II.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "thesis/program_1960.hpp"

namespace gearlash::thesis {

/// Eight decimal digits d and an exponent: ±.dddddddd × 10^exponent; zero has neither.
struct PrintedNumber {
  std::int32_t digits = 0;  ///< with the sign
  int exponent = 0;

  bool operator==(const PrintedNumber&) const = default;
};

/// The exact value truncated to eight digits.
PrintedNumber printed_number(double value);
/// As in Table II: "77040630- 1", "15278417", "10086982 1"; a number's sign stands before it.
std::string printed_text(const PrintedNumber& number);
/// The distance of a value from a printed number, in units of its eighth digit.
double units_apart(double value, const PrintedNumber& printed);

/// Time, motor speed, motor position, load speed, load position.
using PrintedRow = std::array<PrintedNumber, 5>;
PrintedRow printed_row(const PrintedLine& line);

/// The 38 lines of Table II as transcribed from the thesis (src/thesis/data/table-2.txt).
const std::vector<PrintedRow>& thesis_table_2();

/// The counts of a printout's numbers that equal those of 1960 and that are within one unit of the
/// eighth digit, and descriptions of the differing ones.
struct Reproduction {
  int exact = 0;
  int within_one = 0;
  std::vector<std::string> near = {};    ///< off by one
  std::vector<std::string> others = {};  ///< farther off
};

/// Compares the first lines of a printout, at most as many as Table II has.
Reproduction reproduction_of(const std::vector<PrintedLine>& lines);

/// The first lines that the program prints with these parameters.
template <class Number>
std::vector<PrintedLine> printout(const ProgramParameters& parameters, std::size_t lines,
                                  const Mending& mending = {}) {
  Program1960<Number> program(parameters, mending);
  std::vector<PrintedLine> printed;
  while (printed.size() < lines) {
    program.step([&](const PrintedLine& line) { printed.push_back(line); });
  }
  printed.resize(lines);
  return printed;
}

}  // namespace gearlash::thesis
