// What describing functions predict of a drive, one nonlinearity at a time, to be put beside the
// exact cycles.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "analysis/describing/harmonic_balance.hpp"
#include "gearlash/answer.hpp"
#include "model/drive.hpp"

namespace gearlash::drive {

/// The nonlinearity that is described; all others of the drive are then left out.
enum class DescribedPart {
  gap_load_held,      ///< from motor to load position; friction holds the load in the gap
  gap_load_coasting,  ///< likewise; the load keeps its speed in the gap
  elastic_gap,        ///< from motor less load position to the mesh torque: a dead zone
  torque_limit,       ///< from the torque asked for to the torque given: a saturation
  coulomb_friction    ///< from the speed to the torque against it: a relay
};

/// What is taken for granted besides that the nonlinearity's input is a sine about 0.
enum class Assumption {
  motor_carries_all,
  load_reacts,
  gap_left_out,
  torque_limit_left_out,
  coulomb_left_out,
  breakaway_left_out,
  sampling_as_delay,
  delay_as_rational,
  encoder_left_out,
  signals_left_out
};

/// Angles in rad, times in s (or whatever the drive is given in).
struct DescribedMotion {
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< of the load, half peak-to-peak
  double motor_amplitude = std::numeric_limits<double>::quiet_NaN();
  PredictedCycle balance{};  ///< the input's amplitude, the frequency, the period, stability
};

struct DescribingAnalysis {
  DescribedPart part = DescribedPart::gap_load_held;
  Nonlinearity nonlinearity{};
  /// L(s), what the nonlinearity's output makes of its input: −L; cycles are where 1 + N L = 0. The
  /// numerator is 0 where the nonlinearity is outside of the loop.
  TransferFunction loop{};
  TransferFunction input_per_motor{};  ///< the nonlinearity's input, by the motor's position
  /// The load's position by the motor's; nothing where the nonlinearity lies between them.
  std::optional<TransferFunction> load_per_motor{};
  std::vector<Assumption> assumptions{};
  std::vector<DescribedMotion> cycles{};  ///< by increasing amplitude of the nonlinearity's input
  std::vector<Bounds> unresolved{};       ///< frequencies, as in HarmonicBalance
};

/// The classical analyses that apply to the drive. With P(s) and V(s) the torque taken back by the
/// position and by the speed sensed, J_M, F_M and J_L, F_L inertia and viscous friction,
/// D = J s² + F s of either shaft and of both, p and q the load's shares of position and speed
/// sensed,
///   a = p P + q s V   what is fed back from the load,
///   c = (1 − p) P + (1 − q) s V   from the motor:
///
/// gap            θ_L = N θ_M; the motor drives all inertia and friction at all times, as textbooks
///                have it:  L = a/(D + c).
///                Sensors on the motor alone, a = 0: the gap is then outside of that loop, in which
///                no cycle arises from it. What is described is the load's first harmonic as it
///                acts back on the motor:  L = D_L/(D_M + c).
/// elastic gap    for faces that give, stiffness k and damping d: torque N δ (1 + s d/k) of
///                δ = θ_M − θ_L, N that of a dead zone:
///                L = (1 + s d/k)(D_M + D_L + a + c)/((D_M + c) D_L).
/// torque limit   both shafts as one:  L = (a + c)/D − W, W(s) what the anti-windup adds to the
///                torque asked for by the torque given.
/// Coulomb        friction of both shafts together, as one:  L = s/(D + a + c). A breakaway torque
///                above Coulomb's has no share in it, for a sine rests at no time: of hunting that
///                comes of stiction the method knows nothing.
///
/// A controller from sample to sample is taken as one in continuous time by z = (1 + sT/2)/(1 −
/// sT/2), which is that it was made from, if by Tustin; the hold is a delay by half a period, to
/// which the computational one is added. The delay stays one where it is a factor of L; else it is
/// replaced by a rational function of order 4 in numerator and denominator.
///
/// Linear parts are formed in exact arithmetic. All cycles are found from 1e-9 to 1e6 times the
/// frequencies of poles, zeros and crossover (harmonic_balance()).
/// Throws InvalidInput.
/// Sources: Gelb and Vander Velde (1968), chapters 2 and 3; Nordin and Gutman, Automatica 38 (2002)
/// 1633, for the dead zone; Armstrong-Hélouvry and Amin, Automatica 32 (1996) 679, for stiction.
std::vector<DescribingAnalysis> describing_analyses(const ReducedDrive& drive);

/// Whether the nonlinearity is within a loop at all.
bool is_in_loop(const DescribingAnalysis& analysis);

/// "gap, load held by friction", …
const char* name_of(DescribedPart part);
/// A clause: "the motor drives all inertia and viscous friction at all times", …
const char* description_of(Assumption assumption);

// ---- beside the exact cycle ---------------------------------------------------------------------

/// Predicted by exact, less 1.
struct PredictionError {
  std::size_t exact = 0;  ///< which of the exact cycles
  double amplitude = std::numeric_limits<double>::quiet_NaN();
  double motor_amplitude = std::numeric_limits<double>::quiet_NaN();
  double period = std::numeric_limits<double>::quiet_NaN();
  double frequency = std::numeric_limits<double>::quiet_NaN();
};

/// A cycle predicted of a part other than the gap is that of the whole drive where amplitude and
/// period are within this factor; else it is another motion, and there is no error to report.
inline constexpr double same_cycle_factor = 2.0;

/// Against the exact cycle that is stable where the predicted one is and not where it is not, and
/// among those the one with the least |ln amplitude ratio| + |ln period ratio|. Nothing if there is
/// none that the part could be the cause of.
std::optional<PredictionError> prediction_error(DescribedPart part,
                                                const DescribedMotion& predicted,
                                                const std::vector<Cycle>& exact);

/// Whether a predicted cycle is too small to be seen: below `unseen_share` of the backlash.
inline constexpr double unseen_share = 1e-4;
bool is_unseen(const DescribedMotion& predicted, double backlash);

/// The amplitude that the nonlinearity's input would have if the exact motion of the motor were a
/// sine: that of the exact motor for a gap.
double input_amplitude(const DescribingAnalysis& analysis, const Cycle& exact);

}  // namespace gearlash::drive
