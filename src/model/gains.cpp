#include "model/gains.hpp"

#include "model/firmware.hpp"
#include "model/parameters.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

std::vector<PlacedGain> placed_gains(const Drive& drive) {
  if (drive.controller.firmware) return placed_gains(without_registers(drive));
  std::vector<PlacedGain> gains;
  const double ratio = drive.gearbox.ratio;
  const bool has_torque = std::holds_alternative<TorqueControl>(drive.motor.kind);
  if (drive.servo || !has_torque || ratio == 1.0) return gains;
  const double scale = gain_scale(drive);
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const bool is_of_law = parameter.section() == "controller" &&
                           parameter.path != "controller.motor_speed_feedback";  // of the motor's
    if (!is_of_law || !exists(parameter, drive)) continue;
    const Dimension* dimension = parameter.dimension(drive);
    const bool is_gain = dimension == &dimensions::torque_per_angle ||
                         dimension == &dimensions::torque_per_angle_and_time ||
                         dimension == &dimensions::torque_per_speed;
    const std::optional<double> value = is_gain ? number_in(parameter, drive) : std::nullopt;
    if (!value) continue;
    const double at_joint = scale * *value;
    gains.push_back({parameter.path, dimension->unit, at_joint, at_joint / (ratio * ratio)});
  }
  return gains;
}

}  // namespace gearlash
