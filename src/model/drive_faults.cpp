#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/decimal.hpp"
#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "gearlash/bounds.hpp"
#include "model/controller_forms.hpp"
#include "model/firmware.hpp"
#include "model/parameters.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "numeric/transfer_function.hpp"

namespace gearlash {
namespace {

/// The path of a parameter by its name in drive::faults().
std::string path_of(const std::string& name) {
  static const std::vector<std::pair<std::string, std::string>> names = {
      {"backlash", "gearbox.backlash"},
      {"error_shape.hysteresis", "controller.hysteresis"},
      {"controller.denominator", "controller.den"},
      {"controller.state_matrix", "controller.A"},
      {"controller.input_matrix", "controller.B"},
      {"controller.output", "controller.C"},
      {"controller.direct", "controller.D"}};
  for (const auto& [from, to] : names) {
    if (name == from) return to;
    // Elements of lists: "controller.numerator[1]".
    if (name.starts_with(from + "[")) return to + name.substr(from.size());
  }
  return name;
}

}  // namespace

void check_number(RangeCheck& check, const Parameter& parameter, double value,
                  std::string_view unit) {
  switch (parameter.permitted) {
    case Permitted::anything:
      check.finite(parameter.path, value);
      break;
    case Permitted::positive:
      check.positive(parameter.path, value, unit);
      break;
    case Permitted::not_negative:
      check.not_negative(parameter.path, value, unit);
      break;
    case Permitted::share:
      check.within(parameter.path, value, 0.0, 1.0);
      break;
    case Permitted::of_normal_form:  // faults(NormalizedServo) knows it
      break;
  }
}

namespace {

void check_breakaway(RangeCheck& check, const Friction& friction, double coulomb,
                     const std::string& shaft, const std::string& least) {
  if (!friction.breakaway || *friction.breakaway >= coulomb) return;
  check.refuse(shaft + ".breakaway", exact_text(*friction.breakaway) + " N m",
               "must be at least " + least + ", " + rounded_text(coulomb, 6) +
                   " N m: a shaft at rest is not easier to move than a moving one");
}

/// Of dry friction and torque limit, each is given once.
void check_torques(RangeCheck& check, const Drive& drive) {
  const Motor& motor = drive.motor;
  const double coulomb = coulomb_torque(motor);
  const bool is_by_current = motor.no_load_current && takes_no_load_current(motor);
  check_breakaway(
      check, motor.friction, coulomb, "motor",
      is_by_current ? "motor.torque_constant * motor.no_load_current" : "motor.coulomb");
  check_breakaway(check, drive.load.friction, drive.load.friction.coulomb, "load", "load.coulomb");
  if (motor.limit && motor.current_limit && limits_torque_by_current(motor)) {
    check.refuse("motor.torque_limit", exact_text(*motor.limit) + " N m",
                 "must be left out beside motor.current_limit, which gives it");
  }
  if (is_by_current && motor.friction.coulomb != 0.0) {
    check.refuse("motor.coulomb", exact_text(motor.friction.coulomb) + " N m",
                 "must be 0 beside motor.no_load_current, which gives it");
  }
}

void check_specification(RangeCheck& check, const Drive& drive) {
  if (drive.specification.step == 0.0) {
    check.refuse("specification.step", "0 rad", "must be an angle other than 0");
  }
}

void check_normal_form(RangeCheck& check, const Drive& drive) {
  const auto* rigid = std::get_if<RigidContact>(&drive.contact);
  const double restitution = rigid == nullptr ? 0.0 : rigid->restitution;
  for (Fault fault : faults(servo_with_restitution(*drive.servo, restitution))) {
    if (fault.path == "restitution") continue;  // checked as a share
    fault.path = "servo." + fault.path;
    check.include({fault});
  }
}

/// Whether the closed form alone applies: a motor driven by a voltage, a side without inertia, or
/// no gap.
bool must_be_a_servo(const Drive& drive, const drive::ReducedDrive& reduced) {
  const bool has_voltage = !std::holds_alternative<TorqueControl>(drive.motor.kind);
  return has_voltage || reduced.motor.inertia == 0.0 || reduced.load.inertia == 0.0 ||
         reduced.backlash == 0.0;
}

/// Whether a controller receives nothing but the error, and a speed. That two rounded numbers are
/// opposite is not known.
bool acts_on_error(const Drive& drive) {
  const auto* system = std::get_if<StateSpaceController>(&drive.controller.law);
  if (system == nullptr) return true;
  const auto is_of_error = [&](const std::vector<double>& row) {
    return row.size() != 3 || (row[0] == -row[1] && (!drive.is_rounded || row[0] == 0.0));
  };
  return is_of_error(system->D) && all_of(system->B, is_of_error);
}

/// Dead bands, and compensations of the error.
void check_error_shape(RangeCheck& check, const Drive& drive) {
  if (drive.servo) return;
  const Controller& controller = drive.controller;
  const DeadBand& band = controller.dead_band;
  const bool is_relay = std::holds_alternative<RelayController>(controller.law);
  const bool is_band = !is_relay && band.width > 0.0;
  const bool of_error = controller.compensation.backlash != 0.0 &&
                        controller.compensation.input == CompensationInput::error;
  if (of_error && (is_band || is_relay)) {
    check.refuse("controller.backlash_compensation",
                 exact_text(controller.compensation.backlash) + " rad",
                 is_relay ? "must follow the reference: a relay receives no error to add to"
                          : "must follow the reference, or controller.dead_band be 0: both change "
                            "the error");
  }
  const auto* cascade = std::get_if<CascadeController>(&controller.law);
  if (cascade != nullptr && cascade->speed_limit && (is_band || of_error)) {
    check.refuse("controller.speed_limit", exact_text(*cascade->speed_limit) + " rad/s",
                 std::string("must be left out, or ") +
                     (is_band ? "controller.dead_band be 0"
                              : "controller.backlash_compensation follow the reference") +
                     ": both change the error; motor.torque_limit bounds a motion too");
  }
  if ((is_band || of_error) && !acts_on_error(drive)) {
    check.refuse(is_band ? "controller.dead_band" : "controller.backlash_compensation", "",
                 "must be 0: the controller does not act on the error r - y alone");
  }
  if (is_band && band.form == DeadBandForm::whole && band.hysteresis > band.width) {
    check.refuse("controller.hysteresis", exact_text(band.hysteresis) + " rad",
                 "must be at most controller.dead_band, " + exact_text(band.width) + " rad");
  }
}

/// What a cascade alone has, and how its position controller goes with its speed controller.
void check_cascade(RangeCheck& check, const Drive& drive) {
  const auto* cascade = std::get_if<CascadeController>(&drive.controller.law);
  const bool has_law = !drive.servo && !drive.controller.firmware && cascade != nullptr;
  if (has_law && cascade->position == 0.0 && cascade->speed_feedforward != 0.0) {
    check.refuse("controller.speed_feedforward", exact_text(cascade->speed_feedforward),
                 "must be 0 beside controller.position = 0: it leads the reference that the "
                 "position controller follows");
  }
  if (!drive.sampling || !drive.sampling->position_period) return;
  const Sampling& sampling = *drive.sampling;
  const std::string value = exact_text(*sampling.position_period) + " s";
  if (!is_cascade(drive)) {
    check.refuse("sampling.position_period", value,
                 "must be left out: of the controllers a cascade alone has two, of position and of "
                 "speed");
    return;
  }
  if (!(sampling.period > 0.0 && *sampling.position_period > 0.0)) return;  // said elsewhere
  constexpr double rounding = 1e-9;
  const double ticks = *sampling.position_period / sampling.period;
  const bool is_whole = std::abs(ticks - std::round(ticks)) <= rounding * ticks;
  if (is_whole && ticks >= 0.5 && ticks < drive::most_position_ticks + 0.5) return;
  const double near = std::clamp(std::round(ticks), 1.0, 1.0 * drive::most_position_ticks);
  check.refuse("sampling.position_period", value,
               "must be sampling.period, " + exact_text(sampling.period) + " s, times a whole " +
                   "number from 1 to " + std::to_string(drive::most_position_ticks) + ", such as " +
                   exact_text(near * sampling.period) + " s");
}

void check_gravity(RangeCheck& check, const Drive& drive) {
  if (drive.servo || drive.load.gravity == 0.0 || !drive.reference) return;
  if (!drive::faults(*drive.reference, "reference").empty()) return;
  if (!std::holds_alternative<RampSignal>(drive::settled(*drive.reference))) return;
  check.refuse("load.gravity", exact_text(drive.load.gravity) + " N m",
               "must be 0 with a reference that is a ramp: gravity is linearised about the angle "
               "where the reference ends");
}

/// The dry torque that holds the shaft on an encoder's edge while the controller's torque changes
/// there; empty where the torque does not act on this shaft at once.
std::optional<double> holding_friction(const drive::ReducedDrive& drive) {
  const double motor = drive.motor.friction.breakaway;
  if (drive.sensing.load_share_of_position == 0.0) return motor;
  if (!std::holds_alternative<drive::RigidContact>(drive.contact)) return std::nullopt;
  return motor + drive.load.friction.breakaway;
}

/// A continuous controller that pushes the position back over the edge of an encoder's step, from
/// either side, would switch without end: the torque of a step exceeds what friction holds either
/// way.
void check_encoder(RangeCheck& check, const Drive& drive, const drive::ReducedDrive& reduced) {
  const double step = reduced.sensing.resolution;
  if (drive.sampling || !(step > 0.0) || reduced.winding.time_constant > 0.0) return;
  const std::optional<double> held = holding_friction(reduced);
  const drive::ErrorShape& shape = reduced.error_shape;
  if (shape.is_relay() && step <= shape.begins - shape.ends) return;  // its hysteresis holds it
  const double gain = std::abs(reduced.controller.direct[1]);
  const double torque = shape.is_relay() ? 2.0 * gain : gain * step;
  if (!held || !(torque > 2.0 * *held)) return;
  const Encoder& encoder = drive.sensor.encoder;
  const bool is_counted = encoder.counts_per_turn.has_value();
  check.refuse(
      is_counted ? "sensor.counts_per_turn" : "sensor.resolution",
      exact_text(is_counted ? *encoder.counts_per_turn : encoder.resolution.value_or(step)),
      "must stand beside [sampling]: a continuous controller would switch without end at "
      "the edge of a count, where its torque changes by " +
          exact_text(torque) + " N m at the load and friction holds " + exact_text(*held) + " N m");
}

/// The sources of numbers at the load's shaft, for messages to an author who gave none of these.
struct Origin {
  std::string_view number;
  std::string_view made_of;
};
constexpr std::array origins = {
    Origin{"motor_inertia", "(motor.inertia + gearbox.inertia) * gearbox.ratio^2"},
    Origin{"motor_friction", "(motor.friction + electrical friction) * gearbox.ratio^2"},
    Origin{"stiffness", "the motor's torque per volt * loop.error_gain * gearbox.ratio"},
    Origin{"damping", "friction/(2 sqrt(stiffness * inertia)), everything at the load"},
    Origin{"inertia_ratio", "load.inertia/((motor.inertia + gearbox.inertia) * gearbox.ratio^2)"}};
/// Numbers at the load's shaft that an author gives directly, by their paths.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> given = {
    {{"backlash", "gearbox.backlash"},
     {"restitution", "contact.restitution"},
     {"sensor", "loop.sensor"},
     {"load_inertia", "load.inertia"}}};

std::vector<Fault> servo_faults(const Drivetrain& drivetrain) {
  std::vector<Fault> found = faults(drivetrain);
  for (Fault& fault : found) {
    for (const Origin& origin : origins) {
      if (fault.path == origin.number) fault.permitted += "; it is " + std::string(origin.made_of);
    }
    for (const auto& [number, path] : given) {
      if (fault.path == number) fault.path = path;
    }
  }
  const double frequency = natural_frequency(drivetrain);
  if (found.empty() && !std::isnormal(frequency)) {
    found.push_back(
        {"natural_frequency", frequency > 1.0 ? "inf rad/s" : "0 rad/s",
         "must be from 1e-308 to 1e308 rad/s: stiffness and inertias are too far apart"});
  }
  return found;
}

/// Steps so fine that positions have no digits left to count them by.
void check_counts(RangeCheck& check, const Drive& drive) {
  constexpr double most = 1099511627776.0;  // 2⁴⁰
  constexpr double least = 2.0 * std::numbers::pi / most;
  if (drive.servo) return;
  for (const auto& [encoder, prefix] : {std::pair(&drive.sensor.encoder, "sensor."),
                                        std::pair(&drive.sensor.speed_encoder, "sensor.speed_")}) {
    const std::string path = prefix;
    if (encoder->counts_per_turn && *encoder->counts_per_turn > most) {
      check.refuse(path + "counts_per_turn", exact_text(*encoder->counts_per_turn),
                   "must be at most " + exact_text(most) + ", 40 bit");
    }
    if (encoder->resolution && *encoder->resolution > 0.0 && *encoder->resolution < least) {
      check.refuse(path + "resolution", exact_text(*encoder->resolution) + " rad",
                   "must be 0 or at least " + exact_text(least) + " rad, 40 bit a turn");
    }
  }
}

/// A state-space controller has one input, the error, or three: reference, position and speed.
void check_columns(RangeCheck& check, const Drive& drive) {
  const auto* system = std::get_if<StateSpaceController>(&drive.controller.law);
  if (system == nullptr || drive.servo) return;
  const auto is_wrong = [](const std::vector<double>& row) {
    return row.size() != 1 && row.size() != 3;
  };
  constexpr char permitted[] = "must have 1 number a row, of the error, or 3, of r, y and v";
  if (any_of(system->B, is_wrong)) check.refuse("controller.B", "", permitted);
  if (is_wrong(system->D)) check.refuse("controller.D", "", permitted);
}

/// A transfer function is proper, and of no higher order than others.
std::vector<Fault> law_faults(const Drive& drive) {
  const auto* law = std::get_if<TransferFunctionController>(&drive.controller.law);
  if (law == nullptr || drive.servo) return {};
  const std::vector<double> numerator = scaled(law->gain, law->numerator);
  RangeCheck check;
  for (Fault fault : faults(TransferFunction{numerator, law->denominator})) {
    fault.path = fault.path == "numerator" ? "controller.num" : "controller.den";
    check.include({fault});
  }
  if (!check.faults().empty()) return check.faults();
  const auto degree_of = [](const std::vector<double>& coefficients) {
    return drive::forms::without_leading_zeros(coefficients).size() - 1;
  };
  const std::size_t degree = degree_of(law->denominator);
  if (degree > drive::highest_order) {
    check.refuse("controller.den", "of order " + std::to_string(degree),
                 "must be of order at most " + std::to_string(drive::highest_order) + " (order " +
                     std::to_string(degree) + ")");
  }
  if (degree_of(numerator) > degree) {
    check.refuse("controller.num", "of degree " + std::to_string(degree_of(numerator)),
                 "must be of no higher degree than the denominator (" + std::to_string(degree) +
                     "): a controller cannot differentiate its input");
  }
  return check.faults();
}

/// What can be checked of the poles of a transfer function with faults.
drive::LinearController poles_of(const Drive& drive) {
  auto law = std::get<TransferFunctionController>(drive.controller.law);
  law.gain = 1.0;
  law.numerator = {1.0};
  drive::LinearController poles = drive::forms::linear(law, AsRead(), 1.0);
  if (!law.is_sampled || !faults(poles).empty()) poles = {};
  poles.is_of_samples = law.is_sampled;
  return poles;
}

constexpr double largest_number = 1e60;
constexpr double least_divisor = 1e-60;

/// Numbers so large, or so near to 0 where they divide, that products of some are no doubles.
void check_size(RangeCheck& check, const std::string& path, double value, const Bounds& permitted,
                const std::string& unit) {
  const double size = std::abs(value);
  if (size > permitted.high && std::isfinite(size)) {
    check.refuse(path, exact_text(value) + unit,
                 "must be at most " + exact_text(permitted.high) + unit + " in size");
  }
  if (size < permitted.low) {
    check.refuse(path, exact_text(value) + unit,
                 "must be at least " + exact_text(permitted.low) + unit);
  }
}

void check_sizes(RangeCheck& check, const std::string& path, const std::vector<double>& numbers) {
  constexpr double largest = 1e100;  // coefficients are products of poles
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::abs(numbers[i]) <= largest) continue;
    check_size(check, path + "[" + std::to_string(i) + "]", numbers[i], {0.0, largest}, "");
  }
}

