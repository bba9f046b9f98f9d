// The program of Table I in the memory of a CDC 1604, with RUNGE and DECO, running.
#pragma once

#include <functional>

#include "thesis/machine_1604.hpp"
#include "thesis/program_1960.hpp"

namespace gearlash::thesis {

/// Loads the octal words of Table I, two of them corrected (20103 and 20112, whose address of
/// FACTOR2 is not where the listing has it), our RUNGE at 60200, and at 71000 DECO as a routine of
/// the host, which hands on what PRINT has put into BUF. The program is begun at 20000.
class ThesisMachine {
 public:
  explicit ThesisMachine(FloatRules rules = {});
  ThesisMachine(const ThesisMachine&) = delete;
  ThesisMachine& operator=(const ThesisMachine&) = delete;

  /// Puts parameters into 20156 … 20163 and 20166, cut off to 36 bits, as one did by hand.
  void set(const ProgramParameters& parameters);

  /// Runs to the next line of the printout.
  PrintedLine next_line();

  /// Runs to the next test for separation or contact, that is for one step of 0.01 s. Whether a
  /// contact has been printed on the way.
  bool step();

  /// State as the program's own variables have it.
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
