#include "thesis/ar_assembler.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "thesis/machine_1604.hpp"

namespace gearlash::thesis {
namespace {

constexpr unsigned fill_instruction = 050U << 18U;  // ENI 0 0

[[noreturn]] void refuse(const Statement& statement, const std::string& why) {
  throw std::invalid_argument(
      fmt::format("line {}: {}: {}", statement.line, statement.text(), why));
}

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

bool is_octal(std::string_view text) {
  return !text.empty() && text.find_first_not_of("01234567") == std::string_view::npos;
}

bool takes_a_word(const std::string& operation) {
  return operation == "DEC" || operation == "OCT" || operation == "BSS";
}

bool says_nothing(const std::string& operation) { return operation == "REM" || operation == "END"; }

class Assembler {
 public:
  explicit Assembler(const std::vector<Statement>& program) : program_(program) {}

  Assembly assemble() {
    pass(false);
    pass(true);
    return std::move(assembly_);
  }

 private:
  void pass(bool with_words) {
    writes_ = with_words;
    begin_word(0);
    for (const Statement& statement : program_) {
      if (!says_nothing(statement.operation)) take(statement);
    }
    finish_word();
  }

  void take(const Statement& statement) {
    const std::string label = without_blanks(statement.label);
    if (statement.operation == "ORG") {
      finish_word();
      begin_word(value(statement, statement.operand));
      return;
    }
    if (statement.operation == "EQU") {
      assembly_.symbols[label] = value(statement, statement.operand);
      return;
    }
    if (!label.empty() || takes_a_word(statement.operation)) finish_word();
    if (!label.empty()) assembly_.symbols[label] = address_;
    if (statement.operation == "BSS") {
      reserve(statement);
    } else if (takes_a_word(statement.operation)) {
      put_word(number(statement), statement.text());
    } else {
      put_half(half(statement), statement.text());
    }
  }

  void begin_word(unsigned address) {
    address_ = address;
    upper_.reset();
  }

  /// Fills the word that has only an upper instruction.
  void finish_word() {
    if (upper_) put_half(fill_instruction, "ENI 0 0");
  }

  void put_half(unsigned instruction, const std::string& source) {
    if (!upper_) {
      upper_ = instruction;
      upper_source_ = source;
      return;
    }
    const Word word = (Word{*upper_} << half_word) | instruction;
    upper_.reset();
    put_word(word, upper_source_ + " | " + source);
  }

  void put_word(Word word, const std::string& source) {
    if (writes_) {
      assembly_.words[address_] = word;
      assembly_.sources[address_] = source;
    }
    ++address_;
  }

  void reserve(const Statement& statement) {
    const unsigned count = value(statement, statement.operand);
    for (unsigned i = 0; i < count; ++i) put_word(0, statement.text());
  }

  static Word number(const Statement& statement) {
    const std::string text = without_blanks(statement.operand);
    try {
      if (statement.operation == "OCT") return std::stoull(text, nullptr, 8) & word_bits;
      if (text.find('.') != std::string::npos) return Float1604::truncated(std::stod(text)).word();
      return std::stoull(text) & word_bits;
    } catch (const std::logic_error&) {
      refuse(statement, "no number");
    }
  }

  unsigned half(const Statement& statement) {
    const std::string& name = statement.operation;
    std::optional<unsigned> operation = operation_of(name);
    if (name.empty()) operation = 0;
    if (!operation && is_octal(name))
      operation = static_cast<unsigned>(std::stoul(name, nullptr, 8));
    if (!operation) refuse(statement, "no operation");
    const unsigned designator =
        statement.designator.empty() ? 0 : value(statement, statement.designator);
    const unsigned operand = statement.operand.empty() ? 0 : value(statement, statement.operand);
    constexpr unsigned operation_place = 18;
    constexpr unsigned designator_place = 15;
    return (*operation << operation_place) | (designator << designator_place) | operand;
  }

  /// An octal number, a name, or "/" for the current address, each with a number added or
  /// subtracted.
  unsigned value(const Statement& statement, const std::string& written) {
    const std::string text = without_blanks(written);
    const std::size_t sign = text.find_first_of("+-", 1);
    const std::string base = text.substr(0, sign);
    int offset = 0;
    if (sign != std::string::npos) offset = std::stoi(text.substr(sign), nullptr, 8);
    return static_cast<unsigned>(base_value(statement, base) + offset);
  }

  int base_value(const Statement& statement, const std::string& base) {
    if (base == "/") return static_cast<int>(address_);
    if (is_octal(base)) return std::stoi(base, nullptr, 8);
    const auto symbol = assembly_.symbols.find(base);
    if (symbol != assembly_.symbols.end()) return static_cast<int>(symbol->second);
    if (writes_) refuse(statement, "the name " + base + " is not defined");
    return 0;
  }

  const std::vector<Statement>& program_;
  Assembly assembly_;
  bool writes_ = false;
  unsigned address_ = 0;
  std::optional<unsigned> upper_;
  std::string upper_source_;
};

}  // namespace

std::string Statement::text() const {
  std::string result;
  for (const std::string* part : {&operation, &designator, &operand}) {
    if (!part->empty()) result += (result.empty() ? "" : " ") + *part;
  }
  return result;
}

Assembly assemble(const std::vector<Statement>& program) { return Assembler(program).assemble(); }

std::vector<Statement> read_program(std::string_view text) {
  std::vector<Statement> program;
  std::istringstream lines{std::string(text)};
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line.starts_with('#')) continue;
    Statement statement;
    statement.line = number;
    std::istringstream cells(line);
    for (std::string* cell : {&statement.label, &statement.operation, &statement.designator,
                              &statement.operand, &statement.remark}) {
      std::getline(cells, *cell, '\t');
    }
    program.push_back(std::move(statement));
  }
  return program;
}

}  // namespace gearlash::thesis
