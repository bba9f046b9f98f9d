#include "thesis/thesis_machine.hpp"

#include "thesis/listing.hpp"

namespace gearlash::thesis {
namespace {

// Addresses of Table I.
constexpr unsigned start = 020000;
constexpr unsigned time_address = 020025;
constexpr unsigned motor_speed = 020027;
constexpr unsigned motor_position = 020032;
constexpr unsigned load_speed = 020044;
constexpr unsigned load_position = 020047;
constexpr unsigned first_parameter = 020156;
constexpr unsigned backlash_address = 020166;
constexpr unsigned print_from_contact = 020154;  ///< return address of PRINT from 20153
constexpr unsigned print = 020120;
constexpr unsigned separation_test = 020061;  // TEST1
constexpr unsigned contact_test = 020073;     // TEST2
constexpr unsigned deco = 071000;

/// The return address of `routine`, which a return jump leaves in the upper address of its first
/// word.
unsigned return_address_of(const Machine1604& machine, unsigned routine) {
  return upper_instruction(machine.read(routine)).operand;
}

}  // namespace

ThesisMachine::ThesisMachine(FloatRules rules) : machine_(rules) {
  for (const auto& [address, word] : thesis_table_1().octal) machine_.write(address, word);
  for (const ListingDifference& difference : differences_of_listing()) {
    machine_.write(difference.address, difference.assembled);
  }
  for (const auto& [address, word] : runge().words) machine_.write(address, word);
  machine_.provide(deco, [this](Machine1604& machine, unsigned return_address) {
    const unsigned buffer = upper_instruction(machine.read(return_address)).operand;
    line_ = {number_at(buffer),     number_at(buffer + 1),
             number_at(buffer + 2), number_at(buffer + 3),
             number_at(buffer + 4), return_address_of(machine, print) == print_from_contact};
    printed_ = true;
    contact_printed_ = contact_printed_ || line_.at_contact;
    return return_address + 1;  // after the word with the buffer and the line's number
  });
  machine_.jump(start);
}

void ThesisMachine::set(const ProgramParameters& parameters) {
  unsigned address = first_parameter;
  for (const double value :
       {parameters.friction, parameters.load_rate, parameters.motor_inertia,
        parameters.motor_friction, parameters.motor_inertia, parameters.load_inertia}) {
    machine_.write(address++, Float1604::truncated(value).word());
  }
  machine_.write(backlash_address, Float1604::truncated(parameters.backlash).word());
}

PrintedLine ThesisMachine::next_line() {
  printed_ = false;
  while (!printed_) machine_.step();
  return line_;
}

bool ThesisMachine::step() {
  contact_printed_ = false;
  const auto at_a_test = [&] {
    const unsigned p = machine_.registers().p;
    return (p == separation_test || p == contact_test) && !machine_.registers().in_lower;
  };
  do {
    machine_.step();
  } while (!at_a_test());
  return contact_printed_;
}

PrintedLine ThesisMachine::state() const {
  return {number_at(time_address), number_at(motor_speed),   number_at(motor_position),
          number_at(load_speed),   number_at(load_position), false};
}

double ThesisMachine::number_at(unsigned address) const {
  return Float1604::of(machine_.read(address)).value();
}

}  // namespace gearlash::thesis
