// Cycles over one parameter as branches, with the borders at which they end or change.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "analysis/analyse.hpp"
#include "analysis/grid/axis.hpp"

namespace gearlash {

/// A cycle at one value of the parameter. Numbers are those of Cycle.
struct CycleAt {
  double parameter = 0.0;
  Stability stability = Stability::stable;
  double amplitude = 0.0;
  double motor_amplitude = 0.0;
  double period = 0.0;                        ///< s; infinite where hunting ends
  std::complex<double> multiplier{0.0, 0.0};  ///< the largest by modulus
  std::size_t events = 0;                     ///< in a period
};

/// Cycles of one stability that continue one another, by rising parameter.
struct CycleBranch {
  Stability stability = Stability::stable;
  std::vector<CycleAt> points{};
};

/// Where something changes. Words: "fold", "flip", "Neimark–Sacker", "pitchfork", "events change",
/// "stability changes", "cycle is lost" (of an unknown reason), "loss of rest", "border of
/// running away"; others may be given.
struct MarkedBorder {
  double parameter = 0.0;
  std::string word{};
  /// Of the cycle that changes; empty for a border of all motion.
  std::optional<CycleAt> cycle{};
};

/// Bounded motion at a value that was not seen to repeat.
struct IrregularAt {
  double parameter = 0.0;
  double amplitude = 0.0;
  double motor_amplitude = 0.0;
};

struct BifurcationDiagram {
  std::vector<CycleBranch> branches{};
  std::vector<IrregularAt> irregular{};
  std::vector<MarkedBorder> borders{};
  /// Intervals of the parameter in which starts come to rest. No interval means nowhere.
  std::vector<Bounds> rests{};
  std::size_t searched = 0;  ///< values
  bool is_complete = true;   ///< not stopped
};

/// Analyses the drive at each value of the axis, and follows every cycle found at one value, stable
/// or unstable, towards both neighbours by Newton's method, in steps that are halved down to 1/32
/// of an interval where it fails. A branch ends there. The words of its end follow from what is
/// seen at it: a fold has a branch of the other stability that ends beside it, or a multiplier near
/// 1; a change of events has a cycle of about this amplitude beyond it with other events. A change
/// of stability is located by bisection and named by the multiplier that leaves the unit circle (1:
/// pitchfork, −1: flip, complex: Neimark–Sacker). Rest and running away are borders located by 6
/// bisections, of closed forms by 40. Values at which the drive is not valid are left out.
/// Cycles in closed form are joined to those of the next value by amplitude; where their stability
/// changes, the border is half-way between two values: a "flip" if the multiplier is negative, else
/// "stability changes", because complex multipliers are known by their modulus alone.
/// Precondition: two or more numbers on the axis, and no faults in the grid of this axis.
BifurcationDiagram bifurcations_of(const Drive& drive, const Axis& axis,
                                   Progress& progress = no_progress());

}  // namespace gearlash