void check_size(RangeCheck& check, const Parameter& parameter, const Drive& drive) {
  const std::string path(parameter.path);
  const Slot slot = parameter.slot(const_cast<Drive&>(drive));
  if (auto* const* list = std::get_if<std::vector<double>*>(&slot)) {
    return check_sizes(check, path, **list);
  }
  if (auto* const* rows = std::get_if<Rows*>(&slot)) {
    for (const std::vector<double>& row : **rows) check_sizes(check, path, row);
    return;
  }
  if (parameter.permitted == Permitted::of_normal_form) return;
  const std::optional<double> number = number_in(parameter, drive);
  if (!number) return;
  const Dimension* dimension = parameter.dimension(drive);
  const std::string unit = dimension == nullptr ? "" : " " + std::string(dimension->unit);
  const bool divides = parameter.permitted == Permitted::positive ||
                       (parameter.path.ends_with(".inertia") && *number > 0.0);
  check_size(check, path, *number, {divides ? least_divisor : 0.0, largest_number}, unit);
}

/// The points of a file are no parameters; those of a list were checked.
void check_table(RangeCheck& check, const std::string& section,
                 const std::optional<Signal>& signal) {
  const auto* table = signal ? std::get_if<TableSignal>(&*signal) : nullptr;
  if (table == nullptr || table->file.empty()) return;
  for (const std::vector<double>* numbers : {&table->times, &table->values}) {
    const double* large =
        first_of(*numbers, [](double number) { return std::abs(number) > largest_number; });
    if (large == nullptr) continue;
    check.refuse(section + ".file", table->file,
                 "must hold numbers of at most " + exact_text(largest_number) + " in size, not " +
                     exact_text(*large));
  }
}

