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
#include "gearlash/grid.hpp"
#include "gearlash/progress.hpp"
#include "gearlash/quantity.hpp"

namespace gearlash {

// All numbers are in SI. A parameter is given by its path or an alias ("gearbox.ratio",
// "controller.kp"). A normal form also has the numbers of the drive that it stands for
// (gearlash/parameter.hpp): "gearbox.ratio", "controller.proportional", "load.inertia" as a share
// of the total inertia, and so on.

/// The values of a quantity that a target permits.
struct QuantityLimit {
  Quantity quantity{};  ///< which one
  Bounds permitted{};   ///< SI, both ends included

  bool operator==(const QuantityLimit&) const = default;
};

/// Conditions that a drive must keep simultaneously.
struct Target {
  /// Small disturbances die down: not Verdict::hunts, hunts_irregularly, forced, undamped,
  /// grows_without_bound or runs_away. Larger ones may lead to hunting.
  bool no_hunting = false;
  /// No disturbance leads to hunting: not Verdict::hunts_if_disturbed either.
  bool no_hunting_if_disturbed = false;
  /// No start of the search ran away.
  bool no_runaway = false;
  /// Of any quantities in SI, each of them once. A drive that comes to rest has amplitude 0, and
  /// keeps every other limit of a motion. Of growth at rest a limit below 1 is a margin to hunting.
  std::vector<QuantityLimit> limits{};

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// The permitted values of a quantity: from −infinity to infinity if the target has no limit of
  /// it.
  [[nodiscard]] Bounds permitted(Quantity quantity) const;
  /// Narrows the permitted values of a quantity.
  Target& require(Quantity quantity, const Bounds& permitted);

  bool operator==(const Target&) const = default;
};

/// "no hunting" as version 0.1 meant it: every motion comes to rest.
[[nodiscard]] Target always_at_rest();

/// Limits that contradict each other ("amplitude <= 1 deg and amplitude >= 2 deg") or that no drive
/// can keep, each as a fault of "target".
[[nodiscard]] std::vector<Fault> faults(const Target& target);

/// How certain it is that no feasible value is missing.
enum class SearchKind : std::uint8_t {
  certified,  ///< proved by bounds over the whole range, except slivers near limits
  scanned,    ///< sampled, more densely near a limit; used where faces bounce
  searched    ///< any drive: analysed at each value of a grid, and followed between
};

/// What happens at an end of an interval.
enum class BorderKind : std::uint8_t {
  limit,           ///< a quantity reaches its limit, and the motion goes on
  fold,            ///< a stable and an unstable cycle meet, beyond which neither exists
  branching,       ///< a multiplier of a cycle passes 1: another cycle crosses it
  flip,            ///< a multiplier of a cycle passes −1: a cycle of twice the period begins
  neimark_sacker,  ///< two multipliers of a cycle leave the unit circle: motion on a torus begins
  grazing,         ///< a cycle comes to touch a border between two motions, or leaves it
  endless_period,  ///< the period of a cycle grows beyond all bounds
  rest,            ///< starts cease to lead to rest, or begin to
  unnamed          ///< the verdict changes, and no cycle that was followed accounts for it
};
/// "limit", "fold", "branching", "flip", "Neimark–Sacker", "grazing", "endless period", "rest",
/// "unnamed".
[[nodiscard]] const char* name_of(BorderKind kind);

struct Border {
  double end = 0.0;                       ///< of an interval of FeasibleValues
  BorderKind kind = BorderKind::unnamed;  ///< what happens there
  double at = 0.0;       ///< where it happens; the end where that is not known more closely
  double located = 0.0;  ///< the relative distance to which `at` is located
  std::string event{};   ///< of a grazing: "mode: event"; else empty
};

/// How far a target's limits of ceilings are proved over an interval of values.
struct IntervalProof {
  /// Rising, apart from each other: every value within keeps these limits, proved with outward
  /// rounding over all of it. What lies between them, usually next to the ends of the interval,
  /// where the limit is nearly reached, is searched.
  std::vector<Bounds> parts{};
  std::size_t boxes = 0;        ///< by whose bounds it is proved
  std::size_t evaluations = 0;  ///< of boxes
  std::string reason{};         ///< why nothing is proved
};

/// The values of one parameter that meet a target.
struct FeasibleValues {
  std::string parameter{};  ///< its path
  double present = 0.0;     ///< its value now, SI; NaN if it is not given
  Bounds searched{};        ///< the range of the axis, narrower where the drive permits less
  SearchKind kind = SearchKind::certified;  ///< how sure the intervals are
  /// All values that meet the target, rising. An end is the last number that meets it, to a
  /// relative 1e-15 (with bounces 1e-6 where the cycle vanishes abruptly), or the end of the range.
  std::vector<Bounds> intervals{};
  /// Parts of the range where feasibility is unknown. Certified: usually 1e-9 of their own value
  /// wide; limits are touched or crossed twice within them; they are feasible if both of their ends
  /// are. Scanned: next to values whose motion does not repeat or is too long to follow. Cycles,
  /// and feasible values with them, appear and vanish there in arbitrarily narrow windows.
  std::vector<Bounds> undecided{};
  /// Where nothing meets the target: the tried value that comes closest.
  std::optional<double> closest{};
  std::size_t evaluations = 0;  ///< of drives and of boxes of drives
  /// Searched: the values at which the drive was analysed afresh. What is narrower than the
  /// distance of two of them may be missed.
  std::vector<double> grid{};
  /// Searched: the relative distance to which ends are located where the motion changes abruptly,
  /// and 1e-9 where it does not.
  double located = 0.0;
  /// Searched: what happens at each end of an interval within the range. Folds and other
  /// bifurcations are located on the cycle that one side has alone, to 1e-9. They may lie beyond
  /// the first value that misses the target, where starts cease to lead to the cycle before it
  /// ends. Where a stable cycle that misses the target goes on into an interval in which no start
  /// leads to it, the interval ends with it; one that it fills is undecided.
  std::vector<Border> borders{};
  /// The conditions that were scanned within the intervals that the others leave, by values as
  /// dense as those of the grid. `kind` is that of the others.
  Target searched_within{};
  /// Of a number, one for each interval: how far what the target says of ceilings is proved.
  std::vector<IntervalProof> proofs{};
  bool stopped = false;  ///< by Progress: values not reached are undecided

