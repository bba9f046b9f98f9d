// A drive without a closed form that is searched in milliseconds.
#pragma once

#include "gearlash/drive.hpp"

namespace gearlash {

/// A torque-controlled motor under a PD with the sensor on the load, both shafts with Coulomb
/// friction. It rests, or hunts if disturbed where its gain is high.
inline Drive pd_drive() {
  Drive drive;
  drive.motor = {
      .kind = TorqueControl{}, .inertia = 2e-5, .friction = {.viscous = 1e-5, .coulomb = 1e-3}};
  drive.gearbox = {.ratio = 20.0, .backlash = 2e-3};
  drive.load = {.inertia = 5e-3, .friction = {.viscous = 1e-3, .coulomb = 5e-3}};
  drive.contact = RigidContact{};
  drive.sensor.position = SensorPlace::load;
  drive.controller.law =
      PID{.terms = PIDTerms::PD, .proportional = 2.0, .derivative = 0.02, .filter = 1e-3};
  return drive;
}

}  // namespace gearlash
