// Splits the fast decays off a flow.
#pragma once

#include <optional>

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

/// A = A P + A (I − P), with P the spectral projector on decays that are much faster than all the
/// rest. Once P x has come to its rest, to rounding, it stays there, and
///   x′ = A (I − P) x + (I − P) b
/// can take steps as long as the slow decays permit.
struct FastDecays {
  Matrix projector;  ///< P
  Matrix spread;     ///< Σ |rₖ| |lₖᵀ| over its right and left eigenvectors, whose sum P is
  Vector rest;       ///< of P x
  AffineFlow slow;

  /// Whether P x is at its rest, within rounding of each decay's terms up to now: an integral that
  /// moves by less than its rounding holds a speed off its rest. `largest` holds the
  /// numbers' largest magnitudes up to now. (If the rest is 0, P x never reaches rounding of its
  /// own magnitude.)
  bool are_over(const Vector& state, const Vector& largest) const;
  /// Returns a state of the slow flow with the resting part set to its rest. Otherwise rounding of
  /// that flow, a share of ‖A‖, would accumulate.
  void put_at_rest(Vector& state) const;
};

/// Empty if no decays are fast enough, or if they cannot be separated well enough.
std::optional<FastDecays> fast_decays(const AffineFlow& flow);

}  // namespace gearlash::hybrid
