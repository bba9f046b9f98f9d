#include "thesis/procedure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/output.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/units.hpp"
#include "model/parameters.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::thesis {
namespace {

constexpr double chart_backlash = 0.3;  ///< rad, of the charts of the thesis

std::string number(double value) { return significant(value, 6); }

// --- the data sheet ---

struct Given {
  const char* name;
  const char* symbol;
  const char* path;
};

/// Those that no motor of this kind has are left out.
constexpr Given all_given[] = {{"armature resistance", "R", "motor.resistance"},
                               {"motor generator constant", "K_2", "motor.back_emf_constant"},
                               {"torque constant", "K_1", "motor.torque_constant"},
                               {"torque per volt", "K_e", "motor.torque_per_volt"},
                               {"torque per speed", "K_N", "motor.torque_per_speed"},
                               {"motor inertia", "J_m", "motor.inertia"},
                               {"motor friction", "f_m", "motor.friction"},
                               {"error measurement constant", "K_3", "loop.error_gain"},
                               {"load inertia", "J_L", "load.inertia"},
                               {"load friction", "F_L", "load.friction"},
                               {"backlash, total", "b", "gearbox.backlash"}};

/// Volts per radian of the load.
double error_gain_of(const Drive& drive) {
  const double gain = std::get<PID>(drive.controller.law).proportional;
  return drive.controller.shaft == GainShaft::motor ? gain * drive.gearbox.ratio : gain;
}

std::string given_table(const Drive& drive, std::map<std::string, std::string> written) {
  std::size_t longest = 0;
  for (auto& [key, text] : written) {
    text = shown(text);
    longest = std::max(longest, text.size());
  }
  const bool has_field_control = std::holds_alternative<FieldControl>(drive.motor.kind);
  std::string table;
  for (const Given& given : all_given) {
    const Parameter& parameter = *find_parameter(given.path);
    if (!exists(parameter, drive)) continue;
    const bool is_gain = parameter.path == "controller.proportional";
    const double value = is_gain ? error_gain_of(drive) : get(drive, parameter.path);
    const std::string si = number(value) + " " + std::string(parameter.dimension(drive)->unit);
    const bool is_of_field = parameter.path == "motor.resistance" && has_field_control;
    const auto as_written = written.find(given.path);
    const bool is_converted = as_written != written.end() && as_written->second != si;
    table +=
        fmt::format("  {:<27} {:<4}", is_of_field ? "field resistance" : given.name, given.symbol);
    table += is_converted ? fmt::format("= {:<{}} = {}\n", as_written->second, longest, si)
                          : fmt::format("= {}\n", si);
  }
  const double ratio = drive.gearbox.ratio;
  table += fmt::format("  {:<27} {:<4}= {}, the thesis's P = 1/n = {}\n",
                       "motor turns per load turn", "n", number(ratio), number(1.0 / ratio));
  return table;
}

// --- the steps ---

class Steps {
 public:
  void add(const std::string& title, const std::string& line) {
    text_ += fmt::format("{:>3}. {}\n       {}\n", ++count_, title, line);
  }
  /// "symbol = formula", and below it the same with these numbers in their places.
  template <class... Numbers>
  void add(const std::string& title, const std::string& symbol, const std::string& formula,
           const std::string& places, const Numbers&... numbers) {
    add(title, symbol + " = " + formula);
    more(std::string(width_in_columns(symbol), ' ') + " = " +
         fmt::format(fmt::runtime(places), number(numbers)...));
  }
  /// A further line of the step before.
  void more(const std::string& line) { text_ += "       " + line + "\n"; }
  const std::string& text() const { return text_; }

 private:
  int count_ = 0;
  std::string text_;
};

/// Values that several steps need.
struct Known {
  explicit Known(const Drive& of) : drive(of) {}

  const Drive& drive;
  Drivetrain drivetrain = referred_drivetrain(drive);
  NormalizedServo servo = normalize(drivetrain);
  double frequency = natural_frequency(drivetrain);
  double electrical_friction = refer_output(drive).friction;
  double motor_friction = drive.motor.friction.viscous;

