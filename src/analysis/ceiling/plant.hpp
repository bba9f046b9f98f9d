// The mechanics of a drive as a linear system, whatever its contact does: its gap is an input.
#pragma once

#include <optional>

#include "analysis/ceiling/enclosed.hpp"
#include "numeric/interval_algebra.hpp"

namespace gearlash {

/// A number as a linear form of the plant's states and of what acts at the same moment.
struct PlantOutput {
  IntervalVector of_state{};
  Interval of_torque{0.0};  ///< requested, where no winding delays it
  Interval of_gap{0.0};
  Interval of_gap_speed{0.0};
  Interval of_torque_on_motor{0.0};  ///< a disturbance
  Interval of_torque_on_load{0.0};   ///< a disturbance
};

/// x′ = flow x + torque τ + gap u + torque_on_motor w_M + torque_on_load w_L, by deviations from
/// the motion with the gap closed. Torques are N m at the load's shaft.
///
/// Rigid faces: u is the gap, within ±b/2. Both shafts' equations are added, so that the mesh
/// torque cancels; with J = J_M + J_L, κ = J_M/J and z = θ_L + κ u,
///   J z̈ = τ − F ż + (Fκ − F_M) u̇ − k_g (z − κ u) + w,   T τ′ = τ_requested − E ω_M − τ
/// (the latter with inductance). The states are z, ż and τ less what u̇ feeds into each: no u̇ is
/// left in the flow.
///
/// Compliant faces without damping: u is the gap's part within ±b/2, and both shafts are joined by
/// the spring. Without a gap the spring may be damped.
struct Plant {
  IntervalMatrix flow;
  IntervalVector torque{};  ///< requested
  IntervalVector gap{};
  IntervalVector torque_on_motor{};
  IntervalVector torque_on_load{};
  PlantOutput load{};      ///< position
  PlantOutput motor{};     ///< position
  PlantOutput position{};  ///< sensed
  PlantOutput counted{};   ///< position whose differences are the speed of a computer
  PlantOutput speed{};     ///< sensed
  /// ω_M′ − ω_L′ while the faces are apart; rigid faces only.
  std::optional<PlantOutput> gap_acceleration{};
  // States at a start, per unit: of the position of all that moves, of its speed, and of u.
  IntervalVector start_of_position{};
  IntervalVector start_of_speed{};
  IntervalVector start_of_gap{};

  std::size_t size() const { return flow.size(); }
};

/// Precondition for what the gap adds: rigid faces, or compliant ones without damping or without a
/// gap. All else holds for any faces that stay together.
Plant plant_of(const EnclosedDrive& drive);

}  // namespace gearlash
