#include "general/assemble/state_indices.hpp"

namespace gearlash::drive {

StateIndices state_indices(const ReducedDrive& drive, Eigen::Index controller_order,
                           const Generator& reference, const Generator& load_torque) {
  StateIndices indices;
  indices.controller_order = controller_order;
  Eigen::Index next = controller_states + controller_order;
  if (drive.sampling) {
    indices.held = next++;
    if (drive.sampling->delay > 0.0) {
      indices.worked_out = next;
      indices.last_worked_out = next + split_delay(*drive.sampling).whole_periods;
      next = indices.last_worked_out + 1;
    }
    if (drive.sampling->speed_by_differences) indices.last_reading = next++;
    if (keeps_error(drive)) indices.error = next++;
  } else if (drive.sensing.resolution > 0.0) {
    indices.encoder = next++;
  }
  if (drive.winding.time_constant > 0.0) indices.winding = next++;
  const Feedforward& forward = drive.feedforward;
  if (forward.half_gap != 0.0 && forward.take_up_time > 0.0) indices.taken_up = next++;
  indices.reference = next;
  indices.reference_size = reference.size();
  indices.load_torque = next + reference.size();
  indices.load_torque_size = load_torque.size();
  indices.size = indices.load_torque + load_torque.size();
  return indices;
}

std::vector<std::string> state_names(const StateIndices& indices) {
  std::vector<std::string> names(static_cast<std::size_t>(indices.size));
  const auto name = [&](Eigen::Index index, const std::string& text) {
    if (index != StateIndices::none) names[static_cast<std::size_t>(index)] = text;
  };
  const auto name_all = [&](Eigen::Index first, Eigen::Index count, const std::string& text) {
    for (Eigen::Index i = 0; i < count; ++i) {
      name(first + i, i == 0 ? text : text + " " + std::to_string(i + 1));
    }
  };
  name(motor_position, "motor position");
  name(motor_speed, "motor speed");
  name(load_position, "load position");
  name(load_speed, "load speed");
  for (Eigen::Index i = 0; i < indices.controller_order; ++i) {
    name(controller_states + i, "controller " + std::to_string(i + 1));
  }
  name(indices.held, "torque held");
  if (indices.worked_out != StateIndices::none) {
    name_all(indices.worked_out, indices.last_worked_out - indices.worked_out + 1,
             "torque worked out");
  }
  name(indices.last_reading, "last reading");
  name(indices.encoder, "encoder");
  name(indices.error, "error");
  name(indices.winding, "torque of the winding");
  name(indices.taken_up, "backlash taken up");
  name_all(indices.reference, indices.reference_size, "reference");
  name_all(indices.load_torque, indices.load_torque_size, "load torque");
  return names;
}

}  // namespace gearlash::drive
