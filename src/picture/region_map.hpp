// A map of the values of two parameters that meet a target.
#pragma once

#include <string>

#include "output/report_units.hpp"
#include "picture/contour_map.hpp"
#include "question/change/feasible_region.hpp"

namespace gearlash {

/// The subject of the map, and the author's words for it.
struct RegionMapTask {
  Drive drive{};
  Target target;
  std::string target_text;
  Cost cost = Cost::bandwidth;
  AngleUnit angle = {};  ///< unit of a backlash on an axis
};

/// Lines of equal cost, the region's boundary in bold, hatching where the target is missed, and a
/// mark at the present drive. Stopped by Progress, it has holes.
ContourMap map_of(const RegionMapTask& task, const Axis& x, const Axis& y,
                  Progress& progress = no_progress());

}  // namespace gearlash
