// A hybrid system in a scaled, shifted and moving frame.
#pragma once

#include "hybrid/periodic_orbit.hpp"

namespace gearlash::drive {

/// x = scale ∘ x′ + shift + drift t, with x′ the numbers in the frame. Scales are powers of 2, so
/// they cause no rounding.
struct MovingFrame {
  hybrid::Vector scale;
  hybrid::Vector shift;
  hybrid::Vector drift;

  hybrid::Vector inside(const hybrid::Vector& numbers, double time) const;
  hybrid::Vector outside(const hybrid::Vector& numbers, double time) const;
  /// What it is outside, of numbers inside. Precondition: it does not change along the drift.
  hybrid::AffineForm inside(hybrid::AffineForm form) const;
};

/// Whether moving all numbers along `way`, at any time, leaves the system unchanged: A way = 0, no
/// guard and no alternative depends on it, resets keep it, no quantizer reads it.
bool is_carried_along(const hybrid::HybridSystem& system, const hybrid::Vector& way);

/// Precondition: is_carried_along(system, frame.drift).
hybrid::HybridSystem seen_in(const hybrid::HybridSystem& system, const MovingFrame& frame);

/// An orbit of seen_in(system, {scale, …}) in the frame without the scale.
hybrid::PeriodicOrbit unscaled(hybrid::PeriodicOrbit orbit, const hybrid::Vector& scale);

}  // namespace gearlash::drive