  [[nodiscard]] bool contains(double value) const;
  [[nodiscard]] std::optional<double> nearest()
      const;  ///< the feasible value nearest to the present one, by ratio; empty where none is
  /// The value of each interval that is nearest to the present one; where nothing meets the target,
  /// the one that comes closest.
  [[nodiscard]] std::vector<double> nearest_of_each() const;
};

/// The values of an axis that meet the target, for any parameter of any drive; of a word its
/// choices. Where the closed form answers, the range of the axis is searched whatever its values.
/// With plastic contact that is certified, in milliseconds: no feasible value is missed outside
/// `undecided`. With bounces it is scanned, in seconds: intervals narrower than 1/65 of the range
/// can be missed. Any other drive is analysed by itself at each value of the axis and at the ends
/// of intervals, and followed between, in seconds to minutes, on all cores. Conditions on figures,
/// which need no motion (the linear loop, a step, ceilings), are scanned within what the others
/// permit: a condition more never loses a proof, a range or an interval. Throws InvalidInput for an
/// unsound drive, for the faults of the axis and of the target.
[[nodiscard]] FeasibleValues values(const Drive& drive, const Axis& axis, const Target& target,
                                    Progress& progress = no_progress());

/// The same over axis_to_search().
[[nodiscard]] FeasibleValues values(const Drive& drive, std::string_view parameter,
                                    const Target& target, Progress& progress = no_progress());

/// The range that a design searches: in closed form the ends of 0.001 to 1000 times the present
/// value, of 0 to ten times critical damping for what only adds friction, or of 0 to 1 for a share,
/// narrower where the drive permits less; else usual_axis(). Throws as usual_axis() does.
[[nodiscard]] Axis axis_to_search(const Drive& drive, std::string_view parameter);

/// The axis that is searched if nothing else is known: 25 values by ratio from 0.1 to 10 times the
/// present one, and 0 if it is permitted; 0 to 1 of a share; a usual range where the value is 0;
/// all words of a choice. Throws InvalidInput for a parameter that the drive does not have, and
/// where there is no such axis.
[[nodiscard]] Axis usual_axis(const Drive& drive, std::string_view parameter);

/// The parameters of a drive that are easiest to change, by their paths. In closed form: backlash,
/// ratio, gains, frictions, added feedback of the motor's speed, inertias and restitution. Else the
/// gap, and every number of the controller or of the normal form that is above 0.
[[nodiscard]] std::vector<std::string> usual_parameters(const Drive& drive);

/// The nearest values below and above the present one at which hunting starts, or stops if the
/// drive hunts at present: the last values without hunting. Empty where the searched range has
/// none.
struct ParameterMargin {
  std::string parameter{};                  ///< its path
  double present = 0.0;                     ///< NaN if it is not given
  Bounds searched{};                        ///< as of FeasibleValues
  SearchKind kind = SearchKind::certified;  ///< certified: no nearer value exists
  bool hunts = false;                       ///< at present; or it is not known to rest
  /// To a relative 1e-15 by the closed form, else to `located` of their value.
  std::optional<double> below{};
  std::optional<double> above{};  ///< the same upwards
  /// Of a word, searched: the choices with which a drive that hunts comes to rest, or one that
  /// rests hunts.
  std::vector<double> choices{};
  /// Searched: parts of the range where it is unknown whether the drive hunts.
  std::vector<Bounds> undecided{};
  std::vector<double> grid{};  ///< as of FeasibleValues
  double located = 0.0;        ///< as of FeasibleValues
  bool stopped = false;        ///< by Progress: values not reached are undecided

