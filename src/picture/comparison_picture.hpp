// The step responses of drives side by side.
#pragma once

#include <string>

#include "output/comparison_report.hpp"
#include "picture/picture.hpp"

namespace gearlash {

/// Draws the load over time, one curve for each drive, until the last one stays or ends. Throws
/// OutputError.
std::string draw_comparison(const ComparisonReport& report, PictureFormat format);

}  // namespace gearlash
