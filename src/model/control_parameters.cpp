// Parameters of the sensors, the controller and its sampling.
#include <numbers>

#include "model/firmware.hpp"
#include "model/parameter_list.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::parameter_rows {
namespace {

// ---- sensors ------------------------------------------------------------------------------------

std::size_t position_shaft(const Drive& drive) {
  return static_cast<std::size_t>(drive.sensor.position);
}
void choose_position_shaft(Drive& drive, std::size_t choice) {
  drive.sensor.position = static_cast<SensorPlace>(choice);
  drive.sensor.is_assumed = false;
}

std::size_t speed_shaft(const Drive& drive) {
  if (drive.sensor.speed) return static_cast<std::size_t>(*drive.sensor.speed);
  return drive.sensor.position == SensorPlace::load ? 0 : 1;
}
void choose_speed_shaft(Drive& drive, std::size_t choice) {
  drive.sensor.speed = static_cast<ShaftName>(choice);
}

/// Without the member `rival`, in whose place `member` stands.
template <auto encoder, auto member, auto rival>
Slot in_encoder(Drive& drive) {
  return drive.sensor.*encoder.*rival ? Slot{} : at<&Drive::sensor, encoder, member>(drive);
}

template <auto encoder>
constexpr Place encoder_counts =
    in_encoder<encoder, &Encoder::counts_per_turn, &Encoder::resolution>;
template <auto encoder>
constexpr Place encoder_resolution =
    in_encoder<encoder, &Encoder::resolution, &Encoder::counts_per_turn>;

constexpr OtherForm in_bits(std::string_view path) { return {path, Relation::power_of_two}; }
/// Both edges of two channels are counted.
constexpr OtherForm in_lines(std::string_view path) {
  return {path, Relation::multiple, nullptr, 4.0};
}

std::vector<Parameter> sensor_parameters() {
  return {
      entry("sensor.position", choice_by<position_shaft, choose_position_shaft>,
            "shaft with the position sensor; both: position of the load, speed of the motor",
            Words{"load", "motor", "both"}, OtherForm{"loop.sensor"}),
      entry("sensor.speed", choice_by<speed_shaft, choose_speed_shaft>,
            "shaft of the speed feedback", Words{"load", "motor"}),
      entry("sensor.counts_per_turn", encoder_counts<&Sensor::encoder>,
            "counts of the encoder per turn of its own shaft; none: exact", positive,
            in_bits("sensor.bits"), in_lines("sensor.lines"), UsualRange{100.0, 1e7}),
      entry("sensor.resolution", encoder_resolution<&Sensor::encoder>,
            "angle of one count of the encoder, at its own shaft; none: exact", unit<angle>,
            not_negative, UsualRange{1e-7, 0.1}),
      entry("sensor.speed_counts_per_turn", encoder_counts<&Sensor::speed_encoder>,
            "counts per turn of the encoder that gives the speed by differences", positive,
            in_bits("sensor.speed_bits"), in_lines("sensor.speed_lines"), UsualRange{100.0, 1e7}),
      entry("sensor.speed_resolution", encoder_resolution<&Sensor::speed_encoder>,
            "angle of one count of the encoder that gives the speed by differences", unit<angle>,
            not_negative, UsualRange{1e-7, 0.1})};
}

// ---- kinds of controllers -----------------------------------------------------------------------

constexpr std::size_t cascade = 4;  // in the list of kinds, after P, PD, PI, PID

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
  Parameter kind =
      entry("controller.kind", only_if<is_plant, choice_by<kind_of, choose_kind>>,
            "law that computes the output from the error, or a motor's firmware", required,
            Words{"P", "PD", "PI", "PID", "cascade", "lead-lag", "transfer-function", "state-space",
                  "relay"});
  for (const FirmwareFacts& firmware : all_firmwares()) kind.choices.push_back(firmware.word);
  for (const RefusedFirmware& refused : refused_firmwares()) {
    kind.refused_words.push_back({refused.word, refused.reason});
  }
  return kind;
}

std::vector<Parameter> kind_parameters() {
  return {controller_kind(),
          entry("controller.shaft", in_controller_if<has_law, &Controller::shaft>,
                "shaft of the torques and angles in the gains; mixed: torque of the motor per "
                "angle of the load",
                Words{"load", "motor", "mixed"})};
}

// ---- laws ---------------------------------------------------------------------------------------

constexpr DimensionRule gain = unit_by_motor<torque_per_angle, voltage_per_angle>;
constexpr DimensionRule integral_gain =
    unit_by_motor<torque_per_angle_and_time, voltage_per_angle_and_time>;
