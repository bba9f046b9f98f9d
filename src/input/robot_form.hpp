// Joints in the words of robots' simulators: sections [joint] and [actuator], as in MuJoCo.
#pragma once

#include <string_view>

#include "gearlash/drive.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// [joint] and [actuator] give a torque-controlled joint with its gains at the load. All their
/// numbers are at the joint's side of the gears, so the ratio is 1. Their keys are other forms of a
/// drive's parameters: "joint.armature" is motor.inertia.
bool is_of_robots(std::string_view section);

/// Whether a parameter has such a form.
bool has_robots_form(const Parameter& parameter);

/// Whether a file in this form must give the parameter in this section.
bool is_required_of_robots(const Parameter& parameter, std::string_view section);

/// A joint before its numbers are read: with a derivative, and with a computer, if the file gives
/// their numbers. MuJoCo's computer reads exact speeds. The encoder's place is assumed: its
/// simulator knows no gap.
Drive robots_joint(bool has_derivative, bool is_sampled);

}  // namespace gearlash
