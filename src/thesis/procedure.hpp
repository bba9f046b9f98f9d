// The procedure of the thesis: from a data sheet to the numbers of its charts, step by step.
#pragma once

#include <map>
#include <string>

#include "gearlash/drive.hpp"

namespace gearlash::thesis {

/// The procedure covers a proportional loop and a motor with a winding.
bool is_data_sheet(const Drive& drive);

/// The data sheet in SI, the steps of the procedure for its kind of motor as the thesis numbers
/// them, each with formula, numbers and result, and the limit cycle. Every step can be recomputed
/// from the numbers on its line, to five digits at least. `written` are the values as their author
/// wrote them, by "section.key"; those that are missing are printed in SI alone.
/// Precondition: a motor with a winding, proportional control, a closed form.
std::string motor_procedure(const Drive& drive, const std::map<std::string, std::string>& written);

}  // namespace gearlash::thesis