  double ratio() const { return drive.gearbox.ratio; }
  double mechanical_friction() const {
    return drivetrain.load_friction + motor_friction * (ratio() * ratio());
  }
  double total_friction() const { return mechanical_friction() + electrical_friction; }
};

void add_stiffness(Steps& steps, double torque_constant, double resistance, const Known& known) {
  steps.add("Loop stiffness at the load shaft", "K", "K_1 K_3 n/R", "{} × {} × {}/{} = {} N m/rad",
            torque_constant, error_gain_of(known.drive), known.ratio(), resistance,
            known.drivetrain.stiffness);
}

/// Motor inertia, natural frequency and friction at the load's shaft.
void add_mechanics(Steps& steps, const Known& known) {
  const Drivetrain& drivetrain = known.drivetrain;
  steps.add("Motor inertia referred to the load shaft", "J_M", "J_m n²", "{} × {}² = {} kg m2",
            known.drive.motor.inertia, known.ratio(), drivetrain.motor_inertia);
  steps.add("Undamped natural frequency", "ω_n", "√(K/(J_M + J_L))", "√({}/({} + {})) = {} rad/s",
            drivetrain.stiffness, drivetrain.motor_inertia, drivetrain.load_inertia,
            known.frequency);
  steps.add("Friction of the load and, referred to the load shaft, of the motor", "F_T",
            "F_L + f_m n²", "{} + {} × {}² = {} N m s/rad", drivetrain.load_friction,
            known.motor_friction, known.ratio(), known.mechanical_friction());
}

/// The sum of all friction as it stands in a formula, and with numbers. A motor without electrical
/// friction has no such term in it.
void add_ratios_and_damping(Steps& steps, bool has_electrical_friction, const Known& known) {
  const Drivetrain& drivetrain = known.drivetrain;
  const std::string mechanical = number(known.mechanical_friction());
  const std::string sum = has_electrical_friction ? "(F_T + F_1)" : "F_T";
  const std::string sum_in_numbers =
      has_electrical_friction
          ? fmt::format("({} + {})", mechanical, number(known.electrical_friction))
          : mechanical;
  steps.add("Damping coefficient", "ζ", sum + "/(J_M + J_L) × 1/(2 ω_n)",
            sum_in_numbers + "/({} + {}) × 1/(2 × {}) = {}", drivetrain.motor_inertia,
            drivetrain.load_inertia, known.frequency, known.servo.damping);
  steps.add("Inertia ratio",
            fmt::format("J_L/J_M = {}/{} = {}", number(drivetrain.load_inertia),
                        number(drivetrain.motor_inertia), number(known.servo.inertia_ratio)));
  if (known.total_friction() == 0.0) {
    steps.add("Friction ratio", "there is no friction, so it has no influence and is set to 0");
    return;
  }
  steps.add("Friction ratio", "F_L/F_Total", "F_L/" + sum, "{}/" + sum_in_numbers + " = {}",
            drivetrain.load_friction, known.servo.friction_ratio);
}

/// Each adds the steps of a kind of motor and returns the kind's name.
std::string add_steps_of(const ArmatureControl& motor, const Known& known, Steps& steps) {
  add_stiffness(steps, motor.torque_constant, motor.resistance, known);
  add_mechanics(steps, known);
  steps.add("Friction by back-EMF, referred to the load shaft", "F_1", "K_1 K_2 n²/R",
            "{} × {} × {}²/{} = {} N m s/rad", motor.torque_constant, motor.back_emf_constant,
            known.ratio(), motor.resistance, known.electrical_friction);
  add_ratios_and_damping(steps, true, known);
  return "armature control motor";
}

std::string add_steps_of(const FieldControl& motor, const Known& known, Steps& steps) {
  add_stiffness(steps, motor.torque_constant, motor.resistance, known);
  add_mechanics(steps, known);
  add_ratios_and_damping(steps, false, known);
  return "field control motor";
}

std::string add_steps_of(const TwoPhase& motor, const Known& known, Steps& steps) {
  steps.add("Loop stiffness at the load shaft, from the characteristic curves", "K", "K_e K_3 n",
            "{} × {} × {} = {} N m/rad", motor.torque_per_volt, error_gain_of(known.drive),
            known.ratio(), known.drivetrain.stiffness);
  add_mechanics(steps, known);
  steps.add("Friction by the slope of the characteristic curves, referred to the load shaft", "F_1",
            "K_N n²", "{} × {}² = {} N m s/rad", motor.torque_per_speed, known.ratio(),
            known.electrical_friction);
  add_ratios_and_damping(steps, true, known);
  return "two phase motor";
}

std::string add_steps_of(const TorqueControl&, const Known&, Steps&) {
  throw std::logic_error("there is no procedure for a torque-controlled motor");
}

// --- the limit cycle ---

/// The thesis reads a chart here. This solves the equation behind the chart.
void add_limit_cycle(Steps& steps, const Drive& drive) {
  Drive charted = drive;
  charted.gearbox.backlash = chart_backlash;
  const Answer answer = analyse(charted, {.proofs = false});
  const NormalFormNumbers servo = answer.normal_form.value();
  const Cycle* cycle =
      first_of(answer.cycles, [](const Cycle& one) { return one.stability == Stability::stable; });
  steps.add("Limit cycle for a backlash of 0.3 rad, which the thesis reads from a chart",
            fmt::format("enter with ζ = {}, J_L/J_M = {}, F_L/F_Total = {}", number(servo.damping),
                        number(servo.inertia_ratio), number(servo.friction_ratio)));
  if (servo.restitution > 0.0) {
    steps.more(fmt::format("(the charts are for restitution 0; this gear has {})",
                           number(servo.restitution)));
  }
  if (cycle == nullptr) {
    steps.more(fmt::format("no limit cycle: {}, growth at rest {}", name_of(answer.verdict),
                           number(answer.growth_at_rest.value_or(not_a_number))));
    return;
  }
  steps.more(fmt::format("computed, not read: ±{} rad", number(cycle->amplitude)));
  const double amplitude = cycle->amplitude * drive.gearbox.backlash / chart_backlash;
  steps.add("Limit cycle for this backlash",
            fmt::format("{} × {}/0.3 = {} rad", number(cycle->amplitude),
                        number(drive.gearbox.backlash), number(amplitude)));
}

}  // namespace

bool is_data_sheet(const Drive& drive) {
  const auto* pid = std::get_if<PID>(&drive.controller.law);
  return !drive.servo && !std::holds_alternative<TorqueControl>(drive.motor.kind) &&
         !drive.controller.firmware && pid != nullptr && pid->terms == PIDTerms::P;
}

std::string motor_procedure(const Drive& drive, const std::map<std::string, std::string>& written) {
  const Known known(drive);
  Steps steps;
  const std::string kind = std::visit(
      [&](const auto& motor) { return add_steps_of(motor, known, steps); }, drive.motor.kind);
  add_limit_cycle(steps, drive);
  return fmt::format(
      "Procedure for the {} (Appendix A of the thesis)\n\nData sheet\n{}\nSteps\n{}\n{}\n", kind,
      given_table(drive, written), steps.text(),
      headline(drive, analyse(drive, {.proofs = false})));
}

}  // namespace gearlash::thesis
