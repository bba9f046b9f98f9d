// Where a drive can rest, from its equations.
#pragma once

#include <optional>

#include "gearlash/answer.hpp"
#include "model/drive.hpp"

namespace gearlash {

/// All equilibria under a constant reference and load torque: the mesh torque is between the load
/// torque's opposite less and more the load's breakaway torque, the motor's torque between the mesh
/// torque less and more the motor's. Rigid and compliant faces. Empty where the equations have no
/// single answer: a sampled controller, an encoder, an integrator, a static gain that is not
/// positive, a torque limit, signals that move.
std::optional<Rest> computed_rest(const drive::ReducedDrive& drive);

}  // namespace gearlash
