// Reading the constants of a motor from [motor].
#pragma once

#include <string>
#include <vector>

#include "input/section_reader.hpp"
#include "model/datasheet.hpp"

namespace gearlash {

/// Appendix A's, which turn a voltage into torque.
extern const std::vector<std::string> motor_kinds;

/// The keys of a kind of motor but for the two given. Of a kind that is none of motor_kinds, what
/// keys there are tell which one is meant, so that they are checked.
Motor read_motor_constants(SectionReader& section, const std::string& kind, double inertia,
                           double friction);

}  // namespace gearlash
