// How far a drive is from the boundary of hunting: by each parameter alone, and by all together.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/design/changeable_drive.hpp"
#include "analysis/design/feasible_values.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

/// The nearest values below and above the present one at which hunting starts, or stops where the
/// drive hunts at present; NaN where there is none in the range searched.
struct ParameterMargin {
  std::string parameter;  ///< ChangeableNumber::name
  double present = 0.0;
  Bounds searched;
  SearchKind kind = SearchKind::certified;  ///< certified: there is no nearer one (feasible_values)
  bool hunts = false;                       ///< at present
  double below = std::numeric_limits<double>::quiet_NaN();
  double above = std::numeric_limits<double>::quiet_NaN();

  /// 100 (below/present − 1) < 0 and 100 (above/present − 1) > 0; NaN where the parameter is 0 at
  /// present, as an added tachometer is.
  double per_cent_below() const { return 100.0 * (below / present - 1.0); }
  double per_cent_above() const { return 100.0 * (above / present - 1.0); }
};

/// By feasible_values() for a target of no hunting, whose ends they are: the last value without
/// hunting, to some 1e-15 of itself.
ParameterMargin parameter_margin(const ChangeableDrive& drive, std::string_view parameter);

enum class MarginOutcome {
  found,
  out_of_reach,  ///< no boundary met within a factor exp(10) in any direction
  always_hunts,  ///< a shaft without friction: no change by a ratio ends its hunting
  never_hunts    ///< no backlash
};

/// Natural logarithms of ratios, number by number.
struct LogChange {
  double motor_inertia = 0.0;   ///< of J_M
  double load_inertia = 0.0;    ///< of J_L
  double motor_friction = 0.0;  ///< of F_M
  double load_friction = 0.0;   ///< of F_L
  double stiffness = 0.0;       ///< of K

  double length() const;  ///< root of the sum of squares
};

struct OverallMargin {
  MarginOutcome outcome = MarginOutcome::out_of_reach;
  bool hunts = false;                                          ///< at present
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< |change|
  LogChange change;        ///< from the present drive to the boundary
  Drivetrain at_boundary;  ///< the drive so changed
  double growth_at_boundary = std::numeric_limits<double>::quiet_NaN();  ///< 1 ± 1e-10
  std::size_t starts = 0;     ///< of the search for a least change
  std::size_t converged = 0;  ///< of them, those that ended in one
};

/// The smallest change of all numbers together that brings growth at rest to 1, with bounces too,
/// where a limit cycle may be left beside a rest that is stable (Verdict::hunts_if_disturbed):
///   min |x|  subject to  ln μ₀(J_M e^{x₁}, J_L e^{x₂}, F_M e^{x₃}, F_L e^{x₄}, K e^{x₅}) = 0.
/// By the steps x ← g (g·x − ln μ₀)/|g|², g the exact gradient of ln μ₀, cut short where they do
/// not lower ½|x|² + k|ln μ₀|, and at last by Newton's method on x = λg, ln μ₀ = 0 (Hasofer & Lind
/// 1974; Rackwitz & Fiessler 1978; Zhang & Der Kiureghian 1995: it is their design point). μ₀ does
/// not depend on the units of torque and time, so that x lies in a space of three dimensions; the
/// search starts from no change and from the nearest eight of the first crossings of the boundary
/// along 128 directions spread over that space and 10 along the axes.
///
/// Guaranteed: the drive given has |μ₀ − 1| < 1e-10, and no crossing nearer than the distance was
/// met along those 138 rays, followed in steps of 0.02. Not guaranteed: that no other part of the
/// boundary comes nearer between the rays; a least change is a local minimum. Throws InvalidInput.
OverallMargin overall_margin(const Drivetrain& drive);

struct HuntingMargin {
  double growth_at_rest = std::numeric_limits<double>::quiet_NaN();
  std::vector<ParameterMargin> parameters;  ///< of drive.usual_names(), in their order
  OverallMargin overall;
};

/// Of what a design looks at first (ChangeableDrive::usual_names()); of restitution where there is
/// any. With plastic contact it takes some 30 ms; with bounces, where every value tried is a search
/// for cycles of its own, seconds to minutes. Throws InvalidInput.
HuntingMargin hunting_margin(const ChangeableDrive& drive, Progress& progress = no_progress());

}  // namespace gearlash