constexpr DimensionRule speed_gain = unit_by_motor<torque_per_speed, voltage_per_speed>;

/// Whether the law is a PID controller with these terms, or with all.
template <PIDTerms terms>
bool has_terms(const Drive& drive) {
  const auto* pid = std::get_if<PID>(&drive.controller.law);
  return has_law(drive) && pid != nullptr && (pid->terms == terms || pid->terms == PIDTerms::PID);
}

template <auto member>
constexpr Place in_integral = only_if<has_terms<PIDTerms::PI>, in_law<member>>;
template <auto member>
constexpr Place in_derivative = only_if<has_terms<PIDTerms::PD>, in_law<member>>;

/// Of a gain: gain/time is that of the integral.
constexpr OtherForm integral_time(std::string_view path, std::string_view gain) {
  return {path, Relation::reciprocal, &dimensions::time, 1.0, gain};
}
constexpr OtherForm derivative_time(std::string_view path) {
  return {path, Relation::multiple, &dimensions::time, 1.0, "controller.proportional"};
}

std::vector<Parameter> law_parameters() {
  return {
      entry("controller.proportional", in_law<&PID::proportional>,
            "proportional gain, output per error", gain, required, OtherForm{"loop.error_gain"},
            OtherForm{"controller.kp"}, OtherForm{"controller.Kp"}, OtherForm{"actuator.kp"},
            UsualRange{1e-3, 1e4}),
      entry("controller.integral", in_integral<&PID::integral>, "output per integral of the error",
            integral_gain, required, OtherForm{"controller.ki"}, OtherForm{"controller.Ki"},
            integral_time("controller.Tn", "controller.proportional"),
            integral_time("controller.Ti", "controller.proportional"), UsualRange{1e-3, 1e5}),
      entry("controller.tracking_time",
            first_of<in_integral<&PID::tracking_time>, in_law<&CascadeController::tracking_time>>,
            "anti-windup by back-calculation: its time constant; 0: none", unit<time>, not_negative,
            UsualRange{1e-3, 10.0}),
      entry("controller.derivative", in_derivative<&PID::derivative>,
            "output per rate of the error", speed_gain, required, OtherForm{"controller.kd"},
            OtherForm{"controller.Kd"}, OtherForm{"actuator.kv"}, derivative_time("controller.Tv"),
            derivative_time("controller.Td"), UsualRange{1e-4, 1e3}),
      entry("controller.filter",
            first_of<in_derivative<&PID::filter>, in_law<&CascadeController::filter>>,
            "time constant of the filter of the derivative, or of a cascade's measured "
            "speed; 0: none",
            unit<time>, not_negative, UsualRange{1e-4, 0.1}),
      entry("controller.derivative_of", in_derivative<&PID::derivative_of_speed>,
            "input of the derivative: the error, or the measured speed", Words{"error", "speed"}),

      entry("controller.position", in_law<&CascadeController::position>,
            "commanded speed per position error", unit<rate>, required, OtherForm{"controller.Kv"},
            OtherForm{"controller.kv"}, UsualRange{0.1, 1000.0}),
      entry("controller.speed", in_law<&CascadeController::speed>, "output per speed error",
            speed_gain, required, OtherForm{"controller.Kp"}, OtherForm{"controller.kp"},
            UsualRange{1e-4, 1e3}),
      entry("controller.speed_integral", in_law<&CascadeController::speed_integral>,
            "output per integral of the speed error", gain, OtherForm{"controller.Ki"},
            OtherForm{"controller.ki"}, integral_time("controller.Tn", "controller.speed"),
            integral_time("controller.Ti", "controller.speed"), UsualRange{1e-3, 1e4}),
      entry("controller.speed_limit", in_law<&CascadeController::speed_limit>,
            "largest speed that the position controller asks for; none: no limit",
            unit<angular_speed>, positive, UsualRange{0.1, 1000.0}),
      entry("controller.speed_feedforward", in_law<&CascadeController::speed_feedforward>,
            "share of the reference's speed that is added to the speed asked for", share,
            Wanted{"a number from 0 to 1, or in percent"}, UsualRange{0.0, 1.0, false}),
      entry("controller.acceleration_feedforward",
            in_law<&CascadeController::acceleration_feedforward>,
            "output per acceleration of the reference",
            unit_by_motor<torque_per_acceleration, voltage_per_acceleration>, not_negative,
            UsualRange{1e-5, 10.0}),
      entry("controller.gain",
            first_of<in_law<&LeadLagController::gain>, in_law<&TransferFunctionController::gain>,
                     in_law<&StateSpaceController::gain>>,
            "output per error, before the controller's dynamics", gain, required,
            UsualRange{1e-3, 1e4}),
      entry("controller.zero", in_law<&LeadLagController::zero>, "frequency of the zero",
            unit<angular_frequency>, positive, required, UsualRange{0.1, 1e4}),
      entry("controller.pole", in_law<&LeadLagController::pole>, "frequency of the pole",
            unit<angular_frequency>, positive, required, UsualRange{0.1, 1e5})};
}

