// The units in which results are told: those of the servo's author where they are known.
#pragma once

#include <optional>
#include <string>

#include "input/units.hpp"

namespace gearlash {

/// What made a file: enough to make it again.
struct Provenance {
  std::string command = {};  ///< as it could be typed into a shell, on one line
  std::string version = {};  ///< of Gearlash
};

/// At most `digits` significant ones, for a person to read: "0.0814", "1.2e-05", "inf".
std::string significant(double value, int digits);

/// A change by this ratio: "+12.3 %", "−40 %", "×26".
std::string change_text(double ratio);

/// A size, the author's unit first: "±12.3 arcmin (0.00358 rad)", "±0.0814 rad (4.67°)".
std::string swing_text(double amplitude, const AngleUnit& unit, int digits);

}  // namespace gearlash
