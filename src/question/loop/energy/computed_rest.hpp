// Where a drive can rest, from its equations.
#pragma once

#include <vector>

#include "gearlash/answer.hpp"
#include "model/drive.hpp"

namespace gearlash {

/// The ends of all equilibria under a constant reference and load torque, merged by kind. Unknown
/// are the load's position, the gap u, the mesh torque N and the requested torque; each contact
/// state, torque limit, branch of the error (dead band, relay, compensation) and reading of the
/// encoder makes a polytope of them:
///   |N + load torque − weight| ≤ the load's breakaway torque, |torque − N| ≤ the motor's,
///   N = 0 and |u| ≤ b/2, or u = ±b/2 (compliant: ± b/2 + N/stiffness) and ±N ≥ 0,
///   the reading and the requested torque are such that the controller's states stand,
///   the sensed position is within half a step of the reading.
/// Equilibria need not be stable. Empty where there are none (an integrator without a reading at
/// the reference), where some extend without end, where signals move, and not computed for a
/// feed-forward, which acts by where the reference came from.
std::vector<RestPiece> computed_rest(const drive::ReducedDrive& drive);

/// Whether a place of rest is among these equilibria, to its uncertainty and their rounding, 1e-9
/// of their ends. A place whose uncertainty is not known may be.
bool may_hold(const RestPiece& piece, const RestPlace& place);

}  // namespace gearlash
