// What the data of a grid say of the grid itself: axes, fixed numbers, origin.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gearlash/grid.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "output/netcdf_file.hpp"
#include "question/map/map_regions.hpp"

namespace gearlash {

/// The description that a grid's file holds.
struct GridContents {
  Grid grid;
  std::vector<Quantity> quantities;  ///< besides the verdict
  Provenance provenance;
  std::string source_text = {};  ///< of the sweep file; empty without one
};

/// The names of variables; those of quantities and axes are their own.
inline constexpr char verdict_name[] = "verdict";
inline constexpr char target_name[] = "target";
std::string boundary_name(const Axis& axis);

/// What a file has besides the answers of every grid.
struct GridExtras {
  bool has_target = false;          ///< whether each point meets a target
  std::size_t boundary_points = 0;  ///< of a map, gaps included; 0: no boundary
};
/// Dimensions, attributes and variables, those of the extras last.
NetcdfDescription description_of(const GridContents& contents, const GridExtras& extras);

/// How flags store whether a point meets a target.
std::vector<std::byte> target_flags(std::span<const PlaceKind> kinds);

}  // namespace gearlash
