// Pictures of a production run.
#pragma once

#include <string>

#include "output/tolerance_report.hpp"
#include "picture/picture.hpp"

namespace gearlash {

enum class TolerancePicture {
  distribution,  ///< share of samples over amplitude
  yield,         ///< share of samples with at most an amplitude
  indices        ///< share of the amplitude's variance for each parameter
};

/// Returns the bytes of the picture. Throws OutputError if gnuplot is missing or fails, and
/// InvalidInput if no sample hunts, because then there is nothing to draw.
std::string draw_tolerances(const ToleranceReport& report, TolerancePicture picture,
                            PictureFormat format);

}  // namespace gearlash