  /// 100 (below/present − 1) < 0 and 100 (above/present − 1) > 0; empty where the parameter is 0 at
  /// present, as an added tachometer is.
  [[nodiscard]] std::optional<double> per_cent_below() const;
  [[nodiscard]] std::optional<double> per_cent_above() const;
};

enum class MarginOutcome : std::uint8_t {
  found,
  out_of_reach,  ///< no boundary within a factor exp(10) in any direction
  always_hunts,  ///< a shaft has no friction: no scaling ends the hunting
  never_hunts    ///< no backlash
};

/// Natural logarithms of the ratios of changed to present values, at the load's shaft.
struct LogChange {
  double motor_inertia = 0.0;   ///< of J_M
  double load_inertia = 0.0;    ///< of J_L
  double motor_friction = 0.0;  ///< of F_M
  double load_friction = 0.0;   ///< of F_L
  double stiffness = 0.0;       ///< of K

  [[nodiscard]] double length() const;  ///< root of the sum of squares
};

/// The smallest combined change of all parameters that brings growth at rest to 1. With bounces a
/// limit cycle may remain there beside a stable rest (Verdict::hunts_if_disturbed).
///
/// Guaranteed: growth at rest equals 1 there to within 1e-10, and none of 138 rays spread over all
/// directions, followed in steps of 0.02, crosses the boundary nearer than that. Not guaranteed:
/// that no part of the boundary between the rays is nearer; a least change is a local minimum.
struct OverallMargin {
  MarginOutcome outcome = MarginOutcome::out_of_reach;  ///< whether there is one
  bool hunts = false;                                   ///< at present
  std::optional<LogChange> change{};  ///< from the present drive to the boundary, if found
  std::size_t starts = 0;             ///< starts of the search for a least change
  std::size_t converged = 0;          ///< starts that converged to a least change
};

/// A change of several parameters of a searched drive after which it starts to hunt, or stops. It
/// is an upper bound of the smallest such change, and never longer than the nearest change of one.
///
/// Let m_i be the logarithm of the ratio of the nearest border of parameter i to its present value.
/// The plane Σ x_i/m_i = 1 through these borders is nearest to the present drive in the direction
/// 1/m_i. The drive is searched along this direction, up to the least |m_i|.
struct CombinedMargin {
  std::vector<std::string> parameters{};  ///< their paths
  /// Of changed to present values: the last drive that does not hunt. All but one are 1 where no
  /// combined change is smaller than that of one parameter.
  std::vector<double> factors{};
  double distance = 0.0;  ///< root of the sum of the squares of the logarithms of the factors
  double located = 0.0;   ///< relative distance to which `distance` is located
};

struct HuntingMargin {
  bool hunts = false;  ///< at present
  /// Whether it is known that the drive hunts, or that it does not. Otherwise there are margins of
  /// single parameters alone: the nearest values at which it is known not to hunt.
  bool is_known = true;
  std::optional<double> growth_at_rest{};  ///< closed form: the drive hunts above 1
  /// Closed form: the parameters a designer considers first: backlash, ratio, gain, frictions,
  /// added feedback, inertias, and a restitution above 0. Searched: usual_parameters().
  std::vector<ParameterMargin> parameters{};
  std::optional<OverallMargin> overall{};    ///< closed form
  std::optional<CombinedMargin> combined{};  ///< searched, if any parameter has a border
  bool stopped = false;                      ///< by Progress: parameters are missing
};

/// By the closed form where there is one: about 30 ms with plastic contact. With bounces it takes
/// seconds to minutes, because each value tried needs its own search for cycles. Other drives are
/// searched, with some 30 verdicts for each parameter, which takes seconds to minutes too. Not to
/// hunt is to keep always_at_rest(). Throws InvalidInput for an unsound drive.
///
/// Of the parameters of these axes alone, searched whatever the drive; no axes: the usual ones.
[[nodiscard]] HuntingMargin margins(const Drive& drive, const std::vector<Axis>& axes = {},
                                    Progress& progress = no_progress());

}  // namespace gearlash
