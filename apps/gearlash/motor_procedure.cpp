#include "motor_procedure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/analyse.hpp"
#include "base/overloaded.hpp"
#include "closed_form/limit_cycle.hpp"
#include "output/answer_report.hpp"

namespace gearlash::cli {
namespace {

constexpr double chart_backlash = 0.3;  ///< rad, for which the charts of the thesis are drawn

std::string number(double value) { return significant(value, 6); }

// --- the data sheet ---

struct Given {
  std::string name;
  std::string symbol;
  std::string key;  ///< "motor.inertia"
  double si;
  std::string unit;
};

std::vector<Given> motor_values(const SheetMotor& motor) {
  return std::visit(
      Overloaded{
          [](const ArmatureControlledMotor& armature) -> std::vector<Given> {
            return {{"armature resistance", "R", "motor.resistance", armature.resistance, "ohm"},
                    {"motor generator constant", "K_2", "motor.back_emf_constant",
                     armature.back_emf_constant, "V s/rad"},
                    {"torque constant", "K_1", "motor.torque_constant", armature.torque_constant,
                     "N m/A"},
                    {"motor inertia", "J_m", "motor.inertia", armature.inertia, "kg m2"},
                    {"motor friction", "f_m", "motor.friction", armature.friction, "N m s/rad"}};
          },
          [](const FieldControlledMotor& field) -> std::vector<Given> {
            return {
                {"field resistance", "R", "motor.resistance", field.resistance, "ohm"},
                {"torque constant", "K_1", "motor.torque_constant", field.torque_constant, "N m/A"},
                {"motor inertia", "J_m", "motor.inertia", field.inertia, "kg m2"},
                {"motor friction", "f_m", "motor.friction", field.friction, "N m s/rad"}};
          },
          [](const TwoPhaseMotor& two_phase) -> std::vector<Given> {
            return {{"torque per volt", "K_e", "motor.torque_per_volt", two_phase.torque_per_volt,
                     "N m/V"},
                    {"torque per speed", "K_N", "motor.torque_per_speed",
                     two_phase.torque_per_speed, "N m s/rad"},
                    {"motor inertia", "J_m", "motor.inertia", two_phase.inertia, "kg m2"},
                    {"motor friction", "f_m", "motor.friction", two_phase.friction, "N m s/rad"}};
          }},
      motor);
}

std::vector<Given> given_values(const Datasheet& datasheet) {
  std::vector<Given> values = motor_values(datasheet.motor);
  values.push_back(
      {"error measurement constant", "K_3", "loop.error_gain", datasheet.loop.error_gain, "V/rad"});
  values.push_back({"load inertia", "J_L", "load.inertia", datasheet.load.inertia, "kg m2"});
  values.push_back({"load friction", "F_L", "load.friction", datasheet.load.friction, "N m s/rad"});
  values.push_back({"backlash, total", "b", "gearbox.backlash", datasheet.gearbox.backlash, "rad"});
  return values;
}

std::string given_table(const Datasheet& datasheet,
                        const std::map<std::string, std::string>& written) {
  const std::vector<Given> values = given_values(datasheet);
  std::size_t longest = 0;
  for (const auto& [key, text] : written) longest = std::max(longest, text.size());
  std::string table;
  for (const Given& value : values) {
    const std::string si = number(value.si) + " " + value.unit;
    const auto as_written = written.find(value.key);
    const bool is_converted = as_written != written.end() && as_written->second != si;
    table += fmt::format("  {:<27} {:<4}", value.name, value.symbol);
    table += is_converted ? fmt::format("= {:<{}} = {}\n", as_written->second, longest, si)
                          : fmt::format("= {}\n", si);
  }
  const double ratio = datasheet.gearbox.ratio;
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

/// Everything that more than one step needs.
struct Known {
  const Datasheet& datasheet;
  ReferredMotor motor;
  Drivetrain drivetrain;
  NormalizedServo servo;
  double frequency;

  double ratio() const { return datasheet.gearbox.ratio; }
  double mechanical_friction() const {
    return drivetrain.load_friction + motor.mechanical_friction;
  }
  double total_friction() const { return mechanical_friction() + motor.electrical_friction; }
};

void add_stiffness(Steps& steps, double torque_constant, double resistance, const Known& known) {
  steps.add("Loop stiffness at the load shaft", "K", "K_1 K_3 n/R",
            fmt::format("{} × {} × {}/{} = {} N m/rad", number(torque_constant),
                        number(known.datasheet.loop.error_gain), number(known.ratio()),
                        number(resistance), number(known.motor.stiffness)));
}

void add_motor_inertia(Steps& steps, double inertia, const Known& known) {
  steps.add("Motor inertia referred to the load shaft", "J_M", "J_m n²",
            fmt::format("{} × {}² = {} kg m2", number(inertia), number(known.ratio()),
                        number(known.motor.inertia)));
}

void add_natural_frequency(Steps& steps, const Known& known) {
  steps.add("Undamped natural frequency", "ω_n", "√(K/(J_M + J_L))",
            fmt::format("√({}/({} + {})) = {} rad/s", number(known.motor.stiffness),
                        number(known.motor.inertia), number(known.drivetrain.load_inertia),
                        number(known.frequency)));
}

void add_mechanical_friction(Steps& steps, double friction, const Known& known) {
  steps.add(
      "Friction of the load and, referred to the load shaft, of the motor", "F_T", "F_L + f_m n²",
      fmt::format("{} + {} × {}² = {} N m s/rad", number(known.drivetrain.load_friction),
                  number(friction), number(known.ratio()), number(known.mechanical_friction())));
}

/// Friction by electrical means is left out of the sums of a motor that has none.
struct FrictionSum {
  std::string formula;
  std::string numbers;
};

FrictionSum friction_sum(bool has_electrical_friction, const Known& known) {
  const std::string mechanical = number(known.mechanical_friction());
  if (!has_electrical_friction) return {"F_T", mechanical};
  return {"(F_T + F_1)",
          fmt::format("({} + {})", mechanical, number(known.motor.electrical_friction))};
}

void add_damping(Steps& steps, const FrictionSum& sum, const Known& known) {
  steps.add("Damping coefficient", "ζ", sum.formula + "/(J_M + J_L) × 1/(2 ω_n)",
            fmt::format("{}/({} + {}) × 1/(2 × {}) = {}", sum.numbers, number(known.motor.inertia),
                        number(known.drivetrain.load_inertia), number(known.frequency),
                        number(known.servo.damping)));
}

void add_ratios(Steps& steps, const FrictionSum& sum, const Known& known) {
  steps.add("Inertia ratio",
            fmt::format("J_L/J_M = {}/{} = {}", number(known.drivetrain.load_inertia),
                        number(known.motor.inertia), number(known.servo.inertia_ratio)));
  if (known.total_friction() == 0.0) {
    steps.add("Friction ratio", "there is no friction: it has no influence, and is taken as 0");
    return;
  }
  steps.add("Friction ratio", "F_L/F_Total", "F_L/" + sum.formula,
            fmt::format("{}/{} = {}", number(known.drivetrain.load_friction), sum.numbers,
                        number(known.servo.friction_ratio)));
}

Steps armature_steps(const ArmatureControlledMotor& motor, const Known& known) {
  Steps steps;
  add_stiffness(steps, motor.torque_constant, motor.resistance, known);
  add_motor_inertia(steps, motor.inertia, known);
  add_natural_frequency(steps, known);
  add_mechanical_friction(steps, motor.friction, known);
  steps.add("Friction by back-EMF, referred to the load shaft", "F_1", "K_1 K_2 n²/R",
            fmt::format("{} × {} × {}²/{} = {} N m s/rad", number(motor.torque_constant),
                        number(motor.back_emf_constant), number(known.ratio()),
                        number(motor.resistance), number(known.motor.electrical_friction)));
  const FrictionSum sum = friction_sum(true, known);
  add_damping(steps, sum, known);
  add_ratios(steps, sum, known);
  return steps;
}

Steps field_steps(const FieldControlledMotor& motor, const Known& known) {
  Steps steps;
  add_stiffness(steps, motor.torque_constant, motor.resistance, known);
  add_motor_inertia(steps, motor.inertia, known);
  add_natural_frequency(steps, known);
  add_mechanical_friction(steps, motor.friction, known);
  const FrictionSum sum = friction_sum(false, known);
  add_damping(steps, sum, known);
  add_ratios(steps, sum, known);
  return steps;
}

Steps two_phase_steps(const TwoPhaseMotor& motor, const Known& known) {
  Steps steps;
  steps.add("Loop stiffness at the load shaft, from the characteristic curves", "K", "K_e K_3 n",
            fmt::format("{} × {} × {} = {} N m/rad", number(motor.torque_per_volt),
                        number(known.datasheet.loop.error_gain), number(known.ratio()),
                        number(known.motor.stiffness)));
  add_motor_inertia(steps, motor.inertia, known);
  add_natural_frequency(steps, known);
  add_mechanical_friction(steps, motor.friction, known);
  steps.add("Friction by the slope of the characteristic curves, referred to the load shaft", "F_1",
            "K_N n²",
            fmt::format("{} × {}² = {} N m s/rad", number(motor.torque_per_speed),
                        number(known.ratio()), number(known.motor.electrical_friction)));
  const FrictionSum sum = friction_sum(true, known);
  add_damping(steps, sum, known);
  add_ratios(steps, sum, known);
  return steps;
}

// --- the limit cycle ---

/// The thesis reads a chart here; the equation behind the charts is solved instead.
void add_limit_cycle(Steps& steps, const ServoFile& file) {
  NormalizedServo charted = file.servo;
  charted.backlash = chart_backlash;
  const LimitCycleAnalysis analysis = analyse_limit_cycles(charted);
  const auto cycle = std::find_if(analysis.cycles.begin(), analysis.cycles.end(),
                                  [](const LimitCycle& candidate) { return candidate.stable; });
  steps.add(
      "Limit cycle for a backlash of 0.3 rad, which the thesis reads from a chart",
      fmt::format("enter with ζ = {}, J_L/J_M = {}, F_L/F_Total = {}", number(charted.damping),
                  number(charted.inertia_ratio), number(charted.friction_ratio)));
  if (charted.restitution > 0.0) {
    steps.more(fmt::format("(the charts are for restitution 0; this gear has {})",
                           number(charted.restitution)));
  }
  if (cycle == analysis.cycles.end()) {
    steps.more(fmt::format("no limit cycle: {}, growth at rest {}", name_of(analysis.verdict),
                           number(analysis.growth_at_rest)));
    return;
  }
  steps.more(fmt::format("computed, not read: ±{} rad", number(cycle->size)));
  const double size = cycle->size * file.servo.backlash / chart_backlash;
  steps.add("Limit cycle for this backlash",
            fmt::format("{} × {}/0.3 = {} rad", number(cycle->size), number(file.servo.backlash),
                        number(size)));
}

Known known_of(const ServoFile& file) {
  return {*file.datasheet, refer_to_load(*file.datasheet), *file.drivetrain, file.servo,
          *file.natural_frequency};
}

struct Procedure {
  std::string title;
  Steps steps;
};

Procedure procedure_for(const Known& known) {
  return std::visit(
      Overloaded{[&](const ArmatureControlledMotor& motor) {
                   return Procedure{"armature control motor", armature_steps(motor, known)};
                 },
                 [&](const FieldControlledMotor& motor) {
                   return Procedure{"field control motor", field_steps(motor, known)};
                 },
                 [&](const TwoPhaseMotor& motor) {
                   return Procedure{"two phase motor", two_phase_steps(motor, known)};
                 }},
      known.datasheet.motor);
}

}  // namespace

std::string motor_procedure(const ServoFile& file,
                            const std::map<std::string, std::string>& written) {
  Procedure procedure = procedure_for(known_of(file));
  add_limit_cycle(procedure.steps, file);
  const ClosedFormServo servo{file.servo, *file.natural_frequency, false};
  const AnswerReport report{
      .answer = answer_of(analyse_limit_cycles(file.servo), servo, file.drivetrain->stiffness),
      .angle = file.backlash_unit};
  return fmt::format(
      "Procedure for the {} (Appendix A of the thesis)\n\nData sheet\n{}\nSteps\n{}\n{}\n",
      procedure.title, given_table(*file.datasheet, written), procedure.steps.text(),
      headline(report));
}

}  // namespace gearlash::cli
