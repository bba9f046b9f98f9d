// The assembler "AR" of the school, as far as Table I and our RUNGE need it.
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
  std::size_t line = 0;  ///< of the file it stands in

  /// What is assembled, on one line.
  std::string text() const;
};

struct Assembly {
  std::map<unsigned, Word> words;  ///< by address
  std::map<std::string, unsigned> symbols;
  std::map<unsigned, std::string> sources;  ///< what each word is made of, "upper | lower"
};

/// Two passes: addresses of labels, then words. Instructions fill words from the upper half; a
/// label, a number, or the end of the program begins a new word, what is left of the old one being
/// filled with ENI 0 0. DEC with a point is a floating-point number, cut off to 36 bits; without,
/// an integer. "/" is the address of the word it stands in. Throws std::invalid_argument with the
/// line at fault.
Assembly assemble(const std::vector<Statement>& program);

/// Columns parted by tabs: label, operation, designator, operand, remark; "#" begins a comment.
std::vector<Statement> read_program(std::string_view text);

}  // namespace gearlash::thesis
