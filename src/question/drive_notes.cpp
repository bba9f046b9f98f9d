#include "question/drive_notes.hpp"

#include <numbers>
#include <string>

#include "base/decimal.hpp"
#include "model/firmware.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

std::string text_of(double value) {
  constexpr int digits = 4;
  return rounded_text(value, digits);
}

/// The gains that a firmware's registers are, where that is from, and what is left out.
std::string text_on_firmware(const Drive& drive) {
  const FirmwareFacts& facts = all_firmwares()[drive.controller.firmware->index()];
  const Conversion conversion = converted(drive);
  std::string text = "The registers of " + std::string(facts.name) + " mean";
  const char* separator = ": ";
  for (const ConvertedGain& gain : conversion.gains) {
    text += separator + std::string(gain.name) + " " + text_of(gain.value) + " " +
            std::string(gain.unit);
    separator = ", ";
  }
  if (conversion.gains.empty()) text += ": nothing, all are 0";
  const GainShaft shaft = conversion.controller.shaft;
  text += shaft == GainShaft::motor   ? ", per angle of the motor"
          : shaft == GainShaft::mixed ? ", torque of the motor per angle of the load"
                                      : ", per angle of the load";
  if (drive.sampling) text += ", every " + text_of(drive.sampling->period) + " s";
  return text + " (" + std::string(facts.source) +
         "). Not modelled: " + std::string(facts.left_out) + ".";
}

/// What two ratios make of a turn of the load; empty if neither has an effect.
std::string text_on_counted_turns(const Drive& drive) {
  const auto* moteus = std::get_if<Moteus>(&*drive.controller.firmware);
  const double ratio = drive.gearbox.ratio;
  if (moteus == nullptr || (ratio == 1.0 && moteus->rotor_to_output_ratio == 1.0)) return "";
  const std::string product = text_of(ratio * moteus->rotor_to_output_ratio);
  const bool is_on_load = drive.sensor.position != SensorPlace::motor;
  return "One turn of the load is " + (is_on_load ? "1" : product) +
         " of those that moteus counts, and a torque of 1 N m in its registers is " + product +
         " N m at the load: gearbox.ratio " + text_of(ratio) +
         ", which is the gear, times rotor_to_output_ratio " +
         text_of(moteus->rotor_to_output_ratio) + ", which is what moteus knows of it.";
}

}  // namespace

std::vector<Note> notes_on(const SoundDrive& sound) {
  const Drive& drive = sound.given();
  std::vector<Note> notes;
  if (drive.is_rounded) {
    notes.push_back({"rounded-numbers",
                     "Numbers of the drive were rounded as they were read or computed. What is "
                     "proved holds of all numbers "
                     "near them, and less is proved on boundaries."});
  }
  if (drive.servo) return notes;
  const drive::ReducedDrive& settled = sound.settled();
  const auto* torque = std::get_if<double>(&settled.load_torque);
  if (!has_dry_friction(settled) && settled.sensing.load_share_of_position == 0.0 &&
      settled.backlash > 0.0 && torque != nullptr && *torque == 0.0) {
    notes.push_back({"drifts-in-gap",
                     "No dry friction is given, and the load is not measured: it drifts in its gap "
                     "and may stop anywhere in it. Give motor.coulomb and load.coulomb; a no-load "
                     "current gives the motor's."});
  }
  const Motor& motor = drive.motor;
  if (drive.sensor.is_assumed) {
    notes.push_back(
        {"assumed-encoder",
         "The encoder is assumed on the load; sensor.position = \"motor\" puts it on the "
         "motor."});
  }
  if (!drive.controller.firmware && drive.controller.shaft == GainShaft::mixed &&
      std::holds_alternative<TorqueControl>(motor.kind) &&
      drive.sensor.position == SensorPlace::motor && drive.gearbox.ratio != 1.0) {
    notes.push_back({"mixed-gains",
                     "The gains count as torque of the motor per angle of the load. Gains per "
                     "angle of the motor, as drives with an encoder there print them, need "
                     "controller.shaft = \"motor\"."});
  }
  if (drive.controller.firmware) {
    notes.push_back({"firmware", text_on_firmware(drive)});
    const std::string turns = text_on_counted_turns(drive);
    if (!turns.empty()) notes.push_back({"counted-turns", turns});
  }
  const auto* cascade = std::get_if<CascadeController>(&drive.controller.law);
  const bool leads =
      !drive.controller.firmware && cascade != nullptr &&
      (cascade->speed_feedforward != 0.0 || cascade->acceleration_feedforward != 0.0);
  if (leads && std::holds_alternative<double>(sound.settled().reference)) {
    notes.push_back({"feedforward",
                     "Feed-forward acts only while the reference moves: it changes nothing here."});
  }
  if (motor.no_load_current && takes_no_load_current(motor)) {
    notes.push_back({"no-load-current", "The motor's dry friction is " +
                                            text_of(coulomb_torque(motor)) +
                                            " N m: torque constant times no-load current, an upper "
                                            "bound."});
  }
  if (drive.gearbox.efficiency) {
    notes.push_back(
        {"efficiency", "gearbox.efficiency = " + text_of(*drive.gearbox.efficiency) +
                           " is not modelled: losses in proportion to the transmitted torque are "
                           "left out. Give friction that does not depend on it as motor.coulomb or "
                           "load.coulomb."});
  }
  if (drive.load.gravity != 0.0) {
    const drive::Gravity& gravity = sound.settled().gravity;
    constexpr double degrees = 180.0 / std::numbers::pi;
    notes.push_back({"gravity", "Gravity is linearised about " +
                                    text_of((drive.load.gravity_angle + gravity.angle) * degrees) +
                                    "° above the horizontal, where the reference ends: torque " +
                                    text_of(gravity.torque) + " N m, stiffness " +
                                    text_of(gravity.stiffness) + " N m/rad."});
  }
  return notes;
}

}  // namespace gearlash
