// The arithmetic on which intervals rest.
#pragma once

#include <string_view>

namespace gearlash {

/// Why this thread's numbers are not those of IEEE 754 rounded to nearest, to double precision and
/// with subnormal ones; empty if they are. Other software in the process may have changed that (a
/// rounding mode, flush-to-zero, the precision of an x87). Every proof begins with this question,
/// in the thread that computes it.
std::string_view fault_of_arithmetic();

inline bool proves() { return fault_of_arithmetic().empty(); }

}  // namespace gearlash
