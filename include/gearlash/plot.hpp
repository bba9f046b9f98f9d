// What a picture shows, in panels of layers, whatever draws it.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "gearlash/bounds.hpp"

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

/// Things of one look.
struct Layer {
  LayerKind kind = LayerKind::line;  ///< how its points are drawn
  std::string name{};                ///< what it shows; empty where that needs no words
  std::string colour = "#000000";    ///< red, green and blue from 00 to ff
  double width = 1.8;                ///< of a line
  std::string dashes{};    ///< lengths on and off by turns, in widths: "8,4"; empty: solid
  Mark mark = Mark::disc;  ///< the shape of each mark
  double size = 0.5;       ///< of a mark; 1 is about the height of a letter
  MapCurve points{};       ///< in the axes' units; one that is not finite begins another part
  bool in_legend = false;  ///< the first layer of its name in the plot, even without points
};

/// A word or number, centered at a point.
struct PlotText {
  MapPoint at{};                   ///< in the axes' units
  std::string text{};              ///< one line
  std::string colour = "#000000";  ///< as that of a layer
  double size = 0.85;              ///< of the picture's letters
  double slope = 0.0;              ///< degrees
  bool is_bold = false;            ///< stands out
};

struct Tic {
  double at = 0.0;     ///< in the axis's unit
  std::string text{};  ///< in the unit of the axis's label; empty: a short mark between two numbers
};

struct PlotAxis {
  std::string name{};   ///< "inertia ratio"; empty: not written
  std::string unit{};   ///< of the points: "rad"; empty for pure numbers and words
  std::string label{};  ///< the name with the unit of the tics: "gap (µrad)"; empty without it
  bool logarithmic = false;                                ///< else linear
  double low = std::numeric_limits<double>::quiet_NaN();   ///< its lower end
  double high = std::numeric_limits<double>::quiet_NaN();  ///< its upper end
  std::vector<Tic> tics{};                                 ///< rising
  bool has_grid = true;  ///< lines across the panel at its numbers
};

struct Panel {
  std::string title{};            ///< empty: none
  PlotAxis x{};                   ///< to the right
  PlotAxis y{};                   ///< upwards
  std::vector<Layer> layers{};    ///< the lowest first
  std::vector<PlotText> texts{};  ///< above all layers
  double height = 480.0;          ///< between the ends of y
};

/// Panels below each other have the same x axis, whose numbers stand below the last.
using PlotColumn = std::vector<Panel>;

struct Plot {
  std::string title{};                   ///< the answer, or what is shown, in one line
  std::vector<std::string> subtitles{};  ///< what else to know, a line each
  std::vector<PlotColumn> columns{};     ///< side by side
  std::string description{};             ///< for readers who do not see the picture
};

}  // namespace gearlash
