// The names of a grid's parameters and quantities in charts and maps.
#pragma once

#include <string>

#include "gearlash/plot.hpp"
#include "output/parameter_text.hpp"
#include "question/axis.hpp"

namespace gearlash {

/// "damping 0.1, backlash 0.3": the numbers of a normal form that are not on an axis; empty for
/// other drives, which have too many. For searched drives the certainty of the verdicts.
std::string subtitle_of(const Grid& grid);

/// "inertia ratio" for servo.inertia_ratio, "gearbox backlash" for gearbox.backlash.
std::string in_words(const std::string& path);

/// "Amplitude of the load".
std::string title_of(Quantity quantity);

/// Angles are in the author's unit; for a normal form with a fixed backlash of 1 in backlashes. For
/// one without a natural frequency, times are in units of 1/ω_n.
DrawnUnit drawn_unit(Quantity quantity, const Grid& grid);
DrawnUnit drawn_unit(const Axis& axis, const Drive& drive);

/// The quantity's axis in a picture.
PlotAxis plot_axis(Quantity quantity, const Grid& grid);
/// The axis in a picture; a single value stands in the middle.
PlotAxis plot_axis(const Axis& axis, const Drive& drive);

/// Whether the axis has words instead of numbers.
bool has_words(const Axis& axis, const Drive& drive);

/// A short value in the drawn unit: "0.1", "load".
std::string short_text(const Axis& axis, const Drive& drive, double value);
/// "5e-05 kg m2".
std::string text_with_unit(const Axis& axis, const Drive& drive, double value);

}  // namespace gearlash
