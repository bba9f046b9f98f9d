// The linear loop of a drive as polynomials of s.
#pragma once

#include "model/linear_drive.hpp"
#include "numeric/positive_polynomial.hpp"

namespace gearlash {

/// With the gap u, the motor less the load, as an input: θ_L = −(motor/closed) u, and the mesh
/// torque on the load is −(load motor/closed) u. τ = (at_reference r − position y − speed
/// v)/denominator with y from the reference r, which is constant.
struct LoopPolynomials {
  IntervalPolynomial denominator{};  ///< of controller and winding
  IntervalPolynomial position{};
  IntervalPolynomial speed{};
  IntervalPolynomial at_reference{};
  IntervalPolynomial motor{};          ///< times denominator
  IntervalPolynomial load_momentum{};  ///< J_L s + F_L
  IntervalPolynomial load{};           ///< s load_momentum + k_g
  IntervalPolynomial closed{};         ///< the loop with the gap closed, times denominator
};

/// Preconditions: a continuous controller of at most `highest_order_of_polynomials`.
LoopPolynomials loop_polynomials(const LinearDrive<Interval>& drive);

/// Coefficients of a higher order lose their digits.
inline constexpr std::size_t highest_order_of_polynomials = 12;

/// p(−s).
IntervalPolynomial conjugate(IntervalPolynomial polynomial);

/// Whether it is proved that all roots have negative real parts.
bool is_stable(const IntervalPolynomial& polynomial);

}  // namespace gearlash
