// What a drive does: whether it hunts, how large and fast, and how certain that is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/quantity.hpp"

namespace gearlash {

enum class Verdict : std::uint8_t {
  cannot_hunt,             ///< every motion comes to rest
  comes_to_rest,           ///< from every start that was searched, or all but a few undecided ones
  hunts,                   ///< no start led to rest; a stable cycle, or swings that repeat
  hunts_if_disturbed,      ///< rest is stable, and so is a limit cycle beside it
  hunts_irregularly,       ///< bounded motion that did not repeat
  grows_without_bound,     ///< no friction at all: the oscillation has no bound
  runs_away,               ///< no start stays bounded
  runs_away_if_disturbed,  ///< some starts do not stay bounded; others do, or are undecided
  forced,                  ///< a sine reference or load torque drives the oscillation
  undamped,                ///< neither friction nor backlash: any amplitude persists
  undecided
};

/// Whether a drive can move permanently, by itself or after a disturbance, or runs away: any
/// verdict but cannot_hunt, comes_to_rest, forced and undecided.
[[nodiscard]] bool hunts(Verdict verdict);

/// How certain a statement is, from the least to the most.
enum class Certainty : std::uint8_t {
  searched,  ///< found by a search, which may have missed something
  computed,  ///< decided by a formula in floating point; its rounding is not bounded
  enclosed,  ///< proved: interval arithmetic verifies the condition of a theorem
  theorem    ///< proved, by exact comparisons alone
};

enum class CycleKind : std::uint8_t {
  symmetric,   ///< mirrors itself every half period
  asymmetric,  ///< its mirror image is a second cycle
  subharmonic  ///< closes after several turns of the basic kind
};

/// By the multipliers, for all possible disturbances.
enum class Stability : std::uint8_t {
  stable,
  neutral,  ///< a multiplier is within 1e-6 of the unit circle: a family of cycles, or a fold
  unstable
};

/// Which engine answered.
enum class Engine : std::uint8_t { closed_form, general };

/// The balance of a period, J: what feeds the motion, and what is lost. Both are equal. The springs
/// of compliant faces and the weight of the load, linearised, give back what they take. Back-EMF
/// and the feedback of a tachometer are friction of the motor. So is, in closed form, all that the
/// controller feeds back of the motor's speed; elsewhere that is part of the motor's torque. In a
/// winding that lags back-EMF and tachometer act through the torque: the motor feeds less by them.
struct EnergyBalance {
  double motor = 0.0;  ///< J, fed by the motor: its torque's work on its shaft, braking negative
  double load_torque = 0.0;         ///< J, fed by the load torque, braking negative
  double motor_friction = 0.0;      ///< J, lost in the motor's viscous friction
  double load_friction = 0.0;       ///< J, lost in the load's viscous friction
  double motor_dry_friction = 0.0;  ///< J, lost in the motor's dry friction
  double load_dry_friction = 0.0;   ///< J, lost in the load's dry friction
  double impacts = 0.0;             ///< J, lost where rigid faces meet
  double contact_damping = 0.0;     ///< J, lost in compliant faces

  [[nodiscard]] double fed() const { return motor + load_torque; }  ///< J
  [[nodiscard]] double lost() const {                               ///< J
    return motor_friction + load_friction + motor_dry_friction + load_dry_friction + impacts +
           contact_damping;
  }
};

struct Cycle {
  CycleKind kind = CycleKind::symmetric;      ///< its symmetry
  Stability stability = Stability::stable;    ///< for all possible disturbances
  Certainty certainty = Certainty::computed;  ///< that it exists, and how stable it is
  double amplitude = 0.0;                     ///< rad, half the peak-to-peak of the load
  double motor_amplitude = 0.0;               ///< rad, of the motor, referred to the load's shaft
  double center = 0.0;        ///< rad, mean of the load's extremes, from the reference
  double error = 0.0;         ///< rad, largest |reference − load|
  double period = 0.0;        ///< s
  double multiplier = 0.0;    ///< Floquet's, the largest modulus over a period
  double residual = 0.0;      ///< mismatch of the state after one period, as a share
  double impact_speed = 0.0;  ///< rad/s, |ω_M − ω_L| before the hardest impact; 0 without impacts
  /// N m at the load's shaft, the largest between the faces while they are together, impacts aside.
  /// With dry friction not while both shafts stand, where it is not determined. Empty where the
  /// inertias are not known.
  std::optional<double> mesh_torque{};
  double engaged_time = 0.0;          ///< s of a period, faces together
  double separated_time = 0.0;        ///< s of a period, faces apart
  std::size_t events_per_period = 0;  ///< closed form: impacts
  bool has_mirror_image = false;      ///< the mirror image counts as this cycle
  bool settles = false;    ///< bounces settle before each separation, or contact is plastic
  std::size_t starts = 0;  ///< starts of a search that led here
  std::optional<EnergyBalance> energy{};  ///< J a period; empty where the inertias are not known
  /// Peak to peak of the measured position, in steps of its encoder, if it has one.
  std::optional<double> encoder_steps{};

