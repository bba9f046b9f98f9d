// The units of results: those of the servo's author if they are known.
#pragma once

#include <string>

#include "gearlash/answer.hpp"
#include "input/units.hpp"

namespace gearlash {

/// How a file was made, with enough detail to make it again.
struct Provenance {
  std::string command{};  ///< on one line, as typed into a shell; empty from a program
  std::string version{};  ///< of Gearlash
};

/// Of a result that a person reads beside others.
inline constexpr int usual_digits = 4;

/// The number with at most `digits` significant digits: "0.0814", "14200", "1.2e-05", "inf".
std::string significant(double value, int digits);

/// An upper bound: the next number of `digits` significant digits that is not below it.
double rounded_up(double bound, int digits);
/// A lower bound likewise, not above it.
double rounded_down(double bound, int digits);

/// "gap (rad)"; the name alone of what has no unit.
std::string name_with_unit(const std::string& name, const std::string& unit);

/// A change by this ratio: "+12.3 %", "−40 %", "×26".
std::string change_text(double ratio);

/// "12.3 arcmin".
std::string angle_text(double radians, const AngleUnit& unit, int digits);

/// "0.54 s"; for a normal form without a natural frequency "6.456 / ω_n".
std::string time_text(double seconds, bool is_normalized, int digits);
/// "1.85 Hz"; for a normal form without a natural frequency "ω = 0.973 ω_n".
std::string frequency_text(double period, bool is_normalized, int digits);

/// An amplitude: "±12.3 arcmin".
std::string swing_text(double amplitude, const AngleUnit& unit, int digits);
/// An upper bound of an amplitude in the author's unit, rounded up: "±12.4 arcmin".
std::string swing_bound_text(double amplitude, const AngleUnit& unit, int digits);

/// What a table of step responses is of: "a step of 1 deg, settled within ±0.05 deg".
std::string step_text(const StepResponse& step, const AngleUnit& unit);

}  // namespace gearlash
