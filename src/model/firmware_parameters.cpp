#include "model/firmware.hpp"
#include "model/parameter_list.hpp"

namespace gearlash {
namespace {

template <class Registers, class Member>
Slot of_firmware(Drive& drive, Member Registers::*member) {
  std::optional<Firmware>& firmware = drive.controller.firmware;
  return drive.servo || !firmware ? Slot{} : slot_of(*firmware, member);
}

constexpr char plain_number[] = "a number as the firmware has it, without a unit";

std::vector<Parameter> dynamixel_parameters() {
  return {{.path = "controller.position_p_gain",
           .slot = [](Drive& d) { return of_firmware(d, &DynamixelX::position_p_gain); },
           .meaning = "Position P Gain (84) of a DYNAMIXEL X",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .wanted = plain_number,
           .usual = {10.0, 16383.0}},
          {.path = "controller.position_i_gain",
           .slot = [](Drive& d) { return of_firmware(d, &DynamixelX::position_i_gain); },
           .meaning = "Position I Gain (82) of a DYNAMIXEL X",
           .permitted = Permitted::not_negative,
           .usual = {1.0, 16383.0}},
          {.path = "controller.position_d_gain",
           .slot = [](Drive& d) { return of_firmware(d, &DynamixelX::position_d_gain); },
           .meaning = "Position D Gain (80) of a DYNAMIXEL X",
           .permitted = Permitted::not_negative,
           .usual = {1.0, 16383.0}}};
}

std::vector<Parameter> odrive_parameters() {
  return {{.path = "controller.pos_gain",
           .slot = [](Drive& d) { return of_firmware(d, &ODrive::pos_gain); },
           .meaning = "pos_gain of ODrive, (turn/s)/turn",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .wanted = plain_number,
           .usual = {1.0, 500.0}},
          {.path = "controller.vel_gain",
           .slot = [](Drive& d) { return of_firmware(d, &ODrive::vel_gain); },
           .meaning = "vel_gain of ODrive, N m/(turn/s)",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .wanted = plain_number,
           .usual = {1e-3, 10.0}},
          {.path = "controller.vel_integrator_gain",
           .slot = [](Drive& d) { return of_firmware(d, &ODrive::vel_integrator_gain); },
           .meaning = "vel_integrator_gain of ODrive, N m/((turn/s) s)",
           .permitted = Permitted::not_negative,
           .usual = {1e-3, 100.0}}};
}

std::vector<Parameter> moteus_parameters() {
  return {{.path = "controller.pid_position_kp",
           .slot = [](Drive& d) { return of_firmware(d, &Moteus::kp); },
           .meaning = "servo.pid_position.kp of moteus, N m per turn of the output",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .wanted = plain_number,
           .usual = {0.1, 1e4}},
          {.path = "controller.pid_position_ki",
           .slot = [](Drive& d) { return of_firmware(d, &Moteus::ki); },
           .meaning = "servo.pid_position.ki of moteus, N m/s per turn of the output",
           .permitted = Permitted::not_negative,
           .usual = {0.1, 1e4}},
          {.path = "controller.pid_position_kd",
           .slot = [](Drive& d) { return of_firmware(d, &Moteus::kd); },
           .meaning = "servo.pid_position.kd of moteus, N m per turn/s of the output",
           .permitted = Permitted::not_negative,
           .usual = {1e-3, 1e3}},
          {.path = "controller.rotor_to_output_ratio",
           .slot = [](Drive& d) { return of_firmware(d, &Moteus::rotor_to_output_ratio); },
           .meaning = "motor_position.rotor_to_output_ratio of moteus, output turns per rotor turn",
           .permitted = Permitted::positive,
           .usual = {0.01, 1.0}}};
}

std::vector<Parameter> simplefoc_parameters() {
  return {{.path = "controller.P_angle",
           .slot = [](Drive& d) { return of_firmware(d, &SimpleFOC::angle_p); },
           .meaning = "P_angle.P of SimpleFOC, (rad/s)/rad",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .wanted = plain_number,
           .usual = {1.0, 200.0}},
          {.path = "controller.PID_velocity_P",
           .slot = [](Drive& d) { return of_firmware(d, &SimpleFOC::velocity_p); },
           .meaning = "PID_velocity.P of SimpleFOC, V or A per rad/s",
           .permitted = Permitted::not_negative,
           .is_required = true,
           .wanted = plain_number,
           .usual = {1e-3, 10.0}},
          {.path = "controller.PID_velocity_I",
           .slot = [](Drive& d) { return of_firmware(d, &SimpleFOC::velocity_i); },
           .meaning = "PID_velocity.I of SimpleFOC, V or A per rad",
           .permitted = Permitted::not_negative,
           .usual = {1e-2, 1e3}},
          {.path = "controller.LPF_velocity_Tf",
           .slot = [](Drive& d) { return of_firmware(d, &SimpleFOC::velocity_filter); },
           .meaning = "LPF_velocity.Tf of SimpleFOC, s",
           .permitted = Permitted::not_negative,
           .usual = {1e-4, 0.1}}};
}

/// Beside those of the laws.
Parameter tracking_time() {
  return {.path = "controller.tracking_time",
          .slot =
              [](Drive& d) {
                for (const Slot& slot : {of_firmware(d, &DynamixelX::tracking_time),
                                         of_firmware(d, &ODrive::tracking_time),
                                         of_firmware(d, &Moteus::tracking_time),
                                         of_firmware(d, &SimpleFOC::tracking_time)}) {
                  if (!std::holds_alternative<std::monostate>(slot)) return slot;
                }
                return Slot{};
              },
          .dimension = &always<dimensions::time>,
          .meaning =
              "anti-windup by back-calculation in place of the firmware's own: its time "
              "constant; 0: none",
          .permitted = Permitted::not_negative,
          .usual = {1e-3, 10.0}};
}

template <std::size_t... which>
void become(Firmware& firmware, std::size_t index, std::index_sequence<which...>) {
  const Firmware all[] = {Firmware(std::in_place_index<which>)...};
  firmware = all[index];
}

}  // namespace

void take_firmware(Drive& drive, std::size_t index) {
  Firmware& firmware = drive.controller.firmware.emplace();
  become(firmware, index, std::make_index_sequence<std::variant_size_v<Firmware>>());
  const std::optional<Sampling>& stated = all_firmwares()[index].sampling;
  if (stated && !drive.sampling) drive.sampling = stated;
}

std::vector<Parameter> firmware_parameters() {
  std::vector<Parameter> list;
  for (auto* part :
       {&dynamixel_parameters, &odrive_parameters, &moteus_parameters, &simplefoc_parameters}) {
    for (Parameter& parameter : (*part)()) list.push_back(std::move(parameter));
  }
  list.push_back(tracking_time());
  return list;
}

}  // namespace gearlash
