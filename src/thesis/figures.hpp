// Figures 2 to 15 of the thesis: charts and phase trajectories, by the program of 1960 and exact.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/progress.hpp"
#include "model/normalized_servo.hpp"
#include "picture/curve_panel.hpp"

namespace gearlash::thesis {

// The grid of the charts. A friction ratio of 0.04 stands for 0.
inline constexpr double charted_backlash = 0.3;  ///< rad
inline constexpr int charted_dampings = 6;       ///< 0.1 … 0.6
inline constexpr std::array charted_inertia_ratios = {1.0 / 9.0, 1.0 / 4.0, 1.0, 4.0, 9.0};
inline constexpr std::array charted_friction_ratios = {0.04, 0.1, 0.2, 0.4, 0.6, 1.0};

/// A servo with their backlash.
NormalizedServo charted_servo(double damping, double inertia_ratio, double friction_ratio);

/// The parameter of a figure's axis.
enum class Along { friction_ratio, backlash, inertia_ratio };

struct FigureCurve {
  std::string name;
  NormalizedServo servo;  ///< apart from the parameter of the axis
};

struct Figure {
  int number;
  std::string caption;  ///< as in the thesis
  Along along;
  std::vector<double> grid;  ///< values at which the program was run
  std::vector<FigureCurve> curves;
};

/// Figures 2 … 11 on the grids of the thesis (backlash 0.3, 0.04 standing for friction ratio 0).
const std::vector<Figure>& thesis_figures();

/// The servo of a curve at one place of the axis.
NormalizedServo servo_at(const Figure& figure, const FigureCurve& curve, double place);

/// Computes a curve: exact_curve(), with the program's amplitudes as marks at the grid if it hunts.
/// Amplitudes are half the load's peak-to-peak, rad.
NamedCurve work_out(const Figure& figure, const FigureCurve& curve,
                    Progress& progress = no_progress());

/// The figure with all its curves.
Plot plot_of(const Figure& figure, Progress& progress = no_progress());

/// Figures 12 … 15: the step response in the phase plane, motor and load separate in the gap.
struct PhaseFigure {
  int number;
  std::string caption;
  NormalizedServo servo;
  double until;      ///< s, ω_n = 1
  double mark_size;  ///< of the program's points, dense in a small cycle
};

const std::vector<PhaseFigure>& thesis_phase_figures();

/// The exact trajectories, and marks where the program prints, every 0.08 s. In the thesis's
/// coordinate the motor and load positions are equal during contact on either face.
Plot plot_of(const PhaseFigure& figure);

/// Of both kinds, 2 … 15.
std::vector<int> figure_numbers();

/// The figure of that number; nothing for any other number.
std::optional<Plot> figure_plot(int number, Progress& progress = no_progress());

}  // namespace gearlash::thesis
