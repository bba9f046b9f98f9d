// Regions of a map in which drives have one kind of motion.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "question/family/evaluation.hpp"
#include "question/map/region_boundary.hpp"

namespace gearlash {

/// Verdicts, as far as a region is named by them.
enum class MotionKind : std::uint8_t { rests, hunts_if_disturbed, hunts, runs_away, not_known };

MotionKind kind_of(Verdict verdict);
/// "comes to rest", "hunts if disturbed", "hunts", "runs away", "not known".
std::string_view name_of(MotionKind kind);

struct MotionRegion {
  MotionKind kind{};
  /// Closed curves with the region on their left, partly along the map's edges.
  std::vector<MapCurve> outlines{};
};

/// The regions of a map over two axes of numbers, by kind. Between two points of the grid that
/// differ in kind, the border is located by searches to 1/400 of the axis; within a cell it is
/// straight. Stopped by `progress`: it lies half-way there. Precondition: `table` belongs to the
/// grid, whose axes are y, x.
std::vector<MotionRegion> motion_regions(const Grid& grid, const Table& table,
                                         Progress& progress = no_progress());

/// The outlines without the parts along the map's edges, each border once.
std::vector<MapCurve> borders_of(const std::vector<MotionRegion>& regions, const Grid& grid);

}  // namespace gearlash
