// The step responses of a drive with its sensor here and there.
#pragma once

#include <string>

#include "output/comparison_report.hpp"
#include "picture/picture.hpp"

namespace gearlash {

/// The load over time, a curve for each place of the sensor. Throws OutputError.
std::string draw_comparison(const ComparisonReport& report, PictureFormat format);

}  // namespace gearlash
