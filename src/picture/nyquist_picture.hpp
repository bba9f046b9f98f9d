// The classical picture of the describing function: the loop's gain against −1/N.
#pragma once

#include <string>
#include <vector>

#include "analysis/describing/describing.hpp"
#include "input/units.hpp"
#include "picture/picture.hpp"

namespace gearlash {

struct NyquistPicture {
  std::string title = {};  ///< one line
  /// Nonlinearities that see the same loop, which is drawn once. At least one; all are in it.
  std::vector<drive::DescribingAnalysis> analyses = {};
  std::vector<Cycle> exact = {};  ///< the stable ones are drawn
  AngleUnit angle = {};
  bool is_normalized = false;  ///< times are in units of 1/ω_n, and frequencies ω
};

/// Those of this part, for a gap of either kind of load; empty where it is in no loop.
std::vector<drive::DescribingAnalysis> of_one_loop(
    const std::vector<drive::DescribingAnalysis>& analyses, drive::DescribedPart part);

/// L(jω) with marks of frequency, −1/N(A) with marks of amplitude and an arrow to where A grows,
/// the cycles where they meet (full circles stable, open ones unstable), and of each exact cycle
/// the points L(jω) and −1/N(A), the motor's exact motion taken for a sine, which would be one if
/// the method were exact. Real and imaginary parts have the same scale. Drawn is the part with the
/// stable cycles and what is exact; unstable cycles beyond it are told in the legend alone.
///
/// Bytes of the picture; the same analyses give the same SVG. Throws OutputError where gnuplot is
/// missing or fails.
std::string draw_nyquist(const NyquistPicture& picture, PictureFormat format);

}  // namespace gearlash
