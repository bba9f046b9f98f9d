// Appendix A of the 1960 thesis with the numbers of a data sheet, step by step.
#pragma once

#include <map>
#include <string>

#include "gearlash/drive.hpp"
#include "input/units.hpp"

namespace gearlash::cli {

/// The data sheet in SI, the steps of the procedure for its kind of motor as the thesis numbers
/// them, each with formula, numbers and result, and the limit cycle. Every step can be recomputed
/// from the numbers on its line, to five digits at least. `written` are the values as their author
/// wrote them, by "section.key"; those that are missing are printed in SI alone.
/// Precondition: a motor with a winding, proportional control, a closed form.
std::string motor_procedure(const Drive& drive, const AngleUnit& angle,
                            const std::map<std::string, std::string>& written);

}  // namespace gearlash::cli
