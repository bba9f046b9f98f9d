// What a controller asks for as a function of s.
#pragma once

#include "model/controller.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash::drive {

/// τ_asked = reference(s) r + position(s) y + speed(s) v; none has a delay, and each lacks the
/// modes that its input does not reach or the torque does not show. What is 0 has the numerator
/// {0}.
struct ControllerTransfer {
  TransferFunction reference;
  TransferFunction position;
  TransferFunction speed;
};

/// C (sI − A)⁻¹ B + D within the torque limit, where an anti-windup does nothing. Formed in exact
/// arithmetic, so that each coefficient is rounded once; denominators begin with 1. Of a
/// controller from sample to sample s is z. Precondition: a sound one.
ControllerTransfer controller_transfer(const LinearController& controller);

}  // namespace gearlash::drive