  [[nodiscard]] double frequency() const { return 1.0 / period; }  ///< Hz
};

enum class RestKind : std::uint8_t {
  no_limit,     ///< the controller acts
  dead_band,    ///< the error is within the controller's dead band
  torque_limit  ///< the torque is at a limit
};

/// Equilibria of one kind.
struct RestPiece {
  RestKind kind = RestKind::no_limit;  ///< what acts there
  double side = 0.0;                   ///< of the limit: 1 forward, −1 backward; else 0
  Bounds load{};                       ///< rad, from the reference
  Bounds motor{};                      ///< rad, from the reference, at the load's shaft
};

/// How long starts of a search took to rest: until the load stayed within `band` of its final
/// position, by its law where it approaches that ever more slowly.
struct TimeToRest {
  double band = 0.0;     ///< rad: see Specification::band
  double longest = 0.0;  ///< s
  double median = 0.0;   ///< s; the mean of the two middle ones of an even number
};

/// Where it can rest. With dry friction, or in the gap, that is a set. Its ends are those where no
/// torque limit acts, if there are such.
struct Rest {
  Bounds load{};   ///< rad, from the reference
  Bounds motor{};  ///< rad, from the reference, at the load's shaft
  Bounds error{};  ///< rad, reference − load
  /// All equilibria that small disturbances do not leave, where they are computed.
  std::vector<RestPiece> pieces{};
  /// Computed: the ends of all equilibria, from the equations. Searched: those that starts led to.
  Certainty certainty = Certainty::searched;
  std::size_t starts = 0;  ///< that led here; 0 if none was needed
  /// For rest approached by ever smaller and slower swings: the largest ratio of two successive
  /// swings.
  std::optional<double> swing_ratio{};
  /// Of the starts: integral action against dry friction without stiction moves them ever less and
  /// ever later, or hardly ever (docs/explanation/drives.md).
  std::size_t creeping_starts = 0;
  /// Of the starts that come to rest; empty where one of them does not show it.
  std::optional<TimeToRest> time{};
};

/// Bounded motion that was not seen to repeat. An empty member was not measured.
struct IrregularMotion {
  double amplitude = 0.0;                   ///< rad, half the peak-to-peak of the load
  std::optional<double> motor_amplitude{};  ///< rad
  double center = 0.0;                      ///< rad, of the load, from the reference
  /// rad: |reference − load| is larger for 0.1 % of `watched`. In closed form the largest.
  double error = 0.0;
  bool is_motor_alone = false;  ///< the motor moves within the gap, the load hardly moves
  /// rad, half of extreme to extreme; of the motor if it moves alone.
  std::optional<double> mean_amplitude{};
  std::optional<double> amplitude_deviation{};  ///< rad, its standard deviation
  std::optional<double> mean_period{};          ///< s
  std::optional<double> period_deviation{};     ///< s, its standard deviation
  std::optional<double> mismatch{};  ///< share, least mean difference of swings a few swings apart
  std::optional<double> exponent{};  ///< 1/s, the largest Lyapunov exponent
  std::optional<double> watched{};   ///< s, duration of the measurement
  std::size_t starts = 0;            ///< of a search that led here
  std::optional<double> encoder_steps{};  ///< as of a cycle

