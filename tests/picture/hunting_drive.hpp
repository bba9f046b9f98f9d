// A drive of pictures whose gap makes it hunt.
#pragma once

#include "gearlash/drive.hpp"

namespace gearlash::test {

/// Under proportional control, without dry friction or limit.
inline Drive hunting_drive() {
  Drive drive;
  drive.motor = {.inertia = 1.0, .friction = {.viscous = 0.9}};
  drive.load = {.inertia = 2.0, .friction = {.viscous = 0.1}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.3};
  drive.controller.law = PID{.proportional = 3.0};
  return drive;
}

}  // namespace gearlash::test
