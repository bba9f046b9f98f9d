// A controller's transfer functions from reference, position and speed to torque.
#pragma once

#include "model/controller.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash::drive {

/// τ_asked = reference(s) r + position(s) y + speed(s) v. None has a delay. Each lacks the modes
/// that its input does not reach or that the torque does not show. A zero function has the
/// numerator {0}.
struct ControllerTransfer {
  TransferFunction reference;
  TransferFunction position;
  TransferFunction speed;
};

/// C (sI − A)⁻¹ B + D within the torque limit, where an anti-windup does nothing. It is formed in
/// exact arithmetic, so that each coefficient is rounded once. Denominators begin with 1. For a
/// controller from sample to sample s is z. Precondition: a sound controller.
ControllerTransfer controller_transfer(const LinearController& controller);

}  // namespace gearlash::drive
