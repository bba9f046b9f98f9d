#include "thesis/listing.hpp"

#include <fmt/format.h>

#include <sstream>

#include "thesis/machine_1604.hpp"
#include "thesis/thesis_data.hpp"

namespace gearlash::thesis {
namespace {

constexpr std::size_t half_word_digits = 8;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, '\t');) cells.push_back(cell);
  cells.resize(7);
  return cells;
}

bool is_pseudo(const std::string& operation) {
  return operation == "DEC" || operation == "DECq" || operation == "OCT" || operation == "BSS" ||
         operation == "EQU";
}

/// The symbolic columns: label, operation, designator, operand, remark. Columns of
/// pseudo-operations may be shifted to the left or right in the scan.
Statement statement_of(const std::vector<std::string>& cells, std::size_t line) {
  Statement statement;
  statement.line = line;
  if (cells[4] == "REM" || cells[4] == "ORG") {
    statement.operation = cells[4];
    statement.operand = cells[5];
    return statement;
  }
  statement.label = cells[2];
  statement.operation = cells[3] == "DECq" ? "DEC" : cells[3];  // a speck of the scan
  if (is_pseudo(cells[3])) {
    statement.operand = cells[4].empty() ? cells[5] : cells[4];
    return statement;
  }
  statement.designator = cells[4];
  statement.operand = cells[5];
  statement.remark = cells[6];
  // The scan has run a remark together with the operand. Names are in capitals, remarks are not.
  const std::size_t small = statement.operand.find_first_of("abcdefghijklmnopqrstuvwxyz");
  if (small != std::string::npos) {
    const std::size_t blank = statement.operand.rfind(' ', small);
    const std::size_t begin = blank == std::string::npos ? 0 : blank + 1;
    statement.remark = statement.operand.substr(begin);
    statement.operand.resize(blank == std::string::npos ? 0 : blank);
  }
  return statement;
}

class Reader {
 public:
  Listing read() {
    std::istringstream lines{std::string(table_1_text)};
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (!line.starts_with('#')) take(cells_of(line), number);
    }
    return std::move(listing_);
  }

 private:
  void take(const std::vector<std::string>& cells, std::size_t line) {
    if (!cells[0].empty()) address_ = static_cast<unsigned>(std::stoul(cells[0], nullptr, 8));
    std::string octal = cells[1];
    std::erase(octal, ' ');
    if (octal.size() == half_word_digits) {
      const Word half = std::stoull(octal, nullptr, 8);
      Word& word = listing_.octal[address_];
      word = cells[0].empty() ? word | half : half << half_word;
    } else if (!octal.empty()) {
      listing_.octal[address_] = std::stoull(octal, nullptr, 8);
    }
    const Statement statement = statement_of(cells, line);
    const bool second_half_of_number = cells[0].empty() && statement.text().empty();
    if (!second_half_of_number) listing_.program.push_back(statement);
  }

  Listing listing_;
  unsigned address_ = 0;
};

}  // namespace

const Listing& thesis_table_1() {
  static const Listing listing = Reader().read();
  return listing;
}

std::vector<ListingDifference> differences_of_listing() {
  const Listing& listing = thesis_table_1();
  const Assembly assembly = assemble(listing.program);
  std::vector<ListingDifference> differences;
  for (const auto& [address, listed] : listing.octal) {
    const auto word = assembly.words.find(address);
    const Word assembled = word == assembly.words.end() ? 0 : word->second;
    if (assembled == listed) continue;
    const auto source = assembly.sources.find(address);
    differences.push_back(
        {address, listed, assembled, source == assembly.sources.end() ? "" : source->second});
  }
  return differences;
}

const Assembly& runge() {
  static const Assembly assembly = assemble(read_program(runge_text));
  return assembly;
}

std::string octal_text(Word word) {
  const auto half = [](const Instruction& instruction) {
    return fmt::format("{:02o} {:o} {:05o}", instruction.operation, instruction.designator,
                       instruction.operand);
  };
  return half(upper_instruction(word)) + "  " + half(lower_instruction(word));
}

}  // namespace gearlash::thesis
