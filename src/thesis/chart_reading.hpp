// Appendix C: reading the amplitude of a limit cycle off the charts of 1960.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/normalized_servo.hpp"

namespace gearlash::thesis {

/// A design chart (figures 7 to 11): the program's amplitudes on the grid, 0 without hunting.
struct DesignChart1960 {
  int figure = 7;
  double friction_ratio = 0.1;
  std::vector<double> inertia_ratios;           ///< 1/9 … 9
  std::vector<double> dampings;                 ///< 0.1 … 0.6
  std::vector<std::vector<double>> amplitudes;  ///< [damping][inertia ratio], rad for backlash 0.3
};

/// The charts of the thesis, computed by its program (150 runs, about a second).
const std::vector<DesignChart1960>& design_charts_1960();

/// The four steps of Appendix C.
struct ChartReading {
  const DesignChart1960* chart = nullptr;  ///< step 2: nearest friction ratio
  std::array<double, 2> neighbours{};      ///< dampings of the two curves
  std::array<double, 2> read{};            ///< step 3: amplitudes on these curves
  double chart_amplitude = 0.0;            ///< step 3: between them, for backlash 0.3
  double amplitude = 0.0;                  ///< step 4: for the servo's backlash
};

/// The sources of a reading's error: factors, each minus 1, with the product reading/exact.
struct ReadingError {
  double friction_ratio = 0.0;  ///< the nearest chart's, not the servo's
  double damping = 0.0;         ///< linear between two curves
  double inertia_ratio = 0.0;   ///< curves through five points
  double program = 0.0;         ///< the program's amplitudes at them
  double whole = 0.0;           ///< product of all
};

/// Reads the charts by smooth curves through the grid points over the logarithm of the inertia
/// ratio, and linearly in the damping between curves. Throws InvalidInput for a damping outside 0.1
/// … 0.6 or an inertia ratio outside 1/9 … 9, the ranges of the charts.
ChartReading read_chart(const NormalizedServo& servo);

/// Nothing if the servo or its neighbours on the chart do not hunt.
std::optional<ReadingError> reading_error(const NormalizedServo& servo,
                                          const ChartReading& reading);

}  // namespace gearlash::thesis
