// The lines of a drive that the general engine answers.
#pragma once

#include <string>

#include "gearlash/drive.hpp"

namespace gearlash::portable {

/// Which of a drive's motions are compared. Unstable cycles that lie in irregular motion are found
/// where it happens to come near them: not all of them by every build.
enum class Listed { all, attractors };

/// Verdict, cycles and irregular motions.
void print_drive(const std::string& name, const Drive& drive, Listed listed);

}  // namespace gearlash::portable
