// Round tics of an axis, numbered as multiples of a power of a thousand.
#pragma once

#include <string>

#include "gearlash/bounds.hpp"

namespace gearlash {

struct AxisScale {
  std::string tics;   ///< gnuplot's command
  std::string label;  ///< "gap (µrad)", "position (10⁻³ deg)"
};

/// Tics of axis `name` ('x' or 'y') for a range of numbers in `unit`: at most `most` intervals of
/// 1, 2 or 5 times a power of ten. Numbers below 0.02 or from 100 000 on are multiples of a power
/// of a thousand, which the label has as a prefix of the unit if that is rad, rad/s or N m.
AxisScale axis_scale(char name, const std::string& quantity, const std::string& unit,
                     const Bounds& range, int most);

}  // namespace gearlash
