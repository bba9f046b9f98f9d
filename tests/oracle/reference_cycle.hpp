// The limit cycles of DESIGN's table, found by running the reference until it repeats.
#pragma once

#include <vector>

#include "model/normalized_servo.hpp"

namespace gearlash::oracle {

struct CycleCheck {
  NormalizedServo servo;
  double reference_amplitude;
  double reference_period;
  double library_amplitude;
  double library_period;
  bool agrees;  ///< amplitude and period to 1e-10 (relative)
};

std::vector<CycleCheck> check_known_cycles();

/// DESIGN's last row, restitution 0.9: the motion never repeats. Half the peak-to-peak of a long
/// run beside the library's irregular_amplitude.
struct IrregularCheck {
  NormalizedServo servo;
  double reference_amplitude;
  double library_amplitude;
  bool agrees;  ///< to 1 %: both are the extremes of a finite run
};

IrregularCheck check_irregular_motion();

}  // namespace gearlash::oracle
