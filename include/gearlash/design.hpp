// What must change so that a drive meets a target, and how far it is from hunting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

// All of this header is answered in closed form. The functions throw InvalidInput for a drive that
// is not sound, for one without a closed form, with what it would need, and for a parameter that
// the closed form does not depend on, with those that there are. In SI.
//
// A parameter is given by its path or an alias ("gearbox.ratio", "controller.kp"). "tachometer" is
// feedback of the motor's speed that is added: in V s/rad, with torque control in N m s/rad. A
// normal form has also, as shares of what it has at present, "gear_ratio" and "error_gain"; as
// shares of all inertia "load_inertia" and "motor_inertia"; and as shares of the critical friction
// 2ω_n(J_M + J_L) "load_friction", "motor_friction" and "tachometer".

/// Limits that a drive has to keep all together. One that cannot hunt has amplitude 0 and keeps
/// every limit of frequency.
struct Target {
  bool no_hunting = false;               ///< it comes to rest from everywhere: Verdict::cannot_hunt
  Bounds amplitude{0.0, infinity};       ///< rad, half peak-to-peak of the load
  Bounds frequency{0.0, infinity};       ///< Hz
  Bounds growth_at_rest{0.0, infinity};  ///< below 1 it is a margin to hunting

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  bool operator==(const Target&) const = default;
};

/// Limits that contradict each other ("amplitude <= 1 deg and amplitude >= 2 deg"), or that nothing
/// can keep, each as a fault of "target".
[[nodiscard]] std::vector<Fault> faults(const Target& target);

/// How sure it is that no value is missing.
enum class SearchKind : std::uint8_t {
  certified,  ///< proved by bounds over every part of the range, but for slivers at its boundaries
  scanned     ///< looked for at many values, more of them where a limit is near: with bounces
};

/// The values of one parameter that meet a target.
struct FeasibleValues {
  std::string parameter{};  ///< its path, or "tachometer" and so on
  double present = 0.0;
  /// A thousandth to a thousand times the present value; of friction and feedback from 0 to ten
  /// times critical damping; of shares 0 to 1. Less where that is not permitted.
  Bounds searched{};
  SearchKind kind = SearchKind::certified;
  /// All values that meet the target, from the smallest on. Ends are the last numbers that meet it,
  /// to some 1e-15 of themselves (with bounces 1e-6 where the cycle ends at once), or the ends of
  /// the range.
  std::vector<Bounds> intervals{};
  /// Parts of the range of which it is not known. Certified: as a rule a billionth of their own
  /// value wide; within them limits are touched or crossed twice; they are feasible if both of
  /// their ends are. Scanned: beside values whose motion does not repeat, or is too long to follow;
  /// there cycles, and with them feasible values, come and go in windows as narrow as one likes.
  std::vector<Bounds> undecided{};
  /// Where nothing meets the target: the value that comes closest to it, of many that were tried.
  std::optional<double> closest{};
  std::size_t evaluations = 0;  ///< of servos and of boxes

  [[nodiscard]] bool contains(double value) const;
  /// The one that is nearest to the present value, by ratio; nothing where none meets the target.
  [[nodiscard]] std::optional<double> nearest() const;
};

/// With plastic contact proved, in milliseconds: no feasible value is skipped but for `undecided`.
/// With bounces scanned, in seconds: what is narrower than a 65th of the range can be missed. Also
/// throws InvalidInput for a target with faults().
[[nodiscard]] FeasibleValues feasible_values(const Drive& drive, std::string_view parameter,
                                             const Target& target);

/// The nearest values below and above the present one at which hunting starts, or stops where the
/// drive hunts at present: the last ones without hunting, to some 1e-15 of themselves. Nothing
/// where there is none in the range searched.
struct ParameterMargin {
  std::string parameter{};
  double present = 0.0;
  Bounds searched{};
  SearchKind kind = SearchKind::certified;  ///< certified: there is no nearer one
  bool hunts = false;                       ///< at present
  std::optional<double> below{};
  std::optional<double> above{};

  /// 100 (below/present − 1) < 0 and 100 (above/present − 1) > 0; nothing where the parameter is 0
  /// at present, as an added tachometer is.
  [[nodiscard]] std::optional<double> per_cent_below() const;
  [[nodiscard]] std::optional<double> per_cent_above() const;
};

enum class MarginOutcome : std::uint8_t {
  found,
  out_of_reach,  ///< no boundary met within a factor exp(10) in any direction
  always_hunts,  ///< a shaft without friction: no change by a ratio ends its hunting
  never_hunts    ///< no backlash
};

/// Natural logarithms of ratios, number by number, at the load's shaft.
struct LogChange {
  double motor_inertia = 0.0;   ///< of J_M
  double load_inertia = 0.0;    ///< of J_L
  double motor_friction = 0.0;  ///< of F_M
  double load_friction = 0.0;   ///< of F_L
  double stiffness = 0.0;       ///< of K

  [[nodiscard]] double length() const;  ///< root of the sum of squares
};

/// The smallest change of all numbers together that brings growth at rest to 1, with bounces too,
/// where a limit cycle may be left beside a rest that is stable (Verdict::hunts_if_disturbed).
///
/// Guaranteed: growth at rest is there 1 to within 1e-10, and no crossing nearer than that was met
/// along 138 rays spread over all directions, followed in steps of 0.02. Not guaranteed: that no
/// other part of the boundary comes nearer between the rays; a least change is a local minimum.
struct OverallMargin {
  MarginOutcome outcome = MarginOutcome::out_of_reach;
  bool hunts = false;                 ///< at present
  std::optional<LogChange> change{};  ///< from the present drive to the boundary, if found
  std::size_t starts = 0;             ///< of the search for a least change
  std::size_t converged = 0;          ///< of them, those that ended in one
};

struct HuntingMargin {
  double growth_at_rest = 0.0;  ///< it hunts above 1
  /// Of what a design looks at first: backlash, ratio, gain, frictions, added feedback, inertias;
  /// restitution where there is any.
  std::vector<ParameterMargin> parameters{};
  OverallMargin overall{};
  bool stopped = false;  ///< by Progress: parameters are missing
};

/// With plastic contact in some 30 ms; with bounces, where every value tried is a search for cycles
/// of its own, in seconds to minutes.
[[nodiscard]] HuntingMargin hunting_margin(const Drive& drive, Progress& progress = no_progress());

}  // namespace gearlash
