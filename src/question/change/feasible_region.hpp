// The region of two parameters that meets a target, and what that costs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "question/change/target.hpp"
#include "question/map/contours.hpp"
#include "question/map/region_boundary.hpp"

namespace gearlash {

/// The measure of what a change costs or gains.
enum class Cost {
  bandwidth,  ///< ω_n relative to the present one
  damping,    ///< ζ
  stiffness   ///< K relative to the present one
};

/// "bandwidth", "damping", "stiffness".
const char* name_of(Cost cost);

/// 1/30 to 30 times the present value, by ratio; of what only adds friction and is 0 at present
/// from 0 to critical damping; of a share all of it. Precondition: a number that enters the closed
/// form.
Axis axis_to_draw(const Drive& drive, std::string_view parameter, std::size_t count);

/// The number of values per axis that a fraction of a second allows, or a minute with bounces.
/// Precondition: as above.
std::size_t values_to_draw(const Drive& drive, std::string_view x, std::string_view y);

struct FeasibleRegion {
  Axis x;
  Axis y;
  std::vector<MapCurve> boundary;  ///< the region on its left; see boundary_of_region()
  std::vector<Contour> costs;      ///< lines of equal cost at round values
};

/// Regions narrower than a cell of the axes' values can be missed, as with boundary_of_region().
/// Stopped by Progress, it has holes.
/// Precondition: a drive in closed form, two different numbers that enter it, and faults(target) is
/// empty.
FeasibleRegion feasible_region(const Drive& drive, const Axis& x, const Axis& y,
                               const Target& target, Cost cost, Progress& progress = no_progress());

/// Whether the target is met at a place; unknown where there is no valid drive.
Side side_of_target(const Drive& drive, const FeasibleRegion& region, const MapPoint& place,
                    const Target& target);

}  // namespace gearlash
