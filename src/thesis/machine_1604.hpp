// The parts of a CDC 1604 that the program of the thesis and its library routine need.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "thesis/float_1604.hpp"

namespace gearlash::thesis {

inline constexpr std::size_t memory_words = 32768;
inline constexpr unsigned half_word = 24;  ///< bits

/// An instruction: operation (6 bits), designator b (3), operand m (15). A word holds two, the
/// upper one first.
struct Instruction {
  unsigned operation = 0;
  unsigned designator = 0;
  unsigned operand = 0;
};
constexpr Instruction lower_instruction(Word word) {
  return {static_cast<unsigned>(word >> 18U) & 077U, static_cast<unsigned>(word >> 15U) & 07U,
          static_cast<unsigned>(word) & 077777U};
}
constexpr Instruction upper_instruction(Word word) { return lower_instruction(word >> half_word); }
struct Mnemonic {
  std::string_view name;
  unsigned operation;
};
/// The instructions of this machine.
inline constexpr Mnemonic mnemonics[] = {
    {"ARS", 001}, {"ALS", 005}, {"ENA", 010}, {"INA", 011}, {"LDA", 012},
    {"LAC", 013}, {"ADD", 014}, {"SUB", 015}, {"STA", 020}, {"AJP", 022},
    {"FAD", 030}, {"FSB", 031}, {"FMU", 032}, {"FDV", 033}, {"SSK", 036},
    {"ENI", 050}, {"INI", 051}, {"LIU", 052}, {"LIL", 053}, {"ISK", 054},
    {"IJP", 055}, {"SIU", 056}, {"SIL", 057}, {"RAO", 072}, {"SLJ", 075}};
/// "LDA", or the operation's octal number if this machine lacks it.
std::string mnemonic(unsigned operation);
/// The operation of a mnemonic; nothing if this machine lacks it.
constexpr std::optional<unsigned> operation_of(std::string_view mnemonic) {
  for (const Mnemonic& known : mnemonics) {
    if (known.name == mnemonic) return known.operation;
  }
  return std::nullopt;
}

struct Registers {
  Word a = 0;                       ///< accumulator
  unsigned p = 0;                   ///< address of the current word
  bool in_lower = false;            ///< whether the lower instruction is next
  std::array<unsigned, 7> index{};  ///< B1 … B6; [0] stays zero
  std::size_t executed = 0;         ///< number of instructions so far
};

/// An instruction that stops the machine, or whose effect is not known; the message names the
/// address.
class MachineFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Memory, registers, and the instructions of docs/explanation/thesis.md. Integers are one's
/// complement with a subtractive adder (x − x is +0); floating point follows `rules`. A return jump
/// writes P+1 into the upper address of its target word and continues with that word's lower
/// instruction.
class Machine1604 {
 public:
  explicit Machine1604(FloatRules rules = {}) : rules_(rules), memory_(memory_words, 0) {}

  /// Addresses are taken modulo the size of the memory.
  Word read(unsigned address) const { return memory_[address % memory_words]; }
  void write(unsigned address, Word word) { memory_[address % memory_words] = word & word_bits; }
  const Registers& registers() const { return registers_; }

  /// A routine of the host, entered by a return jump to `address`. It receives the address of the
  /// word after the jump and returns the address at which to continue.
  using HostRoutine = std::function<unsigned(Machine1604&, unsigned return_address)>;
  void provide(unsigned address, HostRoutine routine);

  /// Called before each instruction.
  using Trace = std::function<void(const Registers&, const Instruction&)>;
  void set_trace(Trace trace) { trace_ = std::move(trace); }

  void jump(unsigned address);
  /// Executes one instruction.
  void step();

 private:
  unsigned address_of(const Instruction& instruction) const;
  void return_jump(unsigned address);
  void advance();
  void exit_fully_if(bool condition);
  unsigned& index_register(unsigned designator);
  void execute(const Instruction& instruction);
  /// Nothing if the instruction does not concern the accumulator.
  std::optional<Word> accumulator_after(const Instruction& instruction) const;
  bool execute_index(const Instruction& instruction);
  bool execute_jump(const Instruction& instruction);
  [[noreturn]] void fault(const std::string& what) const;

  FloatRules rules_;
  std::vector<Word> memory_;
  Registers registers_;
  std::map<unsigned, HostRoutine> routines_;
  Trace trace_;
};

}  // namespace gearlash::thesis