  /// A sampled drive whose encoder reads the same steps again and again has no derivative by which
  /// Newton's method could close a cycle.
  [[nodiscard]] bool repeats() const;  ///< its swings do: to 0.1 %, after some of them, or, behind
                                       ///< an encoder, within a step of it at a steady pace
};

/// Hunting of at most this many encoder steps, peak to peak, may be quantization.
inline constexpr double steps_of_quantization = 4.0;

/// Where a start of a search comes to rest.
struct RestPlace {
  /// rad, from the reference; the limit, by its law, of a motion that never quite gets there; where
  /// it stood last, if it creeps by no known law.
  double load = 0.0;
  std::optional<double> motor{};  ///< rad, likewise; empty where the law is that of the load alone
  /// rad, by which these may be off: rounding, or the last step of an approach that goes on. Empty
  /// where the drive creeps by no known law.
  std::optional<double> uncertainty{};
};

/// Where a start of a search led.
struct StartOutcome {
  double load_position = 0.0;            ///< rad
  double load_speed = 0.0;               ///< rad/s
  double motor_position = 0.0;           ///< rad, at the load's shaft
  double motor_speed = 0.0;              ///< rad/s, at the load's shaft
  std::string end{};                     ///< "rest", "cycle", "irregular", "diverges", "undecided"
  std::optional<std::size_t> which{};    ///< index into the cycles, or into the irregular motions
  double watched = 0.0;                  ///< s
  std::string reason{};                  ///< why it is undecided
  std::optional<RestPlace> rest{};       ///< if it comes to rest
  std::optional<double> time_to_rest{};  ///< s, as of Rest::time
};

/// From what step on a drive at rest does something else. Both shafts are displaced together.
struct Threshold {
  std::string end{};       ///< "hunting" or "running away"
  double direction = 0.0;  ///< 1 forward, −1 backward; 0 where both are alike by symmetry
  double below = 0.0;      ///< rad, the largest step known that does not lead to it; 0: none
  double from = 0.0;       ///< rad, the smallest step known that does
};

struct RunAway {
  std::size_t starts = 0;  ///< from which motions do
};

/// The record of a search.
struct SearchRecord {
  /// s: the longest that a start is followed, unless hardly anything happens or it stands still.
  double watch_time = 0.0;
  double reference = 0.0;              ///< rad, from which the starts are displaced
  bool is_complete = true;             ///< not stopped
  std::size_t borders = 0;             ///< searched between starts with different outcomes
  std::vector<StartOutcome> starts{};  ///< in the order in which they were followed

  [[nodiscard]] std::size_t count(const std::string& end) const;
};

/// Proved bounds.
struct ProvedBounds {
  Bounds growth_at_rest{};  ///< of Answer::growth_at_rest
  bool has_cycle = false;   ///< if so, the following members are its bounds
  Bounds amplitude{};       ///< rad
  Bounds period{};          ///< s
  Bounds multiplier{};      ///< of the Floquet multiplier
};

/// The servo of 1960 that a drive is equivalent to.
struct NormalFormNumbers {
  double damping = 0.0;               ///< ζ
  double inertia_ratio = 0.0;         ///< J_L/J_M
  double friction_ratio = 0.0;        ///< F_L/(F_M + F_L)
  double backlash = 0.0;              ///< rad
  double restitution = 0.0;           ///< 0 … 1
  double natural_frequency = 1.0;     ///< rad/s
  std::optional<double> stiffness{};  ///< N m/rad; unknown for a normal form with a frequency
};

/// What one source contributes to a ceiling.
struct CeilingTerm {
  std::string source{};  ///< "gap", "motor friction", "load friction", "encoder", "speed encoder",
                         ///< "load torque", "gap speed"
  /// Half the gap, rad; half an encoder step, rad; a torque, N m; the speed of the motor less the
  /// load, rad/s, where the controller reads it unfiltered.
  double size = 0.0;
  double load = 0.0;               ///< rad
  double motor = 0.0;              ///< rad
  std::optional<double> effort{};  ///< N m
};

/// Starts of which no motion ever meets the torque limit: with the controller's numbers those of
/// the motion with the gap closed, both shafts displaced by x from it and faster than it by the
/// same speed v, with |x|/position + |v|/speed ≤ 1, anywhere in the gap. x and v are means of both
/// shafts by their inertias. So a step of the reference up to `position` never meets it either, if
/// the controller knows reference and position by their difference alone and there is no gravity. A
/// computer starts at a tick. Signals that end have ended at the start.
struct SafeStarts {
  double position = 0.0;  ///< rad
  double speed = 0.0;     ///< rad/s
};

/// A proved bound of every motion in the end, hunting of any kind included: how far it can be from
/// the motion of the loop with the gap closed, without dry friction and encoder, under the same
/// reference and load torque; a sine of the load torque is not part of that motion but a term. Each
/// bound is the sum of its terms (docs/explanation/ceiling.md).
struct Ceiling {
  std::optional<double> load{};   ///< rad; empty if there is none
  std::optional<double> motor{};  ///< rad, at the load's shaft
  /// N m of the torque that the controller requests of the motor, at the load's shaft, from that of
  /// the motion with the gap closed; empty if there is none.
  std::optional<double> effort{};
  std::string reason{};         ///< why there is none
  std::string effort_reason{};  ///< why there is none for the effort
  /// The motor's torque is limited, or the speed that a cascade asks for, and motion that reaches
  /// the limit ever again is not bounded.
  bool is_below_limit = false;
  /// Whether a motion can stay off the limit: effort and holding torque together are below it.
  /// Empty if the effort has no ceiling, there is no limit, or the holding torque is not known: the
  /// signals move, or along a ramp the controller does not know reference and position by their
  /// difference alone.
  std::optional<bool> meets_limit{};
  /// Starts that never meet the torque limit. Empty if none is proved.
  std::optional<SafeStarts> safe_starts{};
  /// N m: no motion in the end has a larger mean of the mesh torque's size; like the ceiling not of
  /// motion that reaches a torque or current limit again and again (is_below_limit). Rigid faces, a
  /// continuous linear controller, constant signals, no dry friction or encoder; empty for others.
  std::optional<double> mesh_torque{};
  std::vector<CeilingTerm> terms{};  ///< what each source contributes
  /// The term "gap speed" is bounded by what brakes it, not by the width of the gap.
  bool is_gap_speed_braked = false;

