// The limit cycles of many servos at once: several side by side in the lanes of a vector unit.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "closed_form/cycle_bounds.hpp"
#include "closed_form/limit_cycle.hpp"
#include "gearlash/quantity.hpp"
#include "model/normalized_servo.hpp"

namespace gearlash {

/// Instructions for which the kernel is compiled; the widest that the processor and the operating
/// system permit is chosen when the program runs.
enum class VectorUnit {
  baseline,  ///< on every processor of the architecture: 2 lanes of SSE2, or of NEON
  avx2,      ///< 4 lanes
  avx512     ///< 8 lanes (F, CD, DQ, BW)
};

/// The vector units of this machine, from the narrowest to the widest; never empty.
std::vector<VectorUnit> available_vector_units();
VectorUnit widest_vector_unit();

/// "baseline", "avx2", "avx512".
const char* name_of(VectorUnit unit);

/// A quantity of cycles that has a closed form.
struct CycleQuantity {
  Quantity quantity = Quantity::amplitude;
  double (*of)(const LimitCycle& cycle) = nullptr;
};

/// All of them, in the order of the kernels' columns.
inline constexpr CycleQuantity cycle_quantities[] = {
    {Quantity::amplitude, [](const LimitCycle& cycle) { return cycle.amplitude; }},
    {Quantity::motor_amplitude, [](const LimitCycle& cycle) { return cycle.motor_amplitude; }},
    {Quantity::period, [](const LimitCycle& cycle) { return cycle.period; }},
    {Quantity::frequency, [](const LimitCycle& cycle) { return 1.0 / cycle.period; }},
    {Quantity::multiplier, [](const LimitCycle& cycle) { return cycle.multiplier; }},
    {Quantity::impact_speed, [](const LimitCycle& cycle) { return cycle.impact_speed; }},
    {Quantity::mesh_torque, [](const LimitCycle& cycle) { return cycle.mesh_torque; }},
    {Quantity::engaged_time, [](const LimitCycle& cycle) { return cycle.engaged_time; }},
    {Quantity::separated_time, [](const LimitCycle& cycle) { return cycle.separated_time; }},
    {Quantity::motor_friction_loss,
     [](const LimitCycle& cycle) { return cycle.energy.motor_friction; }},
    {Quantity::load_friction_loss,
     [](const LimitCycle& cycle) { return cycle.energy.load_friction; }},
    {Quantity::impact_loss, [](const LimitCycle& cycle) { return cycle.energy.impacts; }},
    {Quantity::residual, [](const LimitCycle& cycle) { return cycle.residual; }}};

/// The quantities of a servo that have a closed form, beside its verdict.
inline constexpr auto solved_quantities = [] {
  std::array<Quantity, std::size(cycle_quantities) + 1> all{Quantity::growth_at_rest};
  for (std::size_t i = 1; i < all.size(); ++i) all[i] = cycle_quantities[i - 1].quantity;
  return all;
}();

/// Columns for the answers. Each has one row for each servo; a column that is left out is empty.
/// Numbers are those of the normal form, in SI (ω_n = 1 rad/s, K = 1 N m/rad). A servo that cannot
/// hunt, or whose cycle is not known, has NaN in all but the growth at rest. Quantities not among
/// solved_quantities are not written.
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
/// Servos with two masses and plastic contact are solved side by side if damping is in [1e-4,
/// 0.99], inertia ratio in [1e-4, 1e4] and friction ratio in [1e-4, 1 − 1e-4]. Each lane is
/// independent, so an answer does not depend on a servo's neighbours. A lane whose answer is not
/// certain (growth at rest 1 to within 1e-9, no convergence in six steps, a residual above 1e-12)
/// is solved again one by one, as are all servos outside these ranges. The result counts both.
///
/// Every vector unit of one kind of processor gives the same bits. analyse_limit_cycles() gives the
/// same verdicts, the growth at rest and the engaged time to 5e-14, the motor's friction loss to
/// 5e-11 (a small difference of large terms in either) and all else to 5e-13 (tests/chart).
///
/// Nothing is allocated for servos solved side by side. Throws InvalidInput, as
/// analyse_limit_cycles() does, for a servo outside the permitted ranges, and names its row (rows
/// before it may have been written). Throws std::invalid_argument if a column does not have one row
/// for each servo, or if this machine lacks the vector unit.
BatchCount find_limit_cycles(std::span<const NormalizedServo> servos, const CycleColumns& cycles,
                             VectorUnit unit = widest_vector_unit());

/// Changes each unproved verdict to `undecided`, with NaN in all but the growth at rest, and
/// returns their number. A verdict on a servo with plastic contact and damping is proved if the
/// enclosure of its growth at rest confirms it, for all servos of the row's box. Verdicts on servos
/// that bounce are not changed. Precondition: the columns are those that find_limit_cycles() wrote,
/// with the verdict.
std::size_t keep_proved(std::span<const NormalizedServo> servos, const CycleColumns& cycles,
                        const std::function<ServoBox(std::size_t row)>& box_of_row);

}  // namespace gearlash
