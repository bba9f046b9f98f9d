#include "thesis/machine_1604.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearlash::thesis {
namespace {

constexpr unsigned address_bits = 077777;

/// a − b, one's complement, with end-around borrow: a subtractive adder, so that a − a is +0.
Word difference(Word a, Word b) { return a >= b ? a - b : (a + word_bits - b) & word_bits; }

Word total(Word a, Word b) { return difference(a, complement(b)); }

unsigned index_total(unsigned a, unsigned b) {
  const unsigned negated = ~b & address_bits;
  return a >= negated ? a - negated : (a + address_bits - negated) & address_bits;
}

/// A 15-bit operand as a word, its sign extended.
Word extended(unsigned operand) {
  constexpr unsigned operand_sign = 040000;
  return (operand & operand_sign) != 0 ? word_bits - (address_bits - operand) : operand;
}

Word with_upper_address(Word word, unsigned address) {
  constexpr Word place = Word{address_bits} << half_word;
  return (word & ~place & word_bits) | (Word{address} << half_word);
}

Word with_lower_address(Word word, unsigned address) {
  return (word & ~Word{address_bits} & word_bits) | address;
}

Word shifted_left_around(Word word, unsigned places) {
  constexpr unsigned length = 48;
  places %= length;
  return places == 0 ? word : ((word << places) | (word >> (length - places))) & word_bits;
}

Word shifted_right(Word word, unsigned places) {
  constexpr unsigned length = 48;
  places = std::min(places, length - 1);
  const Word fill = is_negative(word) ? word_bits & ~(word_bits >> places) : 0;
  return (word >> places) | fill;
}

}  // namespace

std::string mnemonic(unsigned operation) {
  for (const Mnemonic& known : mnemonics) {
    if (known.operation == operation) return std::string(known.name);
  }
  return fmt::format("{:02o}", operation);
}

void Machine1604::provide(unsigned address, HostRoutine routine) {
  routines_[address] = std::move(routine);
}

void Machine1604::jump(unsigned address) {
  registers_.p = address;
  registers_.in_lower = false;
}

void Machine1604::fault(const std::string& what) const {
  throw MachineFault(fmt::format("CDC 1604 at {:05o}, {} instruction: {}", registers_.p,
                                 registers_.in_lower ? "lower" : "upper", what));
}

unsigned Machine1604::address_of(const Instruction& instruction) const {
  constexpr unsigned indirect = 7;
  if (instruction.designator == indirect) fault("indirect addressing is not provided");
  return index_total(instruction.operand, registers_.index[instruction.designator]);
}

void Machine1604::return_jump(unsigned address) {
  const unsigned return_address = (registers_.p + 1U) & address_bits;
  const auto routine = routines_.find(address);
  if (routine != routines_.end()) return jump(routine->second(*this, return_address));
  write(address, with_upper_address(read(address), return_address));
  registers_.p = address;
  registers_.in_lower = true;
}

void Machine1604::advance() {
  if (registers_.in_lower) registers_.p = (registers_.p + 1U) & address_bits;
  registers_.in_lower = !registers_.in_lower;
}

/// The full exit of an upper instruction skips the lower one; the half exit does not.
void Machine1604::exit_fully_if(bool condition) {
  if (registers_.in_lower) fault("the exits of a skip in the lower half are not known");
  condition ? jump(registers_.p + 1U) : advance();
}

unsigned& Machine1604::index_register(unsigned designator) {
  if (designator == 0 || designator >= registers_.index.size()) fault("no index register is named");
  return registers_.index[designator];
}

void Machine1604::step() {
  const Word word = read(registers_.p);
  const Instruction next = registers_.in_lower ? lower_instruction(word) : upper_instruction(word);
  if (trace_) trace_(registers_, next);
  execute(next);
  ++registers_.executed;
}

void Machine1604::execute(const Instruction& instruction) {
  const std::optional<Word> accumulated = accumulator_after(instruction);
  if (accumulated) {
    registers_.a = *accumulated;
    const bool is_stored = instruction.operation == operation_of("STA") ||
                           instruction.operation == operation_of("RAO");
    if (is_stored) write(address_of(instruction), registers_.a);
  }
  const bool is_plain = accumulated || execute_index(instruction);
  if (!is_plain && execute_jump(instruction)) return;
  if (!is_plain) {
    fault("operation " + mnemonic(instruction.operation) + " is not provided");
  }
  advance();
}

