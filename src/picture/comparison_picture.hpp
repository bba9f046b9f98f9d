// The step responses of a drive for each place of its sensor.
#pragma once

#include <string>

#include "output/comparison_report.hpp"
#include "picture/picture.hpp"

namespace gearlash {

/// Draws the load over time, one curve for each place of the sensor. Throws OutputError.
std::string draw_comparison(const ComparisonReport& report, PictureFormat format);

}  // namespace gearlash