constexpr Wanted coefficients{
    "a list of numbers, the coefficients by descending powers, such as [1, 2.5]"};

std::vector<Parameter> matrix_parameters() {
  return {entry("controller.num", in_law<&TransferFunctionController::numerator>,
                "coefficients of the numerator by descending powers", required, coefficients),
          entry("controller.den", in_law<&TransferFunctionController::denominator>,
                "coefficients of the denominator by descending powers", required, coefficients),
          entry("controller.variable", in_law<&TransferFunctionController::is_sampled>,
                "variable of the transfer function: s, or z if it is sampled", Words{"s", "z"}),
          entry("controller.A", in_law<&StateSpaceController::A>, "state matrix", required,
                Wanted{"a list of rows of numbers"}),
          entry("controller.B", in_law<&StateSpaceController::B>,
                "input matrix, for the error or for r, y and v", required,
                Wanted{"a list of rows of 1 or 3 numbers"}),
          entry("controller.C", in_law<&StateSpaceController::C>, "output row", required,
                Wanted{"a list of numbers, one for each state"}),
          entry("controller.D", in_law<&StateSpaceController::D>,
                "direct row, for the error or for r, y and v", required,
                Wanted{"a list of 1 or 3 numbers"})};
}

// ---- tachometer, sampling -----------------------------------------------------------------------

template <auto member>
constexpr Place in_sampling = at<&Drive::sampling, member>;

bool is_sampled(const Drive& drive) { return drive.sampling.has_value(); }

bool may_have_two_rates(const Drive& drive) { return is_sampled(drive) && is_cascade(drive); }

std::size_t speed_source(const Drive& drive) {
  return drive.sampling->speed_by_differences ? 0 : 1;
}
void choose_speed_source(Drive& drive, std::size_t choice) {
  drive.sampling->speed_by_differences = choice == 0;
}

std::vector<Parameter> feedback_and_sampling() {
  constexpr double turn = 2.0 * std::numbers::pi;
  return {
      entry("controller.motor_speed_feedback",
            in_controller_if<is_plant, &Controller::motor_speed_feedback>,
            "feedback of the motor's speed by a tachometer, beside the law", speed_gain,
            not_negative, OtherForm{"loop.motor_speed_feedback"}, UsualRange{1e-4, 10.0}),
      entry("sampling.period", in_sampling<&Sampling::period>, "time between two samples",
            unit<time>, positive, required,
            OtherForm{"sampling.frequency", Relation::reciprocal, &angular_frequency, turn},
            OtherForm{"sampling.rate", Relation::reciprocal, &angular_frequency, turn},
            OtherForm{"actuator.timestep"}, UsualRange{1e-5, 0.1}),
      entry(
          "sampling.position_period",
          only_if<may_have_two_rates, in_sampling<&Sampling::position_period>>,
          "time between two samples of a cascade's position controller, a whole multiple of the "
          "period; none: the period",
          unit<time>, positive,
          OtherForm{"sampling.position_frequency", Relation::reciprocal, &angular_frequency, turn},
          OtherForm{"sampling.position_rate", Relation::reciprocal, &angular_frequency, turn},
          UsualRange{1e-5, 0.1}),
      entry("sampling.delay", in_sampling<&Sampling::delay>, "time from reading to output",
            unit<time>, not_negative, UsualRange{1e-6, 0.1}),
      entry("sampling.method", in_sampling<&Sampling::method>,
            "method that replaces d/dt in the controller", Words{"tustin", "backward", "forward"}),
      entry("sampling.speed", only_if<is_sampled, choice_by<speed_source, choose_speed_source>>,
            "source of the speed: differences of the position, or a tachometer",
            Words{"differences", "tachometer"})};
}

}  // namespace

std::vector<Parameter> control_parameters() {
  return joined({&sensor_parameters, &kind_parameters, &law_parameters, &matrix_parameters,
                 &nonlinear_parameters, &firmware_parameters, &feedback_and_sampling});
}

}  // namespace gearlash::parameter_rows
