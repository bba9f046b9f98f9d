// Pictures of a production run.
#pragma once

#include "output/tolerance_report.hpp"
#include "picture/plot.hpp"

namespace gearlash {

enum class TolerancePicture {
  distribution,  ///< share of samples over amplitude
  yield,         ///< share of samples with at most an amplitude
  indices        ///< share of the amplitude's variance for each parameter
};

/// Throws InvalidInput if no sample hunts, because then there is nothing to draw.
Plot tolerance_plot(const ToleranceReport& report, TolerancePicture picture);

}  // namespace gearlash
