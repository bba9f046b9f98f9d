// Appendix C: the size of a limit cycle as one read it off the charts of 1960.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/normalized_servo.hpp"

namespace gearlash::thesis {

/// A design chart (figures 7 to 11): the program's sizes on the grid, 0 where it did not hunt.
struct DesignChart1960 {
  int figure = 7;
  double friction_ratio = 0.1;
  std::vector<double> inertia_ratios;           ///< 1/9 … 9
  std::vector<double> dampings;                 ///< 0.1 … 0.6
  std::vector<std::vector<double>> amplitudes;  ///< [damping][inertia ratio], rad for backlash 0.3
};

/// The charts of the thesis, worked out by its program (150 runs, a second or so).
const std::vector<DesignChart1960>& design_charts_1960();

/// The four steps of Appendix C.
struct ChartReading {
  const DesignChart1960* chart = nullptr;  ///< step 2: that of the nearest friction ratio
  std::array<double, 2> neighbours{};      ///< dampings of the curves read between
  std::array<double, 2> read{};            ///< step 3: sizes read off these curves
  double chart_amplitude = 0.0;            ///< and between them, for backlash 0.3
  double amplitude = 0.0;                  ///< step 4: for the backlash given
};

/// Where a reading's error comes from: factors whose product is reading/exact, each less 1.
struct ReadingError {
  double friction_ratio = 0.0;  ///< the nearest chart's instead of the servo's
  double damping = 0.0;         ///< a straight line between two curves
  double inertia_ratio = 0.0;   ///< curves drawn through five points
  double program = 0.0;         ///< the program's sizes at those points
  double whole = 0.0;           ///< of all
};

/// Curves are drawn smoothly through the grid points over the logarithm of the inertia ratio, and
/// between curves sizes are shared in proportion to damping. Throws InvalidInput for a damping
/// outside 0.1 … 0.6 or an inertia ratio outside 1/9 … 9, which the charts do not have.
ChartReading read_chart(const NormalizedServo& servo);

/// Nothing where the servo, or its neighbours on the chart, do not hunt.
std::optional<ReadingError> reading_error(const NormalizedServo& servo,
                                          const ChartReading& reading);

}  // namespace gearlash::thesis
