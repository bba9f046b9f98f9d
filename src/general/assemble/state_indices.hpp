// Places of all numbers in a drive's state.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "general/assemble/signal_generator.hpp"
#include "model/drive.hpp"

namespace gearlash::drive {

/// Places of the shafts' numbers. The controller's states follow, then the rest in StateIndices.
enum DriveNumber : Eigen::Index {
  motor_position,
  motor_speed,
  load_position,
  load_speed,
  controller_states
};

/// Places of all other numbers. Their names serve reports alone.
struct StateIndices {
  static constexpr Eigen::Index none = -1;

  Eigen::Index controller_order = 0;    ///< numbers from `controller_states` on
  Eigen::Index held = none;             ///< torque, of a sampled controller
  Eigen::Index worked_out = none;       ///< torque, the next output
  Eigen::Index last_worked_out = none;  ///< torque, the last of those waiting for output
  Eigen::Index last_reading = none;     ///< the position whose differences are the speed
  Eigen::Index encoder = none;          ///< its reading, under a continuous controller
  Eigen::Index error = none;            ///< as last read, where the controller keeps it
  Eigen::Index winding = none;          ///< torque of a winding that lags
  Eigen::Index taken_up = none;         ///< addition to the reference that lags, rad
  Eigen::Index reference = 0;           ///< the first of the reference's generator
  Eigen::Index reference_size = 0;
  Eigen::Index load_torque = 0;  ///< the first of the load torque's generator
  Eigen::Index load_torque_size = 0;
  Eigen::Index size = 0;

  /// Count of the numbers before those of the signals.
  Eigen::Index own() const { return reference; }
};

StateIndices state_indices(const ReducedDrive& drive, Eigen::Index controller_order,
                           const Generator& reference, const Generator& load_torque);

/// Names of the numbers for reports.
std::vector<std::string> state_names(const StateIndices& indices);

}  // namespace gearlash::drive
