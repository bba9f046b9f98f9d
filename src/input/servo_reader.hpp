// Reading the sections of a TOML file that describe a servo.
#pragma once

#include <set>
#include <string>

#include "analysis/grid/axis.hpp"
#include "input/section_reader.hpp"
#include "input/servo_file.hpp"
#include "input/toml_document.hpp"

namespace gearlash {

/// What a file varies besides describing a servo: its section, and the inputs that it varies.
struct ServoVariation {
  std::string section = {};
  std::set<Input> inputs = {};
};

/// The servo; sound where nothing was found at fault. Where inputs are varied, [servo] may give
/// none of them, for which stand-ins are returned, and need not give the backlash, which is then 1;
/// a data sheet is read whole.
ServoFile read_servo(const TomlDocument& document, Findings& findings,
                     const ServoVariation& variation = {});

}  // namespace gearlash
