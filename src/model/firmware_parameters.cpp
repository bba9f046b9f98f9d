// Parameters of a controller that is a firmware: its registers.
#include "model/firmware.hpp"
#include "model/parameter_list.hpp"

namespace gearlash::parameter_rows {
namespace {

template <auto member>
constexpr Place in_firmware = in_controller_if<is_plant, &Controller::firmware, member>;

constexpr Wanted plain_number{"a number as the firmware has it, without a unit"};

}  // namespace

void take_firmware(Drive& drive, std::size_t index) {
  become(drive.controller.firmware.emplace(), index);
  const std::optional<Sampling>& stated = all_firmwares()[index].sampling;
  if (stated && !drive.sampling) drive.sampling = stated;
}

std::vector<Parameter> firmware_parameters() {
  return {
      entry("controller.position_p_gain", in_firmware<&DynamixelX::position_p_gain>,
            "Position P Gain (84) of a DYNAMIXEL X", not_negative, required, plain_number,
            UsualRange{10.0, 16383.0}),
      entry("controller.position_i_gain", in_firmware<&DynamixelX::position_i_gain>,
            "Position I Gain (82) of a DYNAMIXEL X", not_negative, UsualRange{1.0, 16383.0}),
      entry("controller.position_d_gain", in_firmware<&DynamixelX::position_d_gain>,
            "Position D Gain (80) of a DYNAMIXEL X", not_negative, UsualRange{1.0, 16383.0}),
      entry("controller.pos_gain", in_firmware<&ODrive::pos_gain>,
            "pos_gain of ODrive, (turn/s)/turn", not_negative, required, plain_number,
            UsualRange{1.0, 500.0}),
      entry("controller.vel_gain", in_firmware<&ODrive::vel_gain>,
            "vel_gain of ODrive, N m/(turn/s)", not_negative, required, plain_number,
            UsualRange{1e-3, 10.0}),
      entry("controller.vel_integrator_gain", in_firmware<&ODrive::vel_integrator_gain>,
            "vel_integrator_gain of ODrive, N m/((turn/s) s)", not_negative,
            UsualRange{1e-3, 100.0}),
      entry("controller.pid_position_kp", in_firmware<&Moteus::kp>,
            "servo.pid_position.kp of moteus, N m per turn of the output", not_negative, required,
            plain_number, UsualRange{0.1, 1e4}),
      entry("controller.pid_position_ki", in_firmware<&Moteus::ki>,
            "servo.pid_position.ki of moteus, N m/s per turn of the output", not_negative,
            UsualRange{0.1, 1e4}),
      entry("controller.pid_position_kd", in_firmware<&Moteus::kd>,
            "servo.pid_position.kd of moteus, N m per turn/s of the output", not_negative,
            UsualRange{1e-3, 1e3}),
      entry("controller.rotor_to_output_ratio", in_firmware<&Moteus::rotor_to_output_ratio>,
            "motor_position.rotor_to_output_ratio of moteus, output turns per rotor turn", positive,
            UsualRange{0.01, 1.0}),
      entry("controller.P_angle", in_firmware<&SimpleFOC::angle_p>,
            "P_angle.P of SimpleFOC, (rad/s)/rad", not_negative, required, plain_number,
            UsualRange{1.0, 200.0}),
      entry("controller.PID_velocity_P", in_firmware<&SimpleFOC::velocity_p>,
            "PID_velocity.P of SimpleFOC, V or A per rad/s", not_negative, required, plain_number,
            UsualRange{1e-3, 10.0}),
      entry("controller.PID_velocity_I", in_firmware<&SimpleFOC::velocity_i>,
            "PID_velocity.I of SimpleFOC, V or A per rad", not_negative, UsualRange{1e-2, 1e3}),
      entry("controller.LPF_velocity_Tf", in_firmware<&SimpleFOC::velocity_filter>,
            "LPF_velocity.Tf of SimpleFOC, s", not_negative, UsualRange{1e-4, 0.1}),
      entry("controller.tracking_time",
            first_of<in_firmware<&DynamixelX::tracking_time>, in_firmware<&ODrive::tracking_time>,
                     in_firmware<&Moteus::tracking_time>, in_firmware<&SimpleFOC::tracking_time>>,
            "anti-windup by back-calculation in place of the firmware's own: its time "
            "constant; 0: none",
            unit<time>, not_negative, UsualRange{1e-3, 10.0})};
}

}  // namespace gearlash::parameter_rows
