// Lines of equal quantity over a map.
#pragma once

#include <vector>

#include "analysis/grid/region_boundary.hpp"
#include "gearlash/grid.hpp"

namespace gearlash {

struct Contour {
  double level = 0.0;
  std::vector<MapCurve> curves = {};  ///< what is above the level lies on their left
};

/// Some six to twelve round numbers within the bulk of the values, of those that are finite and
/// positive, rising: in steps of 1, 2 or 5 times a power of ten, or by factors of about 1.5 where
/// the values span more than a factor of 12, of about 2 or more where that would be too many. None
/// where all values are the same.
std::vector<double> round_levels(std::vector<double> values);

/// Where the quantity has these levels. With plastic contact each point of the curves is worked
/// out, to 1e-6 of the picture, and beyond the end of hunting the quantity has its limit there:
/// contours of the amplitude run on to the hunting-free boundary. Where faces bounce,
/// and where drives are searched, the quantity is interpolated between the grid's points.
/// Precondition: `table` is the grid's, whose two axes are y, x.
std::vector<Contour> contours_of(const Grid& grid, const Table& table, Quantity quantity,
                                 const std::vector<double>& levels);

}  // namespace gearlash
