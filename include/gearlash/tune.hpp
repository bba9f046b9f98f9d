// The best values of several parameters for all drives of a series.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/progress.hpp"
#include "gearlash/tolerance.hpp"

namespace gearlash {

/// What is best among drives that keep the target.
enum class Aim : std::uint8_t {
  bandwidth,    ///< greatest: of the linear loop, to -3 dB
  settling,     ///< shortest: of a step, into 5 % of it
  static_error  ///< least: the largest error in the end, Quantity::error
};

struct TuneTask {
  TolerancedDrive series{};   ///< what varies from unit to unit; without tolerances it is one drive
  std::vector<Axis> tuned{};  ///< numbers, each sought from its first to its last value, by ratio
                              ///< where the axis is logarithmic
  Target target{};            ///< which each unit must keep
  Aim aim = Aim::bandwidth;   ///< judged by the unit that is worst in it
  double share = 1.0;         ///< of the units that must keep the target, above 0 to 1
  /// rad, 0 … π/2: units whose linear loop has less are not considered, and need no search.
  double least_phase_margin = 0.5235987755982988;  // 30 deg
};

/// How far a tuning goes.
struct TuneEffort {
  std::size_t units = 64;     ///< of the series, to which each proposal is put, ≥ 1
  std::size_t rounds = 8;     ///< of proposing and trying, ≥ 1
  int evaluations = 60;       ///< of proposals, each by the units that limited earlier ones, ≥ 1
  std::uint64_t seed = 1960;  ///< of the units
};

/// A unit of the series with the tuned values.
struct TunedUnit {
  std::vector<double> values{};  ///< of TolerancedDrive::varied, in their order
  Answer answer{};               ///< of the unit
};

struct TunedDrive {
  std::vector<double> values{};  ///< of TuneTask::tuned, in their order
  Drive drive{};                 ///< the nominal drive with them
  bool meets = false;            ///< the share of the units that were tried
  std::size_t units = 0;         ///< tried with these values
  std::size_t met = 0;           ///< of them
  std::size_t undecided = 0;     ///< of those that did not meet it
  /// Of the aim, by the worst of the units tried: rad/s, s, rad. NaN where it is unknown.
  double reached = std::numeric_limits<double>::quiet_NaN();
  /// The unit that misses the target most; where all meet it, the one that ended the last proposal
  /// that failed. Empty where no unit limited any.
  std::optional<TunedUnit> limiting{};
  bool by_derivatives = false;  ///< the last proposal was closed in on by derivatives
  std::size_t rounds = 0;       ///< of proposing and trying
  std::size_t analyses = 0;     ///< of single drives
  bool stopped = false;         ///< by Progress: the best by then
};

/// Every fault of the series, of the axes (words; less than two values; a parameter that also
/// varies), of the target and of the ranges above.
[[nodiscard]] std::vector<Fault> faults(const TuneTask& task, const TuneEffort& effort = {});

/// Proposes values by optimisers (NLopt) on the few units that limited earlier proposals: DIRECT-L
/// over all values, and from the best of them SLSQP with derivatives where there are any: a
/// bandwidth, under limits of the cycle's amplitude, frequency and period, of bandwidth and phase
/// margin, and of growth at rest with a closed form (not: encoders, computers, rest of drives that
/// are searched); else Subplex. It puts each proposal to all units of a fixed sample (the
/// mean, 16 corners at most, then Sobol's points), and adds those that miss the target
/// most, until a proposal holds for the share of them (Mutapcic and Boyd, Optimization Methods and
/// Software 24, 2009). Searched, not proved: neither that all units of the series keep the target,
/// nor that no other values are better. Takes minutes. The same on every machine and any number of
/// cores. Throws InvalidInput for a task with faults().
[[nodiscard]] TunedDrive tune(const TuneTask& task, const TuneEffort& effort = {},
                              Progress& progress = no_progress());

/// The controller's gains that are above 0, by their paths.
[[nodiscard]] std::vector<std::string> usual_gains(const Drive& drive);

/// usual_axis() without the value 0, by ratio where it is positive. Throws as that does.
[[nodiscard]] Axis usual_axis_to_tune(const Drive& drive, std::string_view parameter);

/// To come to rest, or to move the sensed shaft by one step of its encoder at most. No start may
/// run away. Precondition: a sound drive.
[[nodiscard]] Target usual_target(const Drive& drive);

/// Why integral action must hunt: with static friction above Coulomb friction, an exact sensor and
/// no dead band no integral gain lets a drive rest (Armstrong-Hélouvry and Amin, Automatica 32,
/// 1996). Empty where that does not apply. Precondition: a sound drive.
[[nodiscard]] std::optional<std::string> why_integral_action_hunts(const Drive& drive);

/// The task for the drive without integral action, P in place of PI or PD of PID or a cascade whose
/// speed has no integral, and without what then does not exist. Empty where there is none to give
/// up, or nothing is left to tune. Precondition: a task without faults().
[[nodiscard]] std::optional<TuneTask> without_integral_action(const TuneTask& task);

}  // namespace gearlash
