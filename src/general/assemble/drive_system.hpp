// A drive as a hybrid system.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "general/assemble/drive_mode.hpp"
#include "general/assemble/state_indices.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "model/drive.hpp"

namespace gearlash::drive {

struct DriveSystem {
  hybrid::HybridSystem system;  ///< modes are made when first entered
  DriveModes modes;             ///< numbering of the modes
  StateIndices at;
  hybrid::Vector start;                ///< all numbers at time 0; the shafts' are 0 here
  hybrid::AffineReset first_readings;  ///< sets the encoders, given the shafts' start
  hybrid::AffineForm reference;
  hybrid::AffineForm load_torque;
  DriveMode first_feedforward{};   ///< its signs at time 0; nothing else
  hybrid::AffineForm shape_input;  ///< of ReducedDrive::error_shape at the start
  /// By the mode's number, modulo their count: they depend on neither contact nor friction.
  std::vector<hybrid::AffineForm> motor_torques;

  /// N m at the load's shaft, of a mode; empty where the faces are apart, or rigid ones stand.
  std::function<std::optional<hybrid::AffineForm>(std::size_t mode)> mesh_torque;

  const hybrid::AffineForm& motor_torque(std::size_t mode) const {
    return motor_torques[mode % motor_torques.size()];
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

/// Equations of motion, with τ the motor torque, N the mesh torque on the load, T the load torque:
///   J_M ω_M′ = τ − N − friction_M,   J_L ω_L′ = N + T − friction_L.
/// A shaft with dry friction comes to rest where its speed passes 0 and the applied torque is at
/// most its breakaway torque. It sticks until that is exceeded. At impacts of rigid faces momentum
/// is kept and the relative speed is multiplied by −e. Engaged rigid faces move, and stick, as one.
///
/// A sampled controller reads, computes and outputs at the ticks of clocks. An encoder under a
/// continuous controller is a number that changes by a step when the position is half a step from
/// it. Signals are linear or quadratic between the ticks of their clock; a sine is an oscillator of
/// two numbers. Throws InvalidInput.
DriveSystem drive_system(const ReducedDrive& drive);

/// A start at time 0 with the controller's states 0. The mode follows from the shafts: faces are in
/// contact if the gap is closed (rigid ones only at equal speeds; otherwise they meet at once),
/// friction has the sign of the speed, and a dry shaft at rest sticks. Throws InvalidInput if rigid
/// faces would penetrate each other.
hybrid::State drive_start(const ReducedDrive& drive, const DriveSystem& system,
                          const ShaftStates& shafts);

}  // namespace gearlash::drive
