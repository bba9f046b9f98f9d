// What each property of the program of 1960 does: the program with one of them put right.
#pragma once

#include <string>
#include <vector>

#include "thesis/program_1960.hpp"

namespace gearlash::thesis {

struct NamedMending {
  std::string name;  ///< begins with the property's number
  Mending mending;
};

/// The program as it was, each of its properties 1 to 4 put right by itself, the two that a swing
/// under light damping grows by together, and θ_M in place of θ_L in the motor's equation.
const std::vector<NamedMending>& mendings();

/// How many of the 190 numbers of Table II come out within one unit of their eighth digit, in
/// double precision.
int numbers_reproduced(const Mending& mending);

/// Error of the program's size against the exact one, relative; NaN where the program does not
/// hunt. Precondition: the exact servo does.
double amplitude_error(const NormalizedServo& servo, const Mending& mending);

}  // namespace gearlash::thesis
