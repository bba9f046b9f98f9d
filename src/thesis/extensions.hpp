// Recommendations 2 to 4 of the thesis: the charts it could not draw.
#pragma once

#include <string>
#include <vector>

#include "gearlash/progress.hpp"
#include "picture/line_chart.hpp"

namespace gearlash::thesis {

struct Extension {
  int number;          ///< of the recommendation, 2 … 4
  std::string wish;    ///< what the thesis recommends
  std::string lesson;  ///< what a designer learns
  LineChart chart;
};

/// 2: zero friction and zero inertia on either side; 3: inertia ratios from 10⁻³ to 10³; 4: contact
/// from plastic to elastic. Works the chart out, some seconds for 4, and calls
/// `done(share)` now and then. Precondition: 2 … 4.
Extension extension(int number, Progress& progress = no_progress());

}  // namespace gearlash::thesis
