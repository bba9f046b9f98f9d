// The charts that recommendations 2 to 4 of the thesis ask for.
#pragma once

#include <string>
#include <vector>

#include "gearlash/progress.hpp"
#include "picture/curve_panel.hpp"

namespace gearlash::thesis {

struct Extension {
  int number;          ///< number of the recommendation, 2 … 4
  std::string wish;    ///< the recommendation
  std::string lesson;  ///< the conclusion for a designer
  Plot plot = {};
};

/// 2: zero friction and zero inertia on either side; 3: inertia ratios from 10⁻³ to 10³; 4: contact
/// from plastic to elastic. Computes the plot, which takes some seconds for 4, and reports
/// `progress`. Precondition: number in 2 … 4.
Extension extension(int number, Progress& progress = no_progress());

}  // namespace gearlash::thesis
