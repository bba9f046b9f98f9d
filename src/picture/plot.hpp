// What a picture shows, in panels of layers, whatever draws it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/bounds.hpp"
#include "question/axis.hpp"
#include "question/map/region_boundary.hpp"

namespace gearlash {

// Lengths are in pixels of a picture that is 900 wide.

enum class LayerKind : std::uint8_t {
  line,
  area,  ///< closed outlines, filled: bands, bars, cells, regions and filled contours too
  marks  ///< one at each point
};

enum class Mark : std::uint8_t {
  plus,
  cross,
  star,
  open_square,
  square,
  circle,
  disc,
  open_triangle,
  triangle,
  open_wedge,  ///< a triangle that points down
  wedge,
  open_diamond,
  diamond,
  open_pentagon,
  pentagon
};

/// Things of one look. Those of all panels that have the same name share one entry of the legend.
struct Layer {
  LayerKind kind = LayerKind::line;
  std::string name = {};  ///< in the legend, even if there are no points; empty: not there
  std::string colour = "#000000";
  double width = 1.8;       ///< of a line
  std::string dashes = {};  ///< lengths on and off by turns, in widths: "8,4"; empty: solid
  Mark mark = Mark::disc;
  double size = 0.5;     ///< of a mark; 1 is about the height of a letter
  MapCurve points = {};  ///< in the axes' units; one that is not finite begins another line or area
};

/// A word or number, centered at a point.
struct PlotText {
  MapPoint at = {};
  std::string text = {};
  std::string colour = "#000000";
  double size = 0.85;  ///< of the picture's letters
  double slope = 0.0;  ///< degrees
  bool is_bold = false;
};

struct Tic {
  double at = 0.0;
  std::string text = {};  ///< empty: a short mark between two numbers
};

struct PlotAxis {
  std::string name = {};  ///< "inertia ratio"; empty: not written
  std::string unit = {};  ///< "rad"; empty for pure numbers and words
  bool logarithmic = false;
  std::optional<double> low = {};  ///< nothing: the end of the data
  std::optional<double> high = {};
  std::vector<Tic> tics = {};  ///< empty: round numbers
  bool has_grid = true;        ///< lines across the panel at its numbers
};

struct Panel {
  std::string title = {};
  PlotAxis x = {};
  PlotAxis y = {};
  std::vector<Layer> layers = {};  ///< the lowest first
  std::vector<PlotText> texts = {};
  double height = 480.0;
};

/// Panels below each other have the same x axis, whose numbers stand below the last.
using PlotColumn = std::vector<Panel>;

struct Plot {
  std::string title = {};
  std::vector<std::string> subtitles = {};
  std::vector<PlotColumn> columns = {};
};

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

Plot plot_of(std::string title, std::string subtitle, Panel panel);

/// Appends a further line or area.
void append(const MapCurve& curve, MapCurve& points);
MapCurve joined(const std::vector<MapCurve>& curves);
/// The outline of a rectangle, to append.
MapCurve rectangle(const Bounds& x, const Bounds& y);

/// Lines of that style where x or y is 0. Precondition: the axes have their ends.
Layer zero_lines(const Panel& panel, Layer style);

/// The axes of a panel as they are drawn, `width` wide: with their ends and numbers, and the unit
/// in the name: "gap (µrad)", "position (10⁻³ deg)". Open ends are those of the layers, with a
/// margin where y is linear. Numbers on a linear axis are multiples of 1, 2 or 5 times a power of
/// ten. If they are below 0.02 or from 100 000 on, they are multiples of a power of a thousand,
/// which the name has as a prefix of the unit if that is rad, rad/s or N m. A logarithmic axis
/// shows powers of ten; a short one 1, 2 and 5 as well, or even steps.
PlotAxis drawn_x(const Panel& panel, double width = panel_width);
PlotAxis drawn_y(const Panel& panel);
/// The plot with all its axes as they are drawn, for what draws it elsewhere.
Plot drawn(Plot plot);

/// "gap (rad)", of an axis with its own unit.
std::string label_of(const PlotAxis& axis);

/// From end to end, for position_on() and value_at(). Precondition: the axis has its ends.
Axis span_of(const PlotAxis& axis);

/// The smallest step of 1, 2 or 5 times a power of ten that divides `length` into at most `most`.
double round_step(double length, int most);

/// The range with a margin, as a share of its length, and never empty.
Bounds widened(const Bounds& range, double margin);

}  // namespace gearlash
