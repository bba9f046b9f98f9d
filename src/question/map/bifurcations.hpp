// Cycles over one parameter as branches, with the borders at which they end or change.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "question/analyse.hpp"
#include "question/axis.hpp"

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

/// Where something changes. Words: those of BorderKind ("fold", "flip", "grazing", …), "events
/// change", "stability changes", "cycle is lost" (of an unknown reason), "loss of rest", "border of
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
/// or unstable, towards both neighbours by Newton's method, in steps that are halved down to 1/512
/// of an interval where it fails. A branch ends there. What happens where a branch ends, or changes
/// its stability, is found by following the cycle itself (end_of_cycle()). Where that names
/// nothing, two branches of unlike stability that end together are a fold; a cycle of about this
/// amplitude beyond the end with other events is a change of events. Rest and running away are
/// borders located by 6 bisections, of closed forms by 40. Values at which the drive is not valid
/// are left out. Cycles in closed form are joined to those of the next value by amplitude; where
/// their stability changes, the border is half-way between two values: a "flip" if the multiplier
/// is negative, else "stability changes", because complex multipliers are known by their modulus
/// alone. Precondition: two or more numbers on the axis, and no faults in the grid of this axis.
BifurcationDiagram bifurcations_of(const Drive& drive, const Axis& axis,
                                   Progress& progress = no_progress());

}  // namespace gearlash