/// Of a drive that is computed as a hybrid system; the closed form has no such limits.
std::vector<Fault> faults_of_size(const Drive& drive) {
  RangeCheck check;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (exists(parameter, drive)) check_size(check, parameter, drive);
  }
  check_table(check, "reference", drive.reference);
  check_table(check, "load_torque", drive.load_torque);
  return check.faults();
}

/// Rules that join several numbers. `reduced`: reduce() of the drive.
std::vector<Fault> joint_faults(const Drive& drive, drive::ReducedDrive reduced) {
  const std::vector<Fault> of_law = law_faults(drive);
  const bool is_sound = of_law.empty() && faults(reduced.controller).empty();
  if (must_be_a_servo(drive, reduced) && is_sound) {
    if (const auto drivetrain = drive::proportional_drivetrain(reduced)) {
      return servo_faults(*drivetrain);
    }
  }
  std::vector<Fault> found = faults_of_size(drive);
  if (!found.empty()) return found;
  if (!of_law.empty()) reduced.controller = poles_of(drive);
  found = drive::faults(reduced);
  found.insert(found.begin(), of_law.begin(), of_law.end());
  if (found.empty()) {
    RangeCheck encoder;
    check_encoder(encoder, drive, reduced);
    found = encoder.faults();
  }
  for (Fault& fault : found) fault.path = path_of(fault.path);
  return found;
}

}  // namespace