std::optional<Word> Machine1604::accumulator_after(const Instruction& instruction) const {
  const Word a = registers_.a;
  const auto operand = [&] { return read(address_of(instruction)); };
  const auto number = [&] { return Float1604::of(operand()); };
  switch (instruction.operation) {
    case *operation_of("ARS"):
      return shifted_right(a, address_of(instruction));
    case *operation_of("ALS"):
      return shifted_left_around(a, address_of(instruction));
    case *operation_of("ENA"):
      return extended(address_of(instruction));
    case *operation_of("INA"):
      return total(a, extended(address_of(instruction)));
    case *operation_of("LDA"):
      return operand();
    case *operation_of("LAC"):
      return complement(operand());
    case *operation_of("ADD"):
      return total(a, operand());
    case *operation_of("SUB"):
      return difference(a, operand());
    case *operation_of("STA"):
      return a;
    case *operation_of("RAO"):
      return total(operand(), 1);
    case *operation_of("FAD"):
      return sum(Float1604::of(a), number(), rules_.sum).word();
    case *operation_of("FSB"):
      return sum(Float1604::of(a), -number(), rules_.sum).word();
    case *operation_of("FMU"):
      return product(Float1604::of(a), number(), rules_.product).word();
    case *operation_of("FDV"):
      return quotient(Float1604::of(a), number(), rules_.quotient).word();
    default:
      return std::nullopt;
  }
}

bool Machine1604::execute_index(const Instruction& instruction) {
  const unsigned b = instruction.designator;
  constexpr unsigned registers = 6;
  if (b > registers) return false;
  const auto set = [&](unsigned value) {
    if (b != 0) registers_.index[b] = value;
  };
  switch (instruction.operation) {
    case *operation_of("ENI"):
      set(instruction.operand);
      return true;
    case *operation_of("INI"):
      set(index_total(registers_.index[b], instruction.operand));
      return true;
    case *operation_of("LIU"):
      set(upper_instruction(read(instruction.operand)).operand);
      return true;
    case *operation_of("LIL"):
      set(lower_instruction(read(instruction.operand)).operand);
      return true;
    case *operation_of("SIU"):
      write(instruction.operand,
            with_upper_address(read(instruction.operand), registers_.index[b]));
      return true;
    case *operation_of("SIL"):
      write(instruction.operand,
            with_lower_address(read(instruction.operand), registers_.index[b]));
      return true;
    default:
      return false;
  }
}

bool Machine1604::execute_jump(const Instruction& instruction) {
  const unsigned b = instruction.designator;
  switch (instruction.operation) {
    case *operation_of("SLJ"): {
      constexpr unsigned return_jump_always = 4;
      if (b != 0 && b != return_jump_always) fault("jump keys are not provided");
      b == 0 ? jump(instruction.operand) : return_jump(instruction.operand);
      return true;
    }
    case *operation_of("AJP"): {
      const Word a = registers_.a;
      const std::array condition = {a == 0, a != 0, !is_negative(a), is_negative(a)};
      if (b >= condition.size()) fault("AJP to a return jump is not provided");
      condition[b] ? jump(instruction.operand) : advance();
      return true;
    }
    case *operation_of("SSK"):
      exit_fully_if(is_negative(read(address_of(instruction))));
      return true;
    case *operation_of("ISK"): {
      unsigned& index = index_register(b);
      const bool reached = index == instruction.operand;
      index = reached ? 0 : index_total(index, 1);
      exit_fully_if(reached);
      return true;
    }
    case *operation_of("IJP"): {
      unsigned& index = index_register(b);
      constexpr unsigned minus_one = 077776;
      const bool more = index != 0;
      if (more) index = index_total(index, minus_one);
      more ? jump(instruction.operand) : advance();
      return true;
    }
    default:
      return false;
  }
}

}  // namespace gearlash::thesis
