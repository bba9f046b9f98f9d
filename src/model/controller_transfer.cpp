#include "model/controller_transfer.hpp"

#include "model/rational_function.hpp"

namespace gearlash::drive {

ControllerTransfer controller_transfer(const LinearController& controller) {
  const ExactControllerTransfer exact = exact_transfer(controller, TorqueGiven::as_asked);
  return {rounded(exact.reference), rounded(exact.position), rounded(exact.speed)};
}

}  // namespace gearlash::drive
