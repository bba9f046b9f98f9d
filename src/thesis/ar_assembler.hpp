// The parts of the school's assembler "AR" that Table I and our RUNGE need.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "thesis/float_1604.hpp"

namespace gearlash::thesis {

/// One line of symbolic code. Blanks within a name do not count ("JUMP 1" is JUMP1).
struct Statement {
  std::string label;
  std::string operation;  ///< mnemonic, two octal digits, empty (00), or DEC, OCT, BSS, EQU, ORG …
  std::string designator;
  std::string operand;  ///< number (octal; decimal after DEC), name, name+number, "/-1"
  std::string remark;
  std::size_t line = 0;  ///< in its file

  /// The assembled code on one line.
  std::string text() const;
};

struct Assembly {
  std::map<unsigned, Word> words;  ///< by address
  std::map<std::string, unsigned> symbols;
  std::map<unsigned, std::string> sources;  ///< the source of each word, "upper | lower"
};

/// Assembles in two passes: addresses of labels, then words. Instructions fill words from the upper
/// half. A label, a number, or the end of the program begins a new word, and ENI 0 0 fills the rest
/// of the old one. DEC with a point is a floating-point number, truncated to 36 bits; without a
/// point it is an integer. "/" is the address of its own word. Throws std::invalid_argument with
/// the line at fault.
Assembly assemble(const std::vector<Statement>& program);

/// Reads columns separated by tabs: label, operation, designator, operand, remark; "#" begins a
/// comment.
std::vector<Statement> read_program(std::string_view text);

}  // namespace gearlash::thesis
