// Contours of a quantity on a map.
#pragma once

#include <vector>

#include "gearlash/grid.hpp"
#include "question/map/region_boundary.hpp"

namespace gearlash {

struct Contour {
  double level = 0.0;
  std::vector<MapCurve> curves = {};  ///< values above the level lie on their left
};

/// About six to twelve rising round numbers within the bulk of the values, of which only finite
/// positive ones count. Steps are 1, 2 or 5 times a power of ten. Where the values span more than a
/// factor of 12, levels rise by factors of about 1.5, or of 2 and more where those would be too
/// many. Empty where all values are equal.
std::vector<double> round_levels(std::vector<double> values);

/// The contours of the quantity at these levels. With plastic contact each point of the curves is
/// solved, to 1e-6 of the picture. Beyond the end of hunting the quantity is replaced by its limit
/// there, so contours of the amplitude continue to the hunting-free boundary. Where faces bounce,
/// where drives are searched, and of figures that need no motion (bandwidth), which cost far more,
/// the quantity is interpolated between the grid's points.
/// Precondition: `table` belongs to the grid, whose two axes are y, x.
std::vector<Contour> contours_of(const Grid& grid, const Table& table, Quantity quantity,
                                 const std::vector<double>& levels);

}  // namespace gearlash
