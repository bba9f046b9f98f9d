// The worst drive that the tolerances permit.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "question/family/evaluation.hpp"
#include "question/series/samples.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash {

/// The effort of the search.
struct WorstSearch {
  std::size_t samples = 4096;  ///< Sobol points of the box, evaluated besides its corners
  std::size_t starts = 4;      ///< worst corners, and as many worst samples, to climb from; ≥ 1
  Quantity amplitude = Quantity::amplitude;  ///< of the load, or motor_amplitude
};

enum class PlaceInRange {
  fixed,   ///< only one value is possible
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
};

struct WorstCorner {
  std::vector<WorstNumber> numbers;  ///< in the order of drive.varied
  detail::SampleResult result;
  bool stopped = false;  ///< by Progress: then nothing holds
};

/// The drive with the largest amplitude (infinite where a drive grows without bound) in the box of
/// the supports; where no drive of the box hunts, the one with the largest growth at rest. An
/// unbounded support is cut off at its mean ± 3 standard deviations. All corners and some Sobol
/// points are evaluated, and the search climbs from the worst of both: along one parameter after
/// another, along the slope, and along the last displacement. Each line is examined over its whole
/// length within the box and refined about its worst point, until the value rises by less than a
/// relative 1e-12. Of lots only their values are tried. There is no proof that none is worse: a
/// narrow peak inside can be missed. The result is the same to the bit for any number of threads.
/// `progress` receives the share of the climbs (2·starts at most) that is done.
///
/// Of a drive that is searched only the ends of each range are tried: all corners up to 64 of them,
/// or Sobol's choice of corners, then one parameter after another. Throws InvalidInput.
WorstCorner worst_corner(const TolerancedDrive& drive, const WorstSearch& search = {},
                         const Workers& workers = {}, Progress& progress = no_progress());

}  // namespace gearlash
