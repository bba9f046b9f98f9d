// Parameters of relays, dead bands and compensations of a controller.
#include "model/parameter_list.hpp"

namespace gearlash {
namespace {

using namespace dimensions;

const RelayController* relay_of(const Drive& drive) {
  return has_law(drive) ? std::get_if<RelayController>(&drive.controller.law) : nullptr;
}

const Dimension* output_dimension(const Drive& drive) {
  return std::holds_alternative<TorqueControl>(drive.motor.kind) ? &torque : &voltage;
}

const Dimension* threshold_dimension(const Drive& drive) {
  const RelayController* relay = relay_of(drive);
  return relay != nullptr && relay->input == RelayInput::speed ? &angular_speed : &angle;
}

/// Whether a law other than a relay has a dead band.
bool has_dead_band(const Drive& drive) {
  return has_law(drive) && relay_of(drive) == nullptr && drive.controller.dead_band.width != 0.0;
}

bool compensates_gap(const Drive& drive) {
  return has_law(drive) && drive.controller.compensation.backlash != 0.0;
}

bool compensates_gap_by(const Drive& drive, CompensationInput input) {
  return compensates_gap(drive) && drive.controller.compensation.input == input;
}

std::vector<Parameter> relay_parameters() {
  return {{.path = "controller.level",
           .slot =
               [](Drive& d) {
                 return has_law(d) ? slot_of(d.controller.law, &RelayController::level) : Slot{};
               },
           .dimension = &output_dimension,
           .meaning = "output of the relay, with either sign",
           .permitted = Permitted::positive,
           .is_required = true,
           .usual = {1e-3, 1000.0}},
          {.path = "controller.input",
           .slot =
               [](Drive& d) {
                 if (relay_of(d) == nullptr) return Slot{};
                 return Slot{Choice{[](const Drive& drive) {
                                      return static_cast<std::size_t>(relay_of(drive)->input);
                                    },
                                    [](Drive& drive, std::size_t choice) {
                                      std::get<RelayController>(drive.controller.law).input =
                                          static_cast<RelayInput>(choice);
                                    }}};
               },
           .meaning = "input of the relay: the error, or the measured speed with the other sign",
           .choices = {"error", "speed"}}};
}

std::vector<Parameter> dead_band_parameters() {
  return {
      {.path = "controller.dead_band",
       .slot = [](Drive& d) { return has_law(d) ? Slot{&d.controller.dead_band.width} : Slot{}; },
       .dimension = &threshold_dimension,
       .meaning = "half of the band about 0 in which the error counts as 0",
       .permitted = Permitted::not_negative,
       .usual = {1e-5, 0.1}},
      {.path = "controller.dead_band_form",
       .slot =
           [](Drive& d) {
             if (!has_dead_band(d)) return Slot{};
             return Slot{Choice{[](const Drive& drive) {
                                  return static_cast<std::size_t>(drive.controller.dead_band.form);
                                },
                                [](Drive& drive, std::size_t choice) {
                                  drive.controller.dead_band.form =
                                      static_cast<DeadBandForm>(choice);
                                }}};
           },
       .meaning = "what the controller receives beyond the dead band: the excess, or the whole "
                  "error",
       .choices = {"excess", "whole"}},
      {.path = "controller.hysteresis",
       .slot =
           [](Drive& d) {
             const bool is_whole =
                 has_dead_band(d) && d.controller.dead_band.form == DeadBandForm::whole;
             return is_whole || relay_of(d) != nullptr ? Slot{&d.controller.dead_band.hysteresis}
                                                       : Slot{};
           },
       .dimension = &threshold_dimension,
       .meaning = "distance from dead_band to the thresholds where the output begins, outside, "
                  "and ends, inside",
       .permitted = Permitted::not_negative,
       .usual = {1e-5, 0.1}}};
}

std::vector<Parameter> friction_compensation() {
  return {
      {.path = "controller.friction_compensation",
       .slot =
           [](Drive& d) { return has_law(d) ? Slot{&d.controller.compensation.friction} : Slot{}; },
       .dimension = &output_dimension,
       .meaning = "added to the output, with the sign of the reference's speed",
       .permitted = Permitted::not_negative,
       .usual = {1e-3, 100.0}},
      {.path = "controller.friction_speed",
       .slot =
           [](Drive& d) {
             Compensation& compensation = d.controller.compensation;
             return has_law(d) && compensation.friction != 0.0 ? Slot{&compensation.friction_speed}
                                                               : Slot{};
           },
       .dimension = &always<angular_speed>,
       .meaning = "speed of the reference from which on all of it is added; below, in "
                  "proportion",
       .permitted = Permitted::not_negative,
       .usual = {1e-4, 10.0}}};
}

std::vector<Parameter> gap_compensation() {
  return {
      {.path = "controller.backlash_compensation",
       .slot =
           [](Drive& d) { return has_law(d) ? Slot{&d.controller.compensation.backlash} : Slot{}; },
       .dimension = &always<angle>,
       .meaning = "backlash that the controller assumes, at the load's shaft: half of it is "
                  "added to the reference, or to the error",
       .permitted = Permitted::not_negative,
       .usual = {1e-5, 0.1}},
      {.path = "controller.compensation_input",
       .slot =
           [](Drive& d) {
             if (!compensates_gap(d)) return Slot{};
             return Slot{Choice{
                 [](const Drive& drive) {
                   return static_cast<std::size_t>(drive.controller.compensation.input);
                 },
                 [](Drive& drive, std::size_t choice) {
                   drive.controller.compensation.input = static_cast<CompensationInput>(choice);
                 }}};
           },
       .meaning = "gives the sign: the last motion of the reference, or the error",
       .choices = {"reference", "error"}},
      {.path = "controller.take_up_time",
       .slot =
           [](Drive& d) {
             return compensates_gap_by(d, CompensationInput::reference)
                        ? Slot{&d.controller.compensation.take_up_time}
                        : Slot{};
           },
       .dimension = &always<time>,
       .meaning = "time constant in which the addition changes sides; 0: at once",
       .permitted = Permitted::not_negative,
       .usual = {1e-3, 1.0}},
      {.path = "controller.take_up_angle",
       .slot =
           [](Drive& d) {
             return compensates_gap_by(d, CompensationInput::error)
                        ? Slot{&d.controller.compensation.take_up_angle}
                        : Slot{};
           },
       .dimension = &always<angle>,
       .meaning = "error from which on all of the half is added; below, in proportion",
       .permitted = Permitted::positive,
       .is_required = true,
       .usual = {1e-5, 0.1}}};
}

}  // namespace

std::vector<Parameter> nonlinear_parameters() {
  std::vector<Parameter> list;
  for (auto* part :
       {&relay_parameters, &dead_band_parameters, &friction_compensation, &gap_compensation}) {
    for (Parameter& parameter : (*part)()) list.push_back(std::move(parameter));
  }
  return list;
}

}  // namespace gearlash
