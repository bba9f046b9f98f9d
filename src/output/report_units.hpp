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

/// "12.3 arcmin".
std::string angle_text(double radians, const AngleUnit& unit, int digits);

/// "0.54 s"; of a normal form without a natural frequency "6.456 / ω_n".
std::string time_text(double seconds, bool is_normalized, int digits);
/// "1.85 Hz"; likewise "ω = 0.973 ω_n".
std::string frequency_text(double period, bool is_normalized, int digits);

/// A size, the author's unit first: "±12.3 arcmin (0.00358 rad)", "±0.0814 rad (4.67°)".
std::string swing_text(double amplitude, const AngleUnit& unit, int digits);

}  // namespace gearlash
