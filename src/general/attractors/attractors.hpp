// Finds where a drive's motions end: cycles, rest, or motion that does not repeat.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/extent.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/progress.hpp"
#include "general/assemble/drive_system.hpp"
#include "general/attractors/search_tolerances.hpp"
#include "hybrid/periodic_orbit.hpp"

namespace gearlash::drive {

/// The coordinates of the search. Positions are relative to the reference in all of them; for a
/// sine, to its mean.
enum class Coordinates {
  fixed,
  co_moving,  ///< with a reference that is a ramp
  in_place    ///< a ramp that the drive's numbers cannot be carried along with (encoders read by a
              ///< sampled controller, a controller that does not act on the error): motion is
              ///< measured, cycles are not closed and rest is motion of no amplitude
};

using gearlash::Stability;

struct FoundCycle {
  hybrid::PeriodicOrbit orbit;  ///< of AttractorSearch::system; with residual and all multipliers
  Stability stability = Stability::unstable;
  double amplitude = 0.0;  ///< rad, half the peak-to-peak of the load; 0 where the motor hunts
                           ///< within the gap and the load stands
  double motor_amplitude = 0.0;  ///< rad, of the motor
  double center = 0.0;           ///< rad, mean of the load's extremes, from the reference
  double error = 0.0;            ///< rad, largest |reference − load|
  /// rad, of all that count as this one: mirror images, and neutral cycles of one period, which are
  /// a family.
  Extent centers;
  Extent amplitudes;          ///< rad, likewise
  double frequency = 0.0;     ///< rad/s, 2π/period
  double impact_speed = 0.0;  ///< rad/s, |ω_M − ω_L| at the hardest impact; 0 without impacts
  double mesh_torque = 0.0;   ///< N m, the largest between the faces while they are together
  EnergyBalance energy{};     ///< J, over a period
  double multiplier = 0.0;    ///< the largest modulus of the orbit's
  double mismatch = 0.0;      ///< rad, by which a shaft misses its place after a period
  /// After half a period the drive is its mirror image about the reference.
  bool is_symmetric = false;
  /// Not symmetric, and its mirror image was found too. Both count as this one.
  bool has_mirror_image = false;
  std::size_t starts = 0;  ///< that led here; 0 if Newton's method alone found it

  double period() const { return orbit.period; }
};

/// All rest found. With dry friction, or in the gap, it is a set.
struct RestFound {
  Extent load;   ///< rad, from the reference, over the starts that led here
  Extent motor;  ///< rad
  Extent error;  ///< rad, reference − load
  std::size_t starts = 0;
  std::size_t creeping_starts = 0;  ///< that move ever later, or hardly ever
  /// Rest approached by ever smaller and longer swings across the gap is never reached. Their ratio
  /// identifies it, of which this is the largest. NaN if all came to rest.
  double swing_ratio = std::numeric_limits<double>::quiet_NaN();
};

/// Bounded motion that was not seen to close, measured over its last part: a cycle that is locked
/// to nothing, quasi-periodic motion, chaos, or a slow transient.
struct IrregularFound {
  double amplitude = 0.0;        ///< rad, half the peak-to-peak of the load
  double motor_amplitude = 0.0;  ///< rad, of the motor
  double center = 0.0;           ///< rad, of the load's extremes, from the reference
  double error = 0.0;            ///< rad: |reference − load| is larger for 0.1 % of `watched`
  double mean_center = 0.0;      ///< rad, of the middles of its swings: known better
  /// Within the gap, while the load hardly moves. Swings and periods are then the motor's.
  bool is_motor_alone = false;
  double period = 0.0;  ///< s, mean, from one passing of the center upwards to the next
  double period_deviation = 0.0;
  double half_swing = 0.0;  ///< rad, mean, half of extreme to extreme
  double half_swing_deviation = 0.0;
  /// The least mean difference of swings and those some swings later, as a share: 0 if they repeat.
  double mismatch = 0.0;
  /// 1/s, mean rate at which neighbours part (largest Lyapunov exponent), by the variational
  /// equations with saltation: above 0 for chaos, about 0 for quasi-periodic motion. Empty behind
  /// an encoder, whose steps have no derivative.
  std::optional<double> exponent;
  /// 1/s, the fastest decay of its swings that the measurement does not exclude at 95 %.
  double fastest_decay = 0.0;
  double watched = 0.0;    ///< s, duration of the measurement
  std::size_t swings = 0;  ///< from extreme to extreme, measured
  std::size_t starts = 0;
};

enum class MotionEnd { rest, cycle, irregular, diverges, undecided };

/// Whether the motion goes on and stays bounded.
constexpr bool swings(MotionEnd end) {
  return end == MotionEnd::cycle || end == MotionEnd::irregular;
}

/// Where a start led.
struct Outcome {
  ShaftStates start;
  MotionEnd end = MotionEnd::undecided;
  std::size_t which = 0;               ///< index into the cycles, or into the irregular motions
  double watched = 0.0;                ///< s
  std::string reason;                  ///< why it is undecided
  std::optional<RestPlace> rest;       ///< if it rests
  std::optional<double> time_to_rest;  ///< s, if it rests; see AttractorOptions::band
};

/// Between two starts with different outcomes, motion was sought that goes to neither.
struct Edge {
  std::size_t first = 0;   ///< of the outcomes
  std::size_t second = 0;  ///< of the outcomes
  /// Index of the unstable cycle that separates them. Empty if none was closed: a grazing, a
  /// sticking or an irregular motion may form the border.
  std::optional<std::size_t> cycle;
};

struct AttractorSearch {
  double band = 0.0;  ///< rad, of times to rest
  Coordinates coordinates = Coordinates::fixed;
  hybrid::HybridSystem system;     ///< with settled signals, positions from the reference
  std::vector<FoundCycle> cycles;  ///< stable ones first, by falling amplitude
  std::optional<RestFound> rest;
  std::vector<IrregularFound> irregular;  ///< by falling amplitude; of the motor alone last
  std::vector<Outcome> outcomes;          ///< of every start, in order
  std::vector<Edge> edges;
  std::vector<Threshold> thresholds;
  /// s, of the linear loop with faces together: 2π/|slowest eigenvalue that oscillates|, or the
  /// slowest of all if none does. At least a sine's period and ten samples.
  double swing_time = 0.0;
  double settling_time = 0.0;  ///< s, of that loop: 1/slowest decay
  double watch_time = 0.0;     ///< s, the longest that a start is watched if something happens
  bool is_complete = true;     ///< not stopped
  /// A start rests where its mode ends, with no dry friction, until a small disturbance makes it
  /// hunt: such a start counts as hunting.
  bool rests_until_disturbed = false;

