#include "motor_procedure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/overloaded.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/analyse.hpp"
#include "model/reduced_drive.hpp"
#include "output/answer_report.hpp"

namespace gearlash::cli {
namespace {

constexpr double chart_backlash = 0.3;  ///< rad, of the charts of the thesis

std::string number(double value) { return significant(value, 6); }

// --- the data sheet ---

struct Given {
  std::string name;
  std::string symbol;
  std::string key;  ///< "motor.inertia"
  double si;
  std::string unit;
};

/// Constants of this kind of motor.
std::vector<Given> motor_constants(const MotorKind& kind) {
  return std::visit(
      Overloaded{[](const ArmatureControl& armature) -> std::vector<Given> {
                   return {
                       {"armature resistance", "R", "motor.resistance", armature.resistance, "ohm"},
                       {"motor generator constant", "K_2", "motor.back_emf_constant",
                        armature.back_emf_constant, "V s/rad"},
                       {"torque constant", "K_1", "motor.torque_constant", armature.torque_constant,
                        "N m/A"}};
                 },
                 [](const FieldControl& field) -> std::vector<Given> {
                   return {{"field resistance", "R", "motor.resistance", field.resistance, "ohm"},
                           {"torque constant", "K_1", "motor.torque_constant",
                            field.torque_constant, "N m/A"}};
                 },
                 [](const TwoPhase& two_phase) -> std::vector<Given> {
                   return {{"torque per volt", "K_e", "motor.torque_per_volt",
                            two_phase.torque_per_volt, "N m/V"},
                           {"torque per speed", "K_N", "motor.torque_per_speed",
                            two_phase.torque_per_speed, "N m s/rad"}};
                 },
                 [](const TorqueControl&) -> std::vector<Given> { return {}; }},
      kind);
}

/// Volts per radian of the load.
double error_gain_of(const Drive& drive) {
  const double gain = std::get<PID>(drive.controller.law).proportional;
  return drive.controller.shaft == GainShaft::motor ? gain * drive.gearbox.ratio : gain;
}

std::vector<Given> given_values(const Drive& drive) {
  std::vector<Given> values = motor_constants(drive.motor.kind);
  const std::vector<Given> others = {
      {"motor inertia", "J_m", "motor.inertia", drive.motor.inertia, "kg m2"},
      {"motor friction", "f_m", "motor.friction", drive.motor.friction.viscous, "N m s/rad"},
      {"error measurement constant", "K_3", "loop.error_gain", error_gain_of(drive), "V/rad"},
      {"load inertia", "J_L", "load.inertia", drive.load.inertia, "kg m2"},
      {"load friction", "F_L", "load.friction", drive.load.friction.viscous, "N m s/rad"},
      {"backlash, total", "b", "gearbox.backlash", drive.gearbox.backlash, "rad"}};
  values.insert(values.end(), others.begin(), others.end());
  return values;
}

std::string given_table(const Drive& drive, std::map<std::string, std::string> written) {
  const std::vector<Given> values = given_values(drive);
  std::size_t longest = 0;
  for (auto& [key, text] : written) {
    text = shown(text);
    longest = std::max(longest, text.size());
  }
  std::string table;
  for (const Given& value : values) {
    const std::string si = number(value.si) + " " + value.unit;
    const auto as_written = written.find(value.key);
    const bool is_converted = as_written != written.end() && as_written->second != si;
    table += fmt::format("  {:<27} {:<4}", value.name, value.symbol);
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
  /// "symbol = formula", and below it the same with numbers.
  void add(const std::string& title, const std::string& symbol, const std::string& formula,
           const std::string& numbers) {
    add(title, symbol + " = " + formula);
    const auto letters = std::count_if(symbol.begin(), symbol.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // not inside a UTF-8 character
    });
    more(std::string(static_cast<std::size_t>(letters), ' ') + " = " + numbers);
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
  steps.add("Loop stiffness at the load shaft", "K", "K_1 K_3 n/R",
            fmt::format("{} × {} × {}/{} = {} N m/rad", number(torque_constant),
                        number(error_gain_of(known.drive)), number(known.ratio()),
                        number(resistance), number(known.drivetrain.stiffness)));
}

/// Motor inertia, natural frequency and friction at the load's shaft.
void add_mechanics(Steps& steps, const Known& known) {
  const Drivetrain& drivetrain = known.drivetrain;
  steps.add("Motor inertia referred to the load shaft", "J_M", "J_m n²",
            fmt::format("{} × {}² = {} kg m2", number(known.drive.motor.inertia),
                        number(known.ratio()), number(drivetrain.motor_inertia)));
  steps.add("Undamped natural frequency", "ω_n", "√(K/(J_M + J_L))",
            fmt::format("√({}/({} + {})) = {} rad/s", number(drivetrain.stiffness),
                        number(drivetrain.motor_inertia), number(drivetrain.load_inertia),
                        number(known.frequency)));
  steps.add("Friction of the load and, referred to the load shaft, of the motor", "F_T",
            "F_L + f_m n²",
            fmt::format("{} + {} × {}² = {} N m s/rad", number(drivetrain.load_friction),
                        number(known.motor_friction), number(known.ratio()),
                        number(known.mechanical_friction())));
}

/// A motor without electrical friction has no such term in its sums.
struct FrictionSum {
  std::string formula;
  std::string numbers;
};

FrictionSum friction_sum(bool has_electrical_friction, const Known& known) {
  const std::string mechanical = number(known.mechanical_friction());
  if (!has_electrical_friction) return {"F_T", mechanical};
  return {"(F_T + F_1)", fmt::format("({} + {})", mechanical, number(known.electrical_friction))};
}

void add_damping(Steps& steps, const FrictionSum& sum, const Known& known) {
  steps.add(
      "Damping coefficient", "ζ", sum.formula + "/(J_M + J_L) × 1/(2 ω_n)",
      fmt::format("{}/({} + {}) × 1/(2 × {}) = {}", sum.numbers,
                  number(known.drivetrain.motor_inertia), number(known.drivetrain.load_inertia),
                  number(known.frequency), number(known.servo.damping)));
}

void add_ratios(Steps& steps, const FrictionSum& sum, const Known& known) {
  steps.add("Inertia ratio",
            fmt::format("J_L/J_M = {}/{} = {}", number(known.drivetrain.load_inertia),
                        number(known.drivetrain.motor_inertia), number(known.servo.inertia_ratio)));
  if (known.total_friction() == 0.0) {
    steps.add("Friction ratio", "there is no friction, so it has no influence and is set to 0");
    return;
  }
  steps.add("Friction ratio", "F_L/F_Total", "F_L/" + sum.formula,
            fmt::format("{}/{} = {}", number(known.drivetrain.load_friction), sum.numbers,
                        number(known.servo.friction_ratio)));
}

void add_ratios_and_damping(Steps& steps, bool has_electrical_friction, const Known& known) {
  const FrictionSum sum = friction_sum(has_electrical_friction, known);
  add_damping(steps, sum, known);
  add_ratios(steps, sum, known);
}

struct Procedure {
  std::string title;
  Steps steps;
};

Procedure procedure_for(const ArmatureControl& motor, const Known& known) {
  Procedure procedure{"armature control motor", {}};
  Steps& steps = procedure.steps;
  add_stiffness(steps, motor.torque_constant, motor.resistance, known);
  add_mechanics(steps, known);
  steps.add("Friction by back-EMF, referred to the load shaft", "F_1", "K_1 K_2 n²/R",
            fmt::format("{} × {} × {}²/{} = {} N m s/rad", number(motor.torque_constant),
                        number(motor.back_emf_constant), number(known.ratio()),
                        number(motor.resistance), number(known.electrical_friction)));
  add_ratios_and_damping(steps, true, known);
  return procedure;
}

Procedure procedure_for(const FieldControl& motor, const Known& known) {
  Procedure procedure{"field control motor", {}};
  add_stiffness(procedure.steps, motor.torque_constant, motor.resistance, known);
  add_mechanics(procedure.steps, known);
  add_ratios_and_damping(procedure.steps, false, known);
  return procedure;
}

Procedure procedure_for(const TwoPhase& motor, const Known& known) {
  Procedure procedure{"two phase motor", {}};
  Steps& steps = procedure.steps;
  steps.add("Loop stiffness at the load shaft, from the characteristic curves", "K", "K_e K_3 n",
            fmt::format("{} × {} × {} = {} N m/rad", number(motor.torque_per_volt),
                        number(error_gain_of(known.drive)), number(known.ratio()),
                        number(known.drivetrain.stiffness)));
  add_mechanics(steps, known);
  steps.add("Friction by the slope of the characteristic curves, referred to the load shaft", "F_1",
            "K_N n²",
            fmt::format("{} × {}² = {} N m s/rad", number(motor.torque_per_speed),
                        number(known.ratio()), number(known.electrical_friction)));
  add_ratios_and_damping(steps, true, known);
  return procedure;
}

Procedure procedure_for(const TorqueControl&, const Known&) {
  throw std::logic_error("there is no procedure for a torque-controlled motor");
}

// --- the limit cycle ---

/// The thesis reads a chart here. This solves the equation behind the chart.
void add_limit_cycle(Steps& steps, const Drive& drive) {
  Drive charted = drive;
  charted.gearbox.backlash = chart_backlash;
  const Answer answer = analyse(charted, {.proofs = false});
  const NormalFormNumbers servo = answer.normal_form.value();
  const auto cycle =
      std::find_if(answer.cycles.begin(), answer.cycles.end(),
                   [](const Cycle& candidate) { return candidate.stability == Stability::stable; });
  steps.add("Limit cycle for a backlash of 0.3 rad, which the thesis reads from a chart",
            fmt::format("enter with ζ = {}, J_L/J_M = {}, F_L/F_Total = {}", number(servo.damping),
                        number(servo.inertia_ratio), number(servo.friction_ratio)));
  if (servo.restitution > 0.0) {
    steps.more(fmt::format("(the charts are for restitution 0; this gear has {})",
                           number(servo.restitution)));
  }
  if (cycle == answer.cycles.end()) {
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

std::string motor_procedure(const Drive& drive, const AngleUnit& angle,
                            const std::map<std::string, std::string>& written) {
  const Known known(drive);
  Procedure procedure =
      std::visit([&](const auto& motor) { return procedure_for(motor, known); }, drive.motor.kind);
  add_limit_cycle(procedure.steps, drive);
  const AnswerReport report{.answer = analyse(drive, {.proofs = false}), .angle = angle};
  return fmt::format(
      "Procedure for the {} (Appendix A of the thesis)\n\nData sheet\n{}\nSteps\n{}\n{}\n",
      procedure.title, given_table(drive, written), procedure.steps.text(), headline(report));
}

}  // namespace gearlash::cli
