#include "model/reduction.hpp"

namespace gearlash {

drive::ReducedDrive reduce(const Drive& drive) {
  drive::ReducedDrive result = reduced(drive, AsRead());
  if (result.gravity.torque != 0.0) {
    result.load_torque = drive::shifted(result.load_torque, result.gravity.torque);
  }
  return result;
}

}  // namespace gearlash