  std::size_t count(MotionEnd end) const;
  /// Whether a start led to such motion.
  bool swings() const { return count(MotionEnd::cycle) + count(MotionEnd::irregular) > 0; }
};

using IsEnough = std::function<bool(const AttractorSearch&)>;

struct AttractorOptions {
  /// Replaces the search's own starts, which are these: at rest at 0.01 to 100 times the backlash,
  /// on either face, and passing the reference at some speed. (Encoder steps, and the positions
  /// equivalent to friction, load torque, torque limit and a sine reference, widen that range.)
  /// Absolute positions.
  std::vector<ShaftStates> starts{};
  /// Asked after each start. Where it is true no further start is watched, and the search is as
  /// complete as these make it.
  IsEnough is_enough{};
  /// Asked before each start. Where it is true a motion in which hardly anything happens is watched
  /// for no longer than others (SearchBudget::patience), and may be undecided for that.
  IsEnough may_hurry{};
  /// The search of a drive that differs slightly from this one. Those of its cycles that Newton's
  /// method finds again are known from the beginning.
  const AttractorSearch* nearby = nullptr;
  double swing_times = 200.0;         ///< that a start is watched; and the budget's settling
                                      ///< times, but twice as long at most
  std::size_t most_events = 100'000;  ///< of a start; ten times as many ticks of a clock
  std::size_t most_edges = 3;         ///< sought between starts with different outcomes; 0: none,
                                      ///< and no thresholds
  hybrid::ShootingOptions shooting{.most_events = 2000};
  /// rad, > 0: a start has come to rest when the load stays as near as this to its final position.
  double band = 1e-3;
  SearchTolerances tolerances{};
  SearchBudget budget{};
  StartTolerances chosen_starts{};  ///< used if `starts` is empty
};

/// Watches each start until it comes to rest, runs away, or Newton's method (closing_orbit())
/// closes a cycle that it is on. Unstable cycles passed by are kept. Between starts with different
/// outcomes bisection finds motion on the border, and Newton's method the unstable cycle near which
/// it hovers. Signals are those of settled(). The search cannot be complete; the result lists what
/// was searched. Repeated runs give the same result. A stopped search reports it (is_complete).
/// Throws InvalidInput, also for a load torque that ends as a ramp.
AttractorSearch find_attractors(const ReducedDrive& drive, const AttractorOptions& options = {},
                                Progress& progress = no_progress());

/// What a drive ends in that differs slightly from one that was searched. Newton's method finds
/// each cycle again; its first step from the cycle's old start is the prediction by the cycle's
/// sensitivity, −(M − 1)⁻¹ ∂F/∂p Δp. Of the starts that led to one thing the first and the middle
/// one are watched, the latter farthest from those that led elsewhere; of those that led to rest
/// the first and the last. Empty if one of the cycles is not found again with the same stability,
/// symmetry and number of events, or these starts do not end alike: in rest, cycles, irregular
/// motion or running away, all that there were and no other. Something new may have appeared then,
/// and a search must find it, unless what was found `suffices`; where all these starts are
/// undecided the first usual ones are asked for that too. Empty also where `known` was stopped, or
/// has undecided starts beside some that rest. Of the options, starts and edges do not count.
/// Throws InvalidInput.
std::optional<AttractorSearch> follow_attractors(const ReducedDrive& drive,
                                                 const AttractorSearch& known,
                                                 Progress& progress = no_progress(),
                                                 const IsEnough& suffices = {},
                                                 const AttractorOptions& options = {});

/// Those of the cycles of `known` that Newton's method finds again in a drive that differs
/// slightly, stable or not, with the system that their orbits are of. Nothing is watched: the
/// result has the starts of `known`, undecided. Throws InvalidInput.
AttractorSearch follow_cycles(const ReducedDrive& drive, const AttractorSearch& known);

}  // namespace gearlash::drive
