#include "question/loop/energy/absence_by_energy.hpp"

#include <cmath>
#include <variant>
#include <vector>

#include "base/arithmetic.hpp"
#include "question/loop/energy/loop_polynomials.hpp"

namespace gearlash {
namespace {

using drive::ReducedDrive;
using Polynomial = IntervalPolynomial;

/// Whether Re(a/b) > 0 on the imaginary axis but at 0.
bool has_positive_real_part(const Polynomial& a, const Polynomial& b) {
  return is_positive(real_part(product(a, conjugate(b))));
}

bool is_at_rest_for_ever(const drive::Signal& signal) {
  return std::holds_alternative<double>(signal);
}

}  // namespace

bool is_absent_by_energy(const EnclosedDrive& enclosed) {
  const ReducedDrive& drive = enclosed.form();
  if (!proves() || !drive::has_linear_control(drive) || std::isfinite(drive.winding.torque_limit) ||
      drive.sampling || drive.sensing.resolution > 0.0 || std::isfinite(drive.torque_limit) ||
      !is_at_rest_for_ever(drive.reference) || !is_at_rest_for_ever(drive.load_torque)) {
    return false;
  }
  const LinearDrive<Interval> linear = linear_drive(enclosed);
  if (linear.order() > highest_order_of_polynomials) return false;
  const LoopPolynomials loop = loop_polynomials(linear);
  if (!is_stable(loop.closed)) return false;
  const Polynomial s{0.0, 1.0};
  const bool is_weighed = !is_exactly(linear.weight, 0.0);
  // The mesh torque over the gap's speed has a pole at 0, whose residue must not be negative.
  const Interval residue = linear.weight * (1.0 - linear.position_share) * loop.position[0];
  if (is_weighed && residue.low < 0.0) return false;
  if (!has_dry_friction(drive)) {
    // Re of the mesh torque over the gap's speed, load·motor/(s·closed)
    return is_weighed
               ? has_positive_real_part(product(loop.load, loop.motor), product(s, loop.closed))
               : has_positive_real_part(product(loop.load_momentum, loop.motor), loop.closed);
  }
  // Ports of motor and load are apart only where nothing is measured on the load.
  const bool measures_load =
      !is_exactly(linear.position_share, 0.0) || !is_exactly(linear.speed_share, 0.0);
  return !measures_load && linear.load_friction.low > 0.0 && linear.weight.low >= 0.0 &&
         has_positive_real_part(loop.motor, product(s, loop.denominator));
}

}  // namespace gearlash
