// Reading a controller.
#pragma once

#include "input/section_reader.hpp"
#include "model/controller.hpp"

namespace gearlash {

/// What a controller gives out, and per which angle it does.
struct ControllerUnits {
  bool is_voltage = false;         ///< else the motor's torque
  double torque_per_output = 1.0;  ///< N m at the load's shaft per V, or per N m at the motor's
  double gear_ratio = 1.0;
};

/// From [controller], its gains as torque at the load per angle of the load.
drive::Controller read_controller(SectionReader& section, const ControllerUnits& units);

}  // namespace gearlash
