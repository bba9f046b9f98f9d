// What all makers of pictures share: parts of layers, and axes with round numbers.
#pragma once

#include <string>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/plot.hpp"
#include "question/axis.hpp"

namespace gearlash {

/// The width of the panel of a picture with one column, whose names on the y axis are short.
inline constexpr double panel_width = 780.0;

/// Colours that colour-blind readers distinguish (Okabe and Ito) and that differ in grey. Dashes
/// and widths repeat the distinction.
inline constexpr char load_colour[] = "#0072b2";
inline constexpr char motor_colour[] = "#d55e00";

/// Red, green and blue from 0 to 255.
struct Colour {
  double red, green, blue;
};
/// "#rrggbb", from one colour at share 0 to the other at 1.
std::string mixed(const Colour& from, const Colour& to, double share);

/// Ready to be drawn. Axes get the ends that they lack, those of the layers with a margin where y
/// is linear; tics, unless they have some; and labels. Numbers on a linear axis are multiples of 1,
/// 2 or 5 times a power of ten. If they are below 0.02 or from 100 000 on, they are multiples of a
/// power of a thousand, which the label has as a prefix of the unit if that is rad, rad/s or N m. A
/// logarithmic axis shows powers of ten; a short one 1, 2 and 5 as well, or even steps. The first
/// layer of each name is in the legend.
Plot finished(Plot plot);
/// The same of one panel.
Plot plot_of(std::string title, std::string subtitle, Panel panel);

/// The axes of a panel of that width.
PlotAxis finished_x(const Panel& panel, double width = panel_width);
PlotAxis finished_y(const Panel& panel);

/// Appends a further line or area.
void append(const MapCurve& curve, MapCurve& points);
MapCurve joined(const std::vector<MapCurve>& curves);
/// The outline of a rectangle, to append.
MapCurve rectangle(const Bounds& x, const Bounds& y);
/// The layer with these points.
Layer with(Layer style, MapCurve points);

/// The points with a gap where they lie more than the panel's size beside it. Precondition: the
/// axes have their ends.
MapCurve near(MapCurve points, const Panel& panel);

/// Lines of that style where x or y is 0. Precondition: the axes have their ends.
Layer zero_lines(const Panel& panel, Layer style);

/// "gap (rad)", of an axis with its own unit.
std::string label_of(const PlotAxis& axis);

/// From end to end, for position_on() and value_at(). Precondition: the axis has its ends.
Axis span_of(const PlotAxis& axis);

/// The smallest step of 1, 2 or 5 times a power of ten that divides `length` into at most `most`.
double round_step(double length, int most);

/// The range with a margin, as a share of its length, and never empty.
Bounds widened(const Bounds& range, double margin);

}  // namespace gearlash
