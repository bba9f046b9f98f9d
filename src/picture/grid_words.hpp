// What charts and maps of a grid call its parameters and quantities.
#pragma once

#include <string>

#include "analysis/grid/axis.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {

/// "damping 0.1, backlash 0.3": the numbers of a normal form that are on no axis; empty for
/// another drive, which has too many. Of one that is searched, how sure the verdicts are.
std::string subtitle_of(const Grid& grid);

/// "inertia ratio" for servo.inertia_ratio, "gearbox backlash" for gearbox.backlash.
std::string in_words(const std::string& path);

/// "Amplitude of the load".
std::string title_of(Quantity quantity);

/// " (rad)", nothing for a bare number. Of a normal form with the backlash 1 and on no axis angles
/// are in backlashes, and of one without a natural frequency times in units of 1/ω_n.
std::string unit_in_brackets(Quantity quantity, const Grid& grid);

/// "amplitude (rad)".
std::string label_of(Quantity quantity, const Grid& grid);

/// Whether words stand on the axis.
bool has_words(const Axis& axis, const Drive& drive);

/// A value for a person to read: "0.1", "load".
std::string short_text(const Axis& axis, const Drive& drive, double value);
/// "5e-05 kg m2".
std::string text_with_unit(const Axis& axis, const Drive& drive, double value);

/// The axis as it is drawn; one value in the middle.
ChartAxis chart_axis(const Axis& axis, const Drive& drive);

}  // namespace gearlash