  /// The largest backlash, rad, with which the ceiling of the load is at most `amplitude`, rad. The
  /// term of the gap is proportional to it; where the gap's speed is a term the result is a lower
  /// bound of the largest. Empty if the other terms exceed it or there is no ceiling. `backlash`:
  /// the drive's own.
  [[nodiscard]] std::optional<double> widest_backlash(double amplitude, double backlash) const;
};

/// The linear loop: without the gap, dry friction, limits, steps of encoders and a dead band. A
/// number is empty where there is none: of a loop that is not stable, of a response that never
/// falls by 3 dB, of a gain that never crosses 1.
struct LinearLoop {
  bool is_stable = false;  ///< proved by interval bounds
  /// Hz: the first frequency at which the load follows the reference by 3 dB less than at frequency
  /// 0.
  std::optional<double> bandwidth{};
  /// rad: the least, of all frequencies at which the loop has the gain 1, by which it may turn.
  std::optional<double> phase_margin{};
  std::optional<double> crossover{};  ///< Hz: the frequency of this margin
  /// The factor, next to 1 as a ratio, by which the loop's gain may grow or must fall until the
  /// loop is at the border of stability. Below 1 it is one by which the gain may fall.
  std::optional<double> gain_margin{};
  /// Hz: the frequency of this margin, perhaps 0 or half the sampling frequency.
  std::optional<double> phase_crossover{};
  /// rad: the largest |reference − load| in the end of a reference that moves, a ramp or a sine,
  /// without droop under constant torques; at the ticks of a sampled controller. Empty of one that
  /// stands still, and where it grows without bound.
  std::optional<double> lag{};
};

/// The load's response to a step of the reference, from rest at 0 with the faces in contact on the
/// side that the step pushes. The drive's own reference is ignored. A number is empty where it did
/// not occur within the simulated time.
struct StepResponse {
  double step = 0.0;                  ///< rad
  double until = 0.0;                 ///< s, simulated
  std::optional<double> rise_time{};  ///< s, first 10 % to first 90 %
  std::optional<double> overshoot{};  ///< as a share of the step; empty unless `is_whole`
  /// s: the last time outside `band`. Empty unless it stays there for the whole last fifth.
  std::optional<double> settling_time{};
  double band = 0.0;         ///< rad, about the reference: see Specification::band
  double final_error = 0.0;  ///< rad, reference less load, mean of the last fifth's extremes
  double ripple = 0.0;       ///< rad, half the distance of these extremes
  bool is_whole = false;     ///< the motion could be followed to its end
};

/// Something a reader should know. `code` is for programs.
struct Note {
  std::string code{};  ///< one word
  std::string text{};  ///< a sentence or more
};

/// What may be taken away from a drive to find what its motion in the end is due to.
enum class Cause : std::uint8_t {
  gap,
  dry_friction,     ///< of both shafts
  integral_action,  ///< of the controller
  delay,            ///< of a sampled controller
  encoder,          ///< its steps
  load_torque       ///< and gravity
};

/// The same drive without one of them.
struct Without {
  Cause cause = Cause::gap;              ///< what is taken away
  Verdict verdict = Verdict::undecided;  ///< of the starts that told of the drive's own
  std::optional<double> error{};         ///< rad, Quantity::error of it; empty if unknown
};

enum class Fulfilment : std::uint8_t { met, not_met, not_known };

/// Whether a drive keeps its Specification::error.
struct SpecificationAnswer {
  double permitted = 0.0;                           ///< rad
  Fulfilment small = Fulfilment::not_known;         ///< where small disturbances lead
  Fulfilment if_disturbed = Fulfilment::not_known;  ///< wherever a start leads
  std::optional<double>
      excess{};  ///< rad, by which Quantity::error exceeds it; empty if it is kept
  /// Without which the error would be smallest; empty if it is kept, or no cause is known.
  std::optional<Cause> cause{};
};

struct Answer {
  Verdict verdict = Verdict::undecided;            ///< what the motion ends in
  Certainty certainty = Certainty::searched;       ///< of the verdict
  Certainty completeness = Certainty::searched;    ///< of the list of cycles
  Engine engine = Engine::general;                 ///< which answered
  std::optional<NormalFormNumbers> normal_form{};  ///< empty if the drive has none
  std::optional<double> growth_at_rest{};          ///< of a small motion in the gap, per half cycle
  std::optional<ProvedBounds> bounds{};            ///< if wanted, in closed form
  std::optional<Ceiling> ceiling{};                ///< if wanted
  std::optional<LinearLoop> loop{};                ///< if wanted; a relay has none
  std::optional<StepResponse> step{};              ///< if wanted
  bool is_dissipative = false;                     ///< no restitution can make it hunt
  bool rests_engaged = false;   ///< large motions may end at rest, with the faces together
  bool neutral_swings = false;  ///< some cycles could not be separated from their neighbors
  std::vector<Cycle> cycles{};  ///< by falling amplitude; from a search, stable ones first
  std::optional<Rest> rest{};   ///< empty if it is not known to rest
  /// On which no cycle was closed, by falling amplitude; those of the motor alone come last.
  std::vector<IrregularMotion> irregular{};
  /// Whether hunting of at most `steps_of_quantization` is quantization: without the encoder's
  /// steps the starts that hunt, of which up to three are followed, come to rest. Empty if not
  /// wanted, not decided, or for other motion.
  std::optional<bool> is_quantization{};
  /// Of a search beside which the drive also rests, or stays bounded: on the grid of its steps, and
  /// then bisected. A step between those of the grid may lead elsewhere.
  std::vector<Threshold> thresholds{};
  std::vector<Without> without{};                      ///< if wanted: each cause that the drive has
  std::optional<SpecificationAnswer> specification{};  ///< if the drive has one
  std::optional<SearchRecord> search{};                ///< empty in closed form
  std::vector<Note> notes{};                           ///< what a reader should know