std::vector<Fault> faults(const Drive& drive) {
  drive::ReducedDrive reduced;
  return faults(drive, reduced);
}

std::vector<Fault> faults(const Drive& drive, drive::ReducedDrive& reduced) {
  RangeCheck check;
  Drive mended = drive;  // without the faults of single numbers, which would cause others
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (!exists(parameter, drive)) continue;
    const std::optional<double> value = number_in(parameter, drive);
    if (!value) continue;
    const Dimension* dimension = parameter.dimension(drive);
    const std::size_t before = check.faults().size();
    check_number(check, parameter, *value, dimension == nullptr ? "" : dimension->unit);
    if (check.faults().size() == before) continue;
    if (double* number = given_number(parameter.slot(mended))) *number = 0.5;  // in every range
  }
  check_torques(check, drive);
  check_specification(check, drive);
  check_error_shape(check, drive);
  check_cascade(check, drive);
  check_gravity(check, drive);
  check_columns(check, drive);
  check_counts(check, drive);
  check.include(firmware_faults(drive));
  if (drive.servo) check_normal_form(check, drive);
  std::vector<Fault> found = check.faults();
  if (!found.empty() && drive.servo) return found;
  reduced = reduce(mended);
  for (Fault& fault : joint_faults(mended, reduced)) {
    const auto is_known = [&](const Fault& other) { return other.path == fault.path; };
    if (!any_of(found, is_known)) found.push_back(std::move(fault));
  }
  return found;
}

Drive normal_form(double damping, double inertia_ratio, double friction_ratio, double backlash,
                  double restitution) {
  Drive drive;
  drive.servo = NormalForm{.damping = damping,
                           .inertia_ratio = inertia_ratio,
                           .friction_ratio = friction_ratio,
                           .backlash = backlash};
  drive.contact = RigidContact{restitution};
  return drive;
}

}  // namespace gearlash
