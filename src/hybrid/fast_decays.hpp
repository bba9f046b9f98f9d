// The fast decays of a flow, split off.
#pragma once

#include <optional>

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

/// A = A P + A (I − P), P the spectral projector on decays that are much faster than all the rest.
/// Once P x has come to its rest, to rounding, it stays there, and
///   x′ = A (I − P) x + (I − P) b,
/// whose steps are as long as the slow ones permit.
struct FastDecays {
  Matrix projector;  ///< P
  Vector rest;       ///< of P x
  AffineFlow slow;

  /// Whether P x is at its rest, to rounding of what it is and has been made of: `largest` are the
  /// numbers' largest sizes up to now. (Where the rest is 0, P x never comes to rounding of its
  /// own size.)
  bool are_over(const Vector& state, const Vector& largest) const;
  /// A state that the slow flow has come to: what is at rest is put there, so that rounding of that
  /// flow, a share of ‖A‖, does not add up.
  void put_at_rest(Vector& state) const;
};

/// Nothing where no decays are fast enough, or they cannot be told apart well enough.
std::optional<FastDecays> fast_decays(const AffineFlow& flow);

}  // namespace gearlash::hybrid
