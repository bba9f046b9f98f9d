// Panels of curves, bars and cells.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/plot_making.hpp"

namespace gearlash {

/// A line, marks that belong to it, and open circles at its ends.
struct NamedCurve {
  std::string name = {};  ///< in the legend, also of a curve without points
  MapCurve line = {};     ///< interrupted at points that are not finite
  MapCurve marks = {};
  MapCurve ends = {};
};

/// Curves differ in colour, dash and mark.
void add_curves(const std::vector<NamedCurve>& curves, double mark_size, Panel& panel);

/// Words for the lines, marks and open circles of all curves, in the legend; empty: none.
void explain_curves(const std::string& line, const std::string& mark, double mark_size,
                    const std::string& end, Panel& panel);

/// Says in the middle why a panel is empty.
void say(const std::string& reason, Panel& panel);

/// A horizontal bar.
struct Bar {
  std::string name = {};
  double value = 0.0;                         ///< from 0, to either side
  std::optional<double> part = std::nullopt;  ///< part of the value, drawn dark
};

/// Bars with their names, the first on top. The words for values and parts are shown if there are
/// parts. Precondition: at least one bar, finite values.
Panel bar_panel(const std::vector<Bar>& bars, PlotAxis values,
                const std::string& value_meaning = "", const std::string& part_meaning = "");

/// A table of coloured cells with their numbers.
struct Cells {
  std::vector<std::string> columns = {};
  std::vector<std::string> rows = {};  ///< the lowest first
  /// [row][column]; NaN leaves a cell empty, infinity shows a dot, not a number.
  std::vector<std::vector<double>> values = {};
  std::vector<std::vector<bool>> framed = {};  ///< as many, or none
  double least = 0.0;    ///< above 0: colours run from here to `largest`, by ratio
  double largest = 1.0;  ///< else from −largest to largest, in proportion
  std::string number_format = "{:+.1f}";
  double letters = 0.85;  ///< size of the numbers
  std::string dot_meaning = {};
  std::string frame_meaning = {};
};
Panel cell_panel(const Cells& cells, std::string x_name, std::string y_name);

}  // namespace gearlash
