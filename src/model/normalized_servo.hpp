// The servo reduced to the numbers that decide hunting: ω_n = 1, J_M + J_L = 1, K = 1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gearlash/fault.hpp"

namespace gearlash {

/// The inputs of every chart of the 1960 thesis (restitution was fixed there).
///
/// With J_M + J_L = 1, K = 1 and y the load's position from the reference, the equations are
///   engaged    ÿ + 2ζẏ + y = 0,
///   separated  J_L ÿ_L + F_L ẏ_L = 0,   J_M ÿ_M + F_M ẏ_M + y_L = 0.
struct NormalizedServo {
  double damping = 0.0;         ///< ζ = (F_M+F_L)/(2 ω_n (J_M+J_L)), 0 or 1e-15 … 1000
  double inertia_ratio = 1.0;   ///< J_L/J_M; 0, 1e-9 … 1e9, or infinity (a massless motor)
  double friction_ratio = 0.5;  ///< F_L/(F_M+F_L), 0 … 1; without effect where damping is 0
  double backlash = 0.0;        ///< b, rad at the load shaft, face to face, 0 or 1e-15 … 1e6
  double restitution = 0.0;     ///< e, 0 (plastic) … 1 (elastic)

  bool operator==(const NormalizedServo&) const = default;
};

/// The permitted values of a field, in the words that follow "must be" in a fault:
/// permitted_values("friction_ratio") is "from 0 to 1". Empty for another name.
std::string permitted_values(std::string_view field);

/// Every fault in the ranges above, and in two rules that join fields. A massless load
/// (inertia_ratio 0) needs load friction, and a massless motor (infinity) needs motor friction,
/// because a shaft with neither inertia nor friction has no law of motion in the gap.
/// Empty for a sound servo.
std::vector<Fault> faults(const NormalizedServo& servo);

}  // namespace gearlash