  /// The cycle that is seen in practice: the largest that is not unstable, or nullptr.
  [[nodiscard]] const Cycle* largest_stable() const noexcept;

  /// In SI. Empty if it does not exist or is not known. Amplitudes are 0 if the drive comes to
  /// rest. A choice gives its number.
  [[nodiscard]] std::optional<double> value(Quantity quantity) const;
  /// value() of each that is a number, by its name.
  [[nodiscard]] std::vector<std::pair<std::string_view, std::optional<double>>> values()
      const;  ///< of every quantity, by its name
  [[nodiscard]] std::optional<RunAway> runaway()
      const;  ///< motions that run away; empty where none was found
};

/// The enumerator's name with spaces: "cannot hunt", "hunts if disturbed", …
[[nodiscard]] const char* name_of(Verdict verdict);
/// "searched", "computed", "enclosed", "theorem".
[[nodiscard]] const char* name_of(Certainty certainty);
/// "symmetric", "asymmetric", "subharmonic".
[[nodiscard]] const char* name_of(CycleKind kind);
/// "stable", "neutral", "unstable".
[[nodiscard]] const char* name_of(Stability stability);
/// "no limit", "dead band", "torque limit".
[[nodiscard]] const char* name_of(RestKind kind);
/// "met", "not met", "not known".
[[nodiscard]] const char* name_of(Fulfilment fulfilment);
/// "gap", "dry friction", "integral action", "delay", "encoder", "load torque".
[[nodiscard]] const char* name_of(Cause cause);
/// "closed form", "general".
[[nodiscard]] const char* name_of(Engine engine);

/// Whether the verdict is known. One of hunting is not if the search found no amplitude.
[[nodiscard]] bool is_decided(const Answer& answer);

}  // namespace gearlash
