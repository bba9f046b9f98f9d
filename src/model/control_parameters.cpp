#include <numbers>

#include "model/firmware.hpp"
#include "model/parameter_list.hpp"

namespace gearlash {
namespace {

using namespace dimensions;

// ---- sensors ------------------------------------------------------------------------------------

std::size_t speed_shaft(const Drive& drive) {
  if (drive.sensor.speed) return static_cast<std::size_t>(*drive.sensor.speed);
  return drive.sensor.position == SensorPlace::load ? 0 : 1;
}

std::vector<Parameter> sensor_parameters() {
  return {
      {.path = "sensor.position",
       .slot =
           [](Drive&) {
             return Slot{Choice{
                 [](const Drive& drive) { return static_cast<std::size_t>(drive.sensor.position); },
                 [](Drive& drive, std::size_t choice) {
                   drive.sensor.position = static_cast<SensorPlace>(choice);
                   drive.sensor.is_assumed = false;
                 }}};
           },
       .meaning = "shaft with the position sensor; both: position of the load, speed of the motor",
       .choices = {"load", "motor", "both"},
       .other_forms = {{"loop.sensor"}}},
      {.path = "sensor.speed",
       .slot =
           [](Drive&) {
             return Slot{Choice{&speed_shaft, [](Drive& drive, std::size_t choice) {
                                  drive.sensor.speed = static_cast<ShaftName>(choice);
                                }}};
           },
       .meaning = "shaft of the speed feedback",
       .choices = {"load", "motor"}}};
}

std::vector<Parameter> encoder_parameters() {
  return {
      {.path = "sensor.counts_per_turn",
       .slot =
           [](Drive& d) {
             return d.sensor.encoder.resolution ? Slot{} : Slot{&d.sensor.encoder.counts_per_turn};
           },
       .meaning = "counts of the encoder per turn of its own shaft; none: exact",
       .permitted = Permitted::positive,
       .usual = {100.0, 1e7}},
      {.path = "sensor.resolution",
       .slot =
           [](Drive& d) {
             return d.sensor.encoder.counts_per_turn ? Slot{} : Slot{&d.sensor.encoder.resolution};
           },
       .dimension = &always<angle>,
       .meaning = "angle of one count of the encoder, at its own shaft; none: exact",
       .permitted = Permitted::not_negative,
       .usual = {1e-7, 0.1}},
      {.path = "sensor.speed_counts_per_turn",
       .slot =
           [](Drive& d) {
             return d.sensor.speed_encoder.resolution
                        ? Slot{}
                        : Slot{&d.sensor.speed_encoder.counts_per_turn};
           },
       .meaning = "counts per turn of the encoder that gives the speed by differences",
       .permitted = Permitted::positive,
       .usual = {100.0, 1e7}},
      {.path = "sensor.speed_resolution",
       .slot =
           [](Drive& d) {
             return d.sensor.speed_encoder.counts_per_turn
                        ? Slot{}
                        : Slot{&d.sensor.speed_encoder.resolution};
           },
       .dimension = &always<angle>,
       .meaning = "angle of one count of the encoder that gives the speed by differences",
       .permitted = Permitted::not_negative,
       .usual = {1e-7, 0.1}}};
}

// ---- controllers --------------------------------------------------------------------------------

bool is_torque(const Drive& drive) {
  return std::holds_alternative<TorqueControl>(drive.motor.kind);
}
const Dimension* gain_dimension(const Drive& drive) {
  return is_torque(drive) ? &torque_per_angle : &voltage_per_angle;
}
const Dimension* integral_dimension(const Drive& drive) {
  return is_torque(drive) ? &torque_per_angle_and_time : &voltage_per_angle_and_time;
}
const Dimension* speed_gain_dimension(const Drive& drive) {
  return is_torque(drive) ? &torque_per_speed : &voltage_per_speed;
}

constexpr std::size_t cascade = 4;  // in the list of kinds, after P, PD, PI, PID

/// The alternative of that index, with its defaults.
template <class... Laws>
void become(std::variant<Laws...>& law, std::size_t which) {
  const std::variant<Laws...> all[] = {Laws{}...};
  law = all[which];
}

using Law = decltype(Controller::law);
constexpr std::size_t firmwares = cascade + std::variant_size_v<Law> - 1;  // in the same list

std::size_t kind_of(const Drive& drive) {
  const Controller& controller = drive.controller;
  if (controller.firmware) return firmwares + controller.firmware->index();
  const auto* pid = std::get_if<PID>(&controller.law);
  return pid != nullptr ? static_cast<std::size_t>(pid->terms)
                        : controller.law.index() + cascade - 1;
}

/// Keeps the numbers that both have.
PID with_terms(PID pid, PIDTerms terms) {
  const bool integrates = terms == PIDTerms::PI || terms == PIDTerms::PID;
  const bool differentiates = terms == PIDTerms::PD || terms == PIDTerms::PID;
  pid.terms = terms;
  if (!integrates) pid.integral = pid.tracking_time = 0.0;
  if (!differentiates) {
    pid.derivative = pid.filter = 0.0;
    pid.derivative_of_speed = false;
  }
  return pid;
}

void choose_kind(Drive& drive, std::size_t choice) {
  if (choice == kind_of(drive)) return;
  if (choice >= firmwares) {
    drive.controller = {};
    return take_firmware(drive, choice - firmwares);
  }
  drive.controller.firmware.reset();
  Law& law = drive.controller.law;
  if (choice < cascade) {
    const PID* present = std::get_if<PID>(&law);
    law = with_terms(present != nullptr ? *present : PID{}, static_cast<PIDTerms>(choice));
  } else {
    become(law, choice - cascade + 1);
  }
}

/// The laws after the PID ones are in the order of Controller::law, the firmwares after them.
Parameter controller_kind() {
  Parameter kind{.path = "controller.kind",
                 .slot =
                     [](Drive& d) {
                       return d.servo ? Slot{} : Slot{Choice{&kind_of, &choose_kind}};
                     },
                 .meaning = "law that computes the output from the error, or a motor's firmware",
                 .is_required = true,
                 .choices = {"P", "PD", "PI", "PID", "cascade", "lead-lag", "transfer-function",
                             "state-space", "relay"}};
  for (const FirmwareFacts& firmware : all_firmwares()) kind.choices.push_back(firmware.word);
  for (const RefusedFirmware& refused : refused_firmwares()) {
    kind.refused_words.push_back({refused.word, refused.reason});
  }
  return kind;
}

Parameter controller_shaft() {
  return {.path = "controller.shaft",
          .slot =
              [](Drive& d) {
                if (!has_law(d)) return Slot{};
                return Slot{Choice{[](const Drive& drive) {
                                     return static_cast<std::size_t>(drive.controller.shaft);
                                   },
                                   [](Drive& drive, std::size_t choice) {
                                     drive.controller.shaft = static_cast<GainShaft>(choice);
                                   }}};
              },
          .meaning =
              "shaft of the torques and angles in the gains; mixed: torque of the motor per "
              "angle of the load",
          .choices = {"load", "motor", "mixed"}};
}

template <class Law, class Member>
Slot of_law(Drive& drive, Member Law::*member) {
  return has_law(drive) ? slot_of(drive.controller.law, member) : Slot{};
}

/// A member of a PID controller that has one of two sets of terms.
template <class Member>
Slot of_terms(Drive& drive, Member PID::*member, PIDTerms with) {
  const auto* pid = std::get_if<PID>(&drive.controller.law);
  const bool has_it = pid != nullptr && (pid->terms == with || pid->terms == PIDTerms::PID);
  return has_it ? of_law(drive, member) : Slot{};
}

Slot input_of_derivative(Drive& d) {
  const Slot filter = of_terms(d, &PID::filter, PIDTerms::PD);
  if (std::holds_alternative<std::monostate>(filter)) return Slot{};
  return Choice{[](const Drive& drive) {
                  const PID& pid = std::get<PID>(drive.controller.law);
                  return static_cast<std::size_t>(pid.derivative_of_speed);
                },
                [](Drive& drive, std::size_t choice) {
                  std::get<PID>(drive.controller.law).derivative_of_speed = choice == 1;
                }};
}

std::vector<Parameter> pid_parameters() {
  return {{.path = "controller.proportional",
           .slot = [](Drive& d) { return of_law(d, &PID::proportional); },
           .dimension = &gain_dimension,
           .meaning = "proportional gain, output per error",
           .is_required = true,
           .other_forms = {{"loop.error_gain"}, {"controller.kp"}, {"actuator.kp"}},
           .usual = {1e-3, 1e4}},
          {.path = "controller.integral",
           .slot = [](Drive& d) { return of_terms(d, &PID::integral, PIDTerms::PI); },
           .dimension = &integral_dimension,
           .meaning = "output per integral of the error",
           .is_required = true,
           .other_forms = {{"controller.ki"}},
           .usual = {1e-3, 1e5}},
          {.path = "controller.tracking_time",
           .slot =
               [](Drive& d) {
                 const Slot pid = of_terms(d, &PID::tracking_time, PIDTerms::PI);
                 return std::holds_alternative<std::monostate>(pid)
                            ? of_law(d, &CascadeController::tracking_time)
                            : pid;
               },
           .dimension = &always<time>,
           .meaning = "anti-windup by back-calculation: its time constant; 0: none",
           .permitted = Permitted::not_negative,
           .usual = {1e-3, 10.0}},
          {.path = "controller.derivative",
           .slot = [](Drive& d) { return of_terms(d, &PID::derivative, PIDTerms::PD); },
           .dimension = &speed_gain_dimension,
           .meaning = "output per rate of the error",
           .is_required = true,
           .other_forms = {{"controller.kd"}, {"actuator.kv"}},
           .usual = {1e-4, 1e3}},
          {.path = "controller.filter",
           .slot =
               [](Drive& d) {
                 const Slot pid = of_terms(d, &PID::filter, PIDTerms::PD);
                 return std::holds_alternative<std::monostate>(pid)
                            ? of_law(d, &CascadeController::filter)
                            : pid;
               },
           .dimension = &always<time>,
           .meaning = "time constant of the filter of the derivative, or of a cascade's measured "
                      "speed; 0: none",
           .permitted = Permitted::not_negative,
           .usual = {1e-4, 0.1}},
          {.path = "controller.derivative_of",
           .slot = &input_of_derivative,
           .meaning = "input of the derivative: the error, or the measured speed",
           .choices = {"error", "speed"}}};
}

std::vector<Parameter> other_laws() {
  return {{.path = "controller.position",
           .slot = [](Drive& d) { return of_law(d, &CascadeController::position); },
           .dimension = &always<rate>,
           .meaning = "commanded speed per position error",
           .is_required = true,
           .usual = {0.1, 1000.0}},
          {.path = "controller.speed",
           .slot = [](Drive& d) { return of_law(d, &CascadeController::speed); },
           .dimension = &speed_gain_dimension,
           .meaning = "output per speed error",
           .is_required = true,
           .usual = {1e-4, 1e3}},
          {.path = "controller.speed_integral",
           .slot = [](Drive& d) { return of_law(d, &CascadeController::speed_integral); },
           .dimension = &gain_dimension,
           .meaning = "output per integral of the speed error",
           .usual = {1e-3, 1e4}},
          {.path = "controller.gain",
           .slot =
               [](Drive& d) {
                 if (!has_law(d)) return Slot{};
                 return std::visit(
                     [](auto& law) {
                       if constexpr (requires { law.gain; }) {
                         return Slot{&law.gain};
                       } else {
                         return Slot{};
                       }
                     },
                     d.controller.law);
               },
           .dimension = &gain_dimension,
           .meaning = "output per error, before the controller's dynamics",
           .is_required = true,
           .usual = {1e-3, 1e4}},
          {.path = "controller.zero",
           .slot = [](Drive& d) { return of_law(d, &LeadLagController::zero); },
           .dimension = &always<angular_frequency>,
           .meaning = "frequency of the zero",
           .permitted = Permitted::positive,
           .is_required = true,
           .usual = {0.1, 1e4}},
          {.path = "controller.pole",
           .slot = [](Drive& d) { return of_law(d, &LeadLagController::pole); },
           .dimension = &always<angular_frequency>,
           .meaning = "frequency of the pole",
           .permitted = Permitted::positive,
           .is_required = true,
           .usual = {0.1, 1e5}}};
}

constexpr char coefficients[] =
    "a list of numbers, the coefficients by descending powers, such as [1, 2.5]";

std::vector<Parameter> matrix_parameters() {
  return {{.path = "controller.num",
           .slot = [](Drive& d) { return of_law(d, &TransferFunctionController::numerator); },
           .meaning = "coefficients of the numerator by descending powers",
           .is_required = true,
           .wanted = coefficients},
          {.path = "controller.den",
           .slot = [](Drive& d) { return of_law(d, &TransferFunctionController::denominator); },
           .meaning = "coefficients of the denominator by descending powers",
           .is_required = true,
           .wanted = coefficients},
          {.path = "controller.variable",
           .slot =
               [](Drive& d) {
                 const Slot member = of_law(d, &TransferFunctionController::gain);
                 if (std::holds_alternative<std::monostate>(member)) return Slot{};
                 return Slot{Choice{
                     [](const Drive& drive) {
                       return static_cast<std::size_t>(
                           std::get<TransferFunctionController>(drive.controller.law).is_sampled);
                     },
                     [](Drive& drive, std::size_t choice) {
                       std::get<TransferFunctionController>(drive.controller.law).is_sampled =
                           choice == 1;
                     }}};
               },
           .meaning = "variable of the transfer function: s, or z if it is sampled",
           .choices = {"s", "z"}},
          {.path = "controller.A",
           .slot = [](Drive& d) { return of_law(d, &StateSpaceController::A); },
           .meaning = "state matrix",
           .is_required = true,
           .wanted = "a list of rows of numbers"},
          {.path = "controller.B",
           .slot = [](Drive& d) { return of_law(d, &StateSpaceController::B); },
           .meaning = "input matrix, for the error or for r, y and v",
           .is_required = true,
           .wanted = "a list of rows of 1 or 3 numbers"},
          {.path = "controller.C",
           .slot = [](Drive& d) { return of_law(d, &StateSpaceController::C); },
           .meaning = "output row",
           .is_required = true,
           .wanted = "a list of numbers, one for each state"},
          {.path = "controller.D",
           .slot = [](Drive& d) { return of_law(d, &StateSpaceController::D); },
           .meaning = "direct row, for the error or for r, y and v",
           .is_required = true,
           .wanted = "a list of 1 or 3 numbers"}};
}

std::vector<Parameter> motor_speed_feedback() {
  return {
      {.path = "controller.motor_speed_feedback",
       .slot = [](Drive& d) { return d.servo ? Slot{} : Slot{&d.controller.motor_speed_feedback}; },
       .dimension = [](const Drive& d) -> const Dimension* {
         const bool has_torque = std::holds_alternative<TorqueControl>(d.motor.kind);
         return has_torque ? &torque_per_speed : &voltage_per_speed;
       },
       .meaning = "feedback of the motor's speed by a tachometer, beside the law",
       .permitted = Permitted::not_negative,
       .other_forms = {{"loop.motor_speed_feedback"}},
       .usual = {1e-4, 10.0}}};
}

// ---- sampling -----------------------------------------------------------------------------------

std::vector<Parameter> sampling_parameters() {
  return {{.path = "sampling.period",
           .slot = [](Drive& d) { return slot_of(d.sampling, &Sampling::period); },
           .dimension = &always<time>,
           .meaning = "time between two samples",
           .permitted = Permitted::positive,
           .is_required = true,
           .other_forms = {{"sampling.frequency", &angular_frequency, 2.0 * std::numbers::pi},
                           {"sampling.rate", &angular_frequency, 2.0 * std::numbers::pi},
                           {"actuator.timestep"}},
           .usual = {1e-5, 0.1}},
          {.path = "sampling.delay",
           .slot = [](Drive& d) { return slot_of(d.sampling, &Sampling::delay); },
           .dimension = &always<time>,
           .meaning = "time from reading to output",
           .permitted = Permitted::not_negative,
           .usual = {1e-6, 0.1}},
          {.path = "sampling.method",
           .slot =
               [](Drive& d) {
                 if (!d.sampling) return Slot{};
                 return Slot{Choice{[](const Drive& drive) {
                                      return static_cast<std::size_t>(drive.sampling->method);
                                    },
                                    [](Drive& drive, std::size_t choice) {
                                      drive.sampling->method = static_cast<Discretization>(choice);
                                    }}};
               },
           .meaning = "method that replaces d/dt in the controller",
           .choices = {"tustin", "backward", "forward"}},
          {.path = "sampling.speed",
           .slot =
               [](Drive& d) {
                 if (!d.sampling) return Slot{};
                 return Slot{Choice{[](const Drive& drive) {
                                      return std::size_t{drive.sampling->speed_by_differences ? 0U
                                                                                              : 1U};
                                    },
                                    [](Drive& drive, std::size_t choice) {
                                      drive.sampling->speed_by_differences = choice == 0;
                                    }}};
               },
           .meaning = "source of the speed: differences of the position, or a tachometer",
           .choices = {"differences", "tachometer"}}};
}

}  // namespace

std::vector<Parameter> control_parameters() {
  std::vector<Parameter> list = sensor_parameters();
  for (Parameter& parameter : encoder_parameters()) list.push_back(std::move(parameter));
  list.push_back(controller_kind());
  list.push_back(controller_shaft());
  for (auto* part : {&pid_parameters, &other_laws, &matrix_parameters, &nonlinear_parameters,
                     &firmware_parameters, &motor_speed_feedback, &sampling_parameters}) {
    for (Parameter& parameter : (*part)()) list.push_back(std::move(parameter));
  }
  return list;
}

}  // namespace gearlash
