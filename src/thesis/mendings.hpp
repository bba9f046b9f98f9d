// The effect of each property of the program of 1960: the program with that property corrected.
#pragma once

#include <string>
#include <vector>

#include "thesis/program_1960.hpp"

namespace gearlash::thesis {

struct NamedMending {
  std::string name;  ///< begins with the property's number
  Mending mending;
};

/// The original program; the program with each of its properties 1 to 4 corrected; with both
/// properties that make a lightly damped oscillation grow corrected; and with θ_M instead of θ_L in
/// the motor's equation.
const std::vector<NamedMending>& mendings();

/// How many of the 190 numbers of Table II are reproduced within one unit of their eighth digit, in
/// double precision.
int numbers_reproduced(const Mending& mending);

/// Relative error of the program's amplitude; NaN if the program does not hunt. Precondition: the
/// exact servo hunts.
double amplitude_error(const NormalizedServo& servo, const Mending& mending);

}  // namespace gearlash::thesis
