// Splits the fast decays off a flow.
#pragma once

#include <vector>

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

/// A = A P + A (I − P), with P the spectral projector on decays that are much faster than all the
/// rest. Once P x has come to its rest, to rounding, it stays there, and
///   x′ = A (I − P) x + (I − P) b
/// can take steps as long as the slow decays permit.
struct FastDecays {
  Matrix projector;  ///< P
  Vector rest;       ///< of P x
  /// Where P x may end by rounding of the velocity, of which it takes R |x| + r; and by what is
  /// known of P itself.
  Matrix reach;
  Vector least_reach;
  Vector weights;  ///< that balance A: numbers over them are alike
  AffineFlow slow;

  /// Whether P x is at its rest, within rounding of its terms up to now; or where rounding of the
  /// velocity holds it off its rest, as an integral that moves by less than its rounding does a
  /// speed, if that is rounding of the largest of all numbers. `largest` holds the numbers' largest
  /// magnitudes up to now. (If the rest is 0, P x never reaches rounding of its own magnitude.)
  bool are_over(const Vector& state, const Vector& largest) const;
  /// Returns a state of the slow flow with the resting part set to its rest. Otherwise rounding of
  /// that flow, a share of ‖A‖, would accumulate.
  void put_at_rest(Vector& state) const;
};

/// The fastest decays, these and the next fastest, and so on: as many times as decays are much
/// faster than all the rest. Each list is left out that cannot be separated well enough.
std::vector<FastDecays> fast_decays(const AffineFlow& flow);

}  // namespace gearlash::hybrid
