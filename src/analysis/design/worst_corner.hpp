// The worst drive that the tolerances permit.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/design/target.hpp"
#include "analysis/design/toleranced_drive.hpp"
#include "analysis/grid/grid_evaluation.hpp"

namespace gearlash {

/// How hard it is looked for.
struct WorstSearch {
  std::size_t samples = 4096;  ///< Sobol points of the box that are looked at beside its corners
  std::size_t starts = 4;      ///< best corners, and as many best samples, to climb from; ≥ 1
};

enum class PlaceInRange {
  fixed,   ///< there is but one value
  at_low,  ///< at the lowest possible value
  inside,  ///< between
  at_high
};

/// "fixed", "at low", "inside", "at high".
const char* name_of(PlaceInRange place);

struct WorstNumber {
  std::string path;
  double value = 0.0;
  PlaceInRange place = PlaceInRange::fixed;
  Bounds range;                     ///< searched: three_sigma_range_of()
  bool low_is_at_3_sigma = false;   ///< the distribution has no lowest value
  bool high_is_at_3_sigma = false;  ///< it has no highest
};

struct WorstCorner {
  std::vector<WorstNumber> numbers;  ///< in the order of drive.varied
  Performance performance;
  std::size_t evaluations = 0;
  std::size_t unknown = 0;  ///< evaluations of drives whose amplitude is not known: not compared
};

/// The largest amplitude (infinite where a drive grows without bound) over the box of supports,
/// which where a distribution has no end is cut off at its mean ± 3 standard deviations; where no
/// drive of the box hunts, the largest growth at rest. All corners are evaluated and some Sobol
/// points; from the best of both the search climbs, along one number after another, the slope and
/// the way last gone, each line looked at along its whole length within the box and refined about
/// its best point, until the value rises by less than 1e-12 of itself. Of lots only their values
/// are tried. No proof that there is none worse: a narrow peak inside can be missed. The same bits
/// for any number of threads. `progress` hears the share of the climbs, 2·starts at most, that is
/// done, and is not asked. Throws InvalidInput.
WorstCorner worst_corner(const TolerancedDrive& drive, const WorstSearch& search = {},
                         const Workers& workers = {}, Progress& progress = no_progress());

}  // namespace gearlash
