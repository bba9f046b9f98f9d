// The region of two parameters that meets a target, and what that costs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/design/changeable_drive.hpp"
#include "analysis/design/target.hpp"
#include "analysis/grid/contours.hpp"
#include "analysis/grid/region_boundary.hpp"

namespace gearlash {

/// The measure of what a change costs or gains.
enum class Cost {
  bandwidth,  ///< ω_n relative to the present one
  damping,    ///< ζ
  stiffness   ///< K relative to the present one
};

/// "bandwidth", "damping", "stiffness".
const char* name_of(Cost cost);

/// A parameter on an axis of a picture, in the parameter's own unit.
struct ParameterAxis {
  std::string parameter;  ///< ChangeableNumber::name
  Axis values;            ///< `path` is not used
};

/// `count` values of the range, spaced by ratio where low > 0.
ParameterAxis parameter_axis(std::string_view parameter, const Bounds& range, std::size_t count);

/// The number of values per axis that a fraction of a second allows, or a minute with bounces.
std::size_t values_to_draw(const ChangeableDrive& drive, std::string_view x, std::string_view y);

/// 1/30 to 30 times the present value. Numbers that may be 0: from 0 to critical damping.
Bounds range_to_draw(const ChangeableDrive& drive, std::string_view parameter);

struct FeasibleRegion {
  ParameterAxis x;
  ParameterAxis y;
  std::vector<MapCurve> boundary;  ///< the region on its left; see boundary_of_region()
  std::vector<Contour> costs;      ///< lines of equal cost at round values
};

/// Regions narrower than a cell of the axes' values can be missed, as with boundary_of_region().
/// Stopped by Progress, it has holes.
/// Precondition: two different parameters, and faults(target) is empty.
FeasibleRegion feasible_region(const ChangeableDrive& drive, const ParameterAxis& x,
                               const ParameterAxis& y, const Target& target, Cost cost,
                               Progress& progress = no_progress());

/// Whether the target is met at a place; unknown where there is no valid drive.
Side side_of_target(const ChangeableDrive& drive, const FeasibleRegion& region,
                    const MapPoint& place, const Target& target);

}  // namespace gearlash
