// Which number of a drive's state is what.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "general/assemble/signal_generator.hpp"
#include "model/drive.hpp"

namespace gearlash::drive {

/// Places of the shafts' numbers; the controller's states follow, and then what StateIndices names.
enum DriveNumber : Eigen::Index {
  motor_position,
  motor_speed,
  load_position,
  load_speed,
  controller_states
};

/// Places of all other numbers. Names of numbers are for reports alone.
struct StateIndices {
  static constexpr Eigen::Index none = -1;

  Eigen::Index controller_order = 0;    ///< numbers from `controller_states` on
  Eigen::Index held = none;             ///< torque, of a sampled controller
  Eigen::Index worked_out = none;       ///< torque, the next to be given out
  Eigen::Index last_worked_out = none;  ///< torque, the last of those that wait
  Eigen::Index last_reading = none;     ///< of the position whose differences are the speed
  Eigen::Index encoder = none;          ///< its reading, under a continuous controller
  Eigen::Index reference = 0;           ///< the first of the reference's generator
  Eigen::Index reference_size = 0;
  Eigen::Index load_torque = 0;  ///< the first of the load torque's generator
  Eigen::Index load_torque_size = 0;
  Eigen::Index size = 0;

  /// Numbers before those of the signals.
  Eigen::Index own() const { return reference; }
};

StateIndices state_indices(const ReducedDrive& drive, Eigen::Index controller_order,
                           const Generator& reference, const Generator& load_torque);

/// As reports name the numbers.
std::vector<std::string> state_names(const StateIndices& indices);

}  // namespace gearlash::drive
