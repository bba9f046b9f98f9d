// Pictures of what a production run will do.
#pragma once

#include <string>

#include "output/tolerance_report.hpp"
#include "picture/picture.hpp"

namespace gearlash {

enum class TolerancePicture {
  distribution,  ///< how many pieces have which size
  yield,         ///< what share has at most which size
  indices        ///< what share of the variance of the size goes with each number
};

/// Bytes of the picture. Throws OutputError where gnuplot is missing or fails, and InvalidInput
/// where there is nothing to draw: no piece hunts.
std::string draw_tolerances(const ToleranceReport& report, TolerancePicture picture,
                            PictureFormat format);

}  // namespace gearlash
