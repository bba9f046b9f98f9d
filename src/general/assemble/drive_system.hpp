// A drive as a hybrid system.
#pragma once

#include <array>

#include "general/assemble/drive_mode.hpp"
#include "general/assemble/state_indices.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "model/drive.hpp"

namespace gearlash::drive {

struct DriveSystem {
  hybrid::HybridSystem system;  ///< its modes are made when they are first entered
  DriveModes modes;             ///< the meaning of each mode's number
  StateIndices at;
  hybrid::Vector start;          ///< all numbers at time 0, with 0 for the shafts
  hybrid::Reset first_readings;  ///< for encoders, once the shafts are at their start
  hybrid::AffineForm reference;
  hybrid::AffineForm load_torque;
  std::array<hybrid::AffineForm, 3> motor_torques;  ///< by TorqueState

  const hybrid::AffineForm& motor_torque(std::size_t mode) const {
    return motor_torques[static_cast<std::size_t>(modes.mode(mode).torque)];
  }
};

/// Positions rad, speeds rad/s.
struct ShaftStates {
  double motor_position = 0.0;
  double motor_speed = 0.0;
  double load_position = 0.0;
  double load_speed = 0.0;
};

ShaftStates shafts_of(const hybrid::State& state);

/// Equations of motion, with τ the motor's torque, N the torque of the mesh on the load, and T the
/// load torque:
///   J_M ω_M′ = τ − N − friction_M,   J_L ω_L′ = N + T − friction_L.
/// A shaft with dry friction comes to rest where its speed passes 0 and the applied torque is at
/// most its breakaway torque. It sticks until the torque exceeds that. Rigid faces: impacts keep
/// the momentum and turn the relative speed into −e times itself. Engaged faces move as one, and
/// stick as one.
///
/// A sampled controller reads, computes and outputs at the ticks of clocks. An encoder under a
/// continuous one is a number that changes by a step where the position is half a step from it.
/// Signals are straight or quadratic between the ticks of their clock; a sine is an oscillator of
/// two numbers. Throws InvalidInput.
/// numbers. Throws InvalidInput.
DriveSystem drive_system(const ReducedDrive& drive);

/// A start at time 0 with the controller's states 0. The mode follows. If the gap is closed the
/// faces are in contact; rigid faces are engaged if the shafts then move as one, else they meet at
/// once. Friction follows from the speeds; a dry shaft at rest sticks. Throws InvalidInput if rigid
/// faces would overlap.
hybrid::State drive_start(const ReducedDrive& drive, const DriveSystem& system,
                          const ShaftStates& shafts);

}  // namespace gearlash::drive
