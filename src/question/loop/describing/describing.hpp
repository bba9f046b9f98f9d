// What describing functions predict for a drive, one nonlinearity at a time, for comparison with
// the exact cycles.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "gearlash/answer.hpp"
#include "model/drive.hpp"
#include "question/loop/describing/harmonic_balance.hpp"

namespace gearlash::drive {

/// The nonlinearity that is described. All others of the drive are neglected. name_of() is by
/// order.
enum class DescribedPart {
  gap_load_held,      ///< from motor to load position; friction holds the load in the gap
  gap_load_coasting,  ///< likewise; the load keeps its speed in the gap
  elastic_gap,        ///< from motor minus load position to the mesh torque: a dead zone
  torque_limit,       ///< from the requested to the delivered torque: a saturation
  coulomb_friction,   ///< from the speed to the torque against it: a relay
  dead_band,          ///< from the error to what the controller receives: a dead zone
  relay               ///< from the error or the speed to the torque, per level: a relay
};

/// Assumptions, besides that the nonlinearity's input is a sine about 0. name_of() is by
/// order.
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
  signals_left_out,
  error_shape_left_out,
  falling_friction_left_out
};

/// Errors of a prediction: predicted over exact value, minus 1.
struct PredictionError {
  std::size_t exact = 0;  ///< index into exact_motions(): the cycles, then the irregular motions
  double amplitude = std::numeric_limits<double>::quiet_NaN();
  double motor_amplitude = std::numeric_limits<double>::quiet_NaN();
  double period = std::numeric_limits<double>::quiet_NaN();
  double frequency = std::numeric_limits<double>::quiet_NaN();
};

/// Angles in rad, times in s (or whatever the drive is given in).
struct DescribedMotion {
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< of the load, half peak-to-peak
  double motor_amplitude = std::numeric_limits<double>::quiet_NaN();  ///< of the motor
  PredictedCycle balance{};  ///< the input's amplitude, the frequency, the period, stability
  std::optional<PredictionError> error{};  ///< beside the exact motion that it predicts
};

struct DescribingAnalysis {
  DescribedPart part = DescribedPart::gap_load_held;
  Nonlinearity nonlinearity{};
  /// L(s): the transfer from the nonlinearity's output to its input is −L, so cycles are where
  /// 1 + N L = 0. The numerator is 0 if the nonlinearity is outside the loop.
  TransferFunction loop{};
  TransferFunction input_per_motor{};  ///< the nonlinearity's input, by the motor's position
  /// The load's position by the motor's; empty if the nonlinearity lies between them.
  std::optional<TransferFunction> load_per_motor{};
  std::vector<Assumption> assumptions{};
  std::vector<DescribedMotion> cycles{};  ///< by increasing amplitude of the nonlinearity's input
  std::vector<Bounds> unresolved{};       ///< frequencies, as in HarmonicBalance
};

/// The classical analyses that apply to the drive. With P(s) and V(s) the feedback torque from the
/// sensed position and speed, J_M, F_M and J_L, F_L inertia and viscous friction, D = J s² + F s
/// for either shaft and for both, p and q the load's shares of the sensed position and speed,
///   a = p P + q s V               the feedback from the load,
///   c = (1 − p) P + (1 − q) s V   that from the motor:
///
/// gap            θ_L = N θ_M; the motor drives all inertia and friction at all times, as in
///                textbooks:  L = a/(D + c).
///                With sensors on the motor alone, a = 0, the gap is outside that loop and causes
///                no cycle in it. The analysis then describes the load's first harmonic, which
///                acts back on the motor:  L = D_L/(D_M + c).
/// elastic gap    for compliant contact, stiffness k and damping d: torque N δ (1 + s d/k) with
///                δ = θ_M − θ_L, N that of a dead zone:
///                L = (1 + s d/k)(D_M + D_L + a + c)/((D_M + c) D_L).
/// torque limit   both shafts as one:  L = (a + c)/D − W, W(s) the anti-windup's transfer
///                from the delivered to the requested torque.
/// Coulomb        friction of both shafts together, as one:  L = s/(D + a + c). A breakaway torque
///                above Coulomb friction has no effect, because a sine is never at rest. The method
///                cannot predict hunting from stiction.
/// dead band      of the kind that gives the excess, both shafts as one:  L = P/(D + s V).
/// relay          of two levels, both shafts as one:  L = level/D, times s for a relay of the
/// speed.
///                The other parts of such a drive take its controller as linear and are left out.
///
/// A sampled controller is converted to continuous time by z = (1 + sT/2)/(1 − sT/2), which gives
/// the original controller if it was discretized by Tustin's rule. Of a controller given by its
/// G(z), a coefficient counts as 0 below 2⁻⁵⁰ of the sum of the sizes of the terms that cancel in
/// it: that is rounding of the numbers given. Nothing else is rounded before the end. The hold
/// counts as a delay of half a period, to which the computational delay is added. The delay is kept
/// if it is a factor of L. Otherwise a rational function of order 4 in numerator and denominator
/// replaces it.
///
/// Linear parts are formed in exact arithmetic. All cycles are found from 1e-9 to 1e6 times the
/// frequencies of poles, zeros and crossover (harmonic_balance()).
/// Throws InvalidInput.
/// Sources: Gelb and Vander Velde (1968), chapters 2 and 3; Nordin and Gutman, Automatica 38 (2002)
/// 1633, for the dead zone; Armstrong-Hélouvry and Amin, Automatica 32 (1996) 679, for stiction.
std::vector<DescribingAnalysis> describing_analyses(const ReducedDrive& drive);

/// Whether the nonlinearity is within a loop.
bool is_in_loop(const DescribingAnalysis& analysis);

/// "gap, load held by friction", …
const char* name_of(DescribedPart part);
/// A clause: "the motor drives all inertia and viscous friction at all times", …
const char* name_of(Assumption assumption);

// ---- beside the exact cycle ---------------------------------------------------------------------

/// A motion that an answer has.
struct ExactMotion {
  double amplitude = 0.0;        ///< rad, of the load
  double motor_amplitude = 0.0;  ///< rad; NaN if it was not measured
  double period = 0.0;           ///< s; NaN if it was not measured
  bool is_stable = true;
};

/// The answer's cycles, then its irregular motions, in its order; none of a drive that a sine
/// drives, whose motion is not predicted.
std::vector<ExactMotion> exact_motions(const Answer& answer);

/// A cycle predicted for a part other than the gap counts as the whole drive's cycle if amplitude
/// and period agree within this factor. Otherwise it is another motion and no error is reported.
inline constexpr double same_cycle_factor = 2.0;

/// Compares with the exact motion that is stable or not, as the predicted one is, and among these
/// has the least |ln amplitude ratio| + |ln period ratio|. Empty if the part can have caused none
/// of them.
std::optional<PredictionError> prediction_error(DescribedPart part,
                                                const DescribedMotion& predicted,
                                                const std::vector<ExactMotion>& exact);

/// prediction_error() of each predicted cycle, beside the motions of the answer.
void set_errors(std::vector<DescribingAnalysis>& analyses, const Answer& answer);

/// Whether a predicted cycle is too small to be seen: below `unseen_share` of the backlash.
inline constexpr double unseen_share = 1e-4;
bool is_unseen(const DescribedMotion& predicted, double backlash);

/// The amplitude that the nonlinearity's input would have if the exact motion of the motor were a
/// sine. For a gap, this is the motor's exact amplitude.
double input_amplitude(const DescribingAnalysis& analysis, const ExactMotion& exact);

}  // namespace gearlash::drive
