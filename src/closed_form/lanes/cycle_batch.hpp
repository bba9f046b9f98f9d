// The limit cycles of many servos at once: several side by side in the lanes of a vector unit.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "closed_form/limit_cycle.hpp"
#include "gearlash/quantity.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Instructions for which the kernel is compiled; the widest that the processor and the operating
/// system permit is chosen when the program runs.
enum class VectorUnit {
  baseline,  ///< what every processor of the kind has: 2 lanes of SSE2, or of NEON
  avx2,      ///< 4 lanes
  avx512     ///< 8 lanes (F, CD, DQ, BW)
};

/// Those of this machine, from the narrowest to the widest; never empty.
std::vector<VectorUnit> available_vector_units();
VectorUnit widest_vector_unit();

/// "baseline", "avx2", "avx512".
const char* name_of(VectorUnit unit);

/// What is known of a servo in closed form, beside its verdict.
inline constexpr std::array closed_form_quantities = {Quantity::growth_at_rest,
                                                      Quantity::amplitude,
                                                      Quantity::motor_amplitude,
                                                      Quantity::period,
                                                      Quantity::frequency,
                                                      Quantity::multiplier,
                                                      Quantity::impact_speed,
                                                      Quantity::engaged_time,
                                                      Quantity::separated_time,
                                                      Quantity::motor_friction_loss,
                                                      Quantity::load_friction_loss,
                                                      Quantity::impact_loss,
                                                      Quantity::residual};

/// Where the answers are written: as many rows as there are servos, in every column that is given;
/// those left out are empty. Numbers are those of the normal form, in SI (ω_n = 1 rad/s, K =
/// 1 N m/rad). A servo that cannot hunt, or whose cycle is not known, has NaN but in the growth at
/// rest; what is not among closed_form_quantities stays as it is.
struct CycleColumns {
  std::span<Verdict> verdict{};
  std::array<std::span<double>, quantity_count> numbers{};  ///< by Quantity

  std::span<double>& operator[](Quantity quantity) {
    return numbers[static_cast<std::size_t>(quantity)];
  }
  const std::span<double>& operator[](Quantity quantity) const {
    return numbers[static_cast<std::size_t>(quantity)];
  }
};

/// How the servos were solved.
struct BatchCount {
  std::size_t side_by_side = 0;  ///< in lanes
  std::size_t one_by_one = 0;    ///< by analyse_limit_cycles()
};

/// The verdict on each servo and the cycle seen in practice (largest_stable()), else the amplitude
/// of its irregular motion.
///
/// Side by side are solved servos with two masses and plastic contact, with damping in [1e-4,
/// 0.99], inertia ratio in [1e-4, 1e4] and friction ratio in [1e-4, 1 − 1e-4]; each lane by itself,
/// so that an answer does not depend on a servo's neighbours. A lane whose answer is not certain
/// (growth at rest 1 to within 1e-9, no convergence in six steps, a residual above
/// 1e-12) is solved again one by one, as are all servos outside these ranges; how
/// many, the count says.
///
/// Every vector unit of one kind of processor gives the same bits. analyse_limit_cycles() gives the
/// same verdicts, the growth at rest and the engaged time to 5e-14, the motor's friction loss to
/// 5e-11 (a small difference of large terms in either) and all else to 5e-13 (tests/chart).
///
/// Nothing is allocated for servos solved side by side. Throws InvalidInput, as
/// analyse_limit_cycles() does, for a servo outside the permitted ranges, named by its row (those
/// before it may have been written); and std::invalid_argument where a column has not as many rows
/// as there are servos, or for a vector unit that is not the machine's.
BatchCount find_limit_cycles(std::span<const NormalizedServo> servos, const CycleColumns& cycles,
                             VectorUnit unit = widest_vector_unit());

/// Turns into `undecided`, with NaN but for the growth at rest, each verdict on a servo with
/// plastic contact and damping that the enclosure of its growth at rest does not confirm
/// (bound_cycles() of the servo's own doubles), and returns how many. The others are then proved;
/// those on servos that bounce are left as they are. Precondition: the columns are those that
/// find_limit_cycles() wrote, with the verdict.
std::size_t keep_proved(std::span<const NormalizedServo> servos, const CycleColumns& cycles);

}  // namespace gearlash
