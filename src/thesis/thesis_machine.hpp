// Running the program of Table I on an emulated CDC 1604, with RUNGE and DECO.
#pragma once

#include <functional>

#include "thesis/machine_1604.hpp"
#include "thesis/program_1960.hpp"

namespace gearlash::thesis {

/// Loads the octal words of Table I, our RUNGE at 60200, and at 71000 DECO as a routine of the
/// host, which receives the numbers that PRINT has put into BUF. Words 20103 and 20112 are
/// corrected, because their address of FACTOR2 differs from its place in the listing. The program
/// starts at 20000.
class ThesisMachine {
 public:
  explicit ThesisMachine(FloatRules rules = {});
  ThesisMachine(const ThesisMachine&) = delete;
  ThesisMachine& operator=(const ThesisMachine&) = delete;

  /// Puts parameters into 20156 … 20163 and 20166, truncated to 36 bits, as operators did by hand.
  void set(const ProgramParameters& parameters);

  /// Runs to the next line of the printout.
  PrintedLine next_line();

  /// Runs to the next test for separation or contact, that is for one step of 0.01 s. Returns
  /// whether a contact was printed during the step.
  bool step();

  /// The state in the program's own variables.
  PrintedLine state() const;
  Machine1604& machine() { return machine_; }
  const Machine1604& machine() const { return machine_; }

 private:
  double number_at(unsigned address) const;

  Machine1604 machine_;
  bool printed_ = false;
  bool contact_printed_ = false;
  PrintedLine line_;
};

}  // namespace gearlash::thesis
