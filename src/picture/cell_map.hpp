// Maps of coloured cells with their numbers, in panels, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

#include "picture/picture.hpp"

namespace gearlash {

struct CellPanel {
  std::string title;
  std::vector<std::vector<double>> values;     ///< [row][column]; NaN leaves a cell empty,
                                               ///< infinity shows a dot, not a number
  std::vector<std::vector<bool>> framed = {};  ///< as many, or none
};

struct CellMap {
  std::string title = {};
  std::string subtitle = {};
  std::string x_label = {};
  std::string y_label = {};
  std::vector<std::string> columns = {};
  std::vector<std::string> rows = {};  ///< the lowest first
  std::vector<CellPanel> panels = {};  ///< up to six, three in a line
  double largest = 1.0;                ///< colours run from −largest to largest, in proportion
  /// Above 0: colours run from here to `largest`, by ratio.
  double least = 0.0;
  std::string number_format = "%+.1f";
};

/// Returns the bytes of the picture; the same map gives the same SVG. Throws OutputError if gnuplot
/// is missing or fails.
std::string draw_cell_map(const CellMap& map, PictureFormat format);

}  // namespace gearlash
