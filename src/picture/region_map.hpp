// A picture of where two parameters meet a target.
#pragma once

#include <string>

#include "analysis/design/feasible_region.hpp"
#include "output/report_units.hpp"
#include "picture/contour_map.hpp"

namespace gearlash {

/// What is drawn, and how its author calls it.
struct RegionMapTask {
  ChangeableDrive drive;
  Target target;
  std::string target_text;
  Cost cost = Cost::bandwidth;
  AngleUnit angle = {};  ///< of a backlash on an axis
};

/// The region bold, hatched where the target is missed, over lines of equal cost; a point where the
/// drive is now.
ContourMap map_of(const RegionMapTask& task, const ParameterAxis& x, const ParameterAxis& y);

}  // namespace gearlash
