#include "output/limit_cycle_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "output/change_report.hpp"
#include "output/columns.hpp"
#include "output/json_values.hpp"

namespace gearlash {
namespace {

constexpr int headline_digits = 3;
constexpr int table_digits = 6;

/// μ₀ with as many digits as it takes to see on which side of 1 it lies.
std::string growth_text(double growth) {
  int digits = headline_digits;
  while (digits < 17 && growth != 1.0 && significant(growth, digits) == "1") ++digits;
  return significant(growth, digits);
}

std::string growth_beside_one(double growth) {
  if (std::isnan(growth)) return "growth at rest not known";
  const char* relation = growth < 1.0 ? "<" : growth > 1.0 ? ">" : "=";
  return fmt::format("growth at rest {} {} 1", growth_text(growth), relation);
}

std::string pace_text(const LimitCycle& cycle, const ReportUnits& units) {
  if (!units.natural_frequency) {
    return fmt::format("period {} / ω_n", significant(cycle.period, headline_digits + 1));
  }
  return fmt::format("{} Hz", significant(1.0 / units.time(cycle.period), headline_digits));
}

std::string swing_and_pace(const LimitCycleReport& report) {
  const LimitCycle* cycle = largest_stable(report.analysis);
  if (cycle != nullptr) {
    return fmt::format("{}{}{}", swing_text(cycle->size, report.units.angle, headline_digits),
                       report.units.natural_frequency ? " at " : ", ",
                       pace_text(*cycle, report.units));
  }
  const double size = report.analysis.irregular_size;
  if (std::isnan(size)) return "size not known";
  return "up to " + swing_text(size, report.units.angle, headline_digits);
}

// --- the table ---

struct Row {
  std::string name;
  std::string value;
  std::string remark;
};

std::string table(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> cells;
  for (const Row& row : rows) cells.push_back({row.name, row.value, row.remark});
  return table_text(cells);
}

std::string number(double value) { return significant(value, table_digits); }

std::string percent(double part, double whole) {
  return fmt::format("{:.1f} %", 100.0 * part / whole);
}

/// The value in the report's unit, and beside it the normalised one where that is another.
Row scaled_row(std::string name, double value, const std::string& unit, double normalized,
               const std::string& normalized_unit, bool is_scaled) {
  Row row{std::move(name), number(value) + " " + unit, ""};
  if (is_scaled) row.remark = number(normalized) + " " + normalized_unit;
  return row;
}

Row size_row(std::string name, double size, const LimitCycleReport& report) {
  return {std::move(name), swing_text(size, report.units.angle, table_digits),
          fmt::format("{} of the backlash", number(size / report.servo.backlash))};
}

/// Where the enclosure is too wide for the digits of the table, what is proved.
void add_range(std::vector<Row>& rows, const Bounds& bounds, double scale,
               const std::string& unit) {
  constexpr double unseen = 1e-6;
  if (bounds.high - bounds.low <= unseen * bounds.high) return;
  rows.push_back(
      {"  proved",
       fmt::format("{} … {} {}", number(bounds.low * scale), number(bounds.high * scale), unit),
       ""});
}

void add_pace(std::vector<Row>& rows, const LimitCycle& cycle, const ReportUnits& units) {
  const bool physical = units.natural_frequency.has_value();
  rows.push_back(scaled_row("period", units.time(cycle.period), units.time_unit(), cycle.period,
                            "/ ω_n", physical));
  if (physical) {
    rows.push_back({"frequency", number(1.0 / units.time(cycle.period)) + " Hz",
                    number(2.0 * std::numbers::pi / cycle.period) + " ω_n"});
  } else {
    rows.push_back({"frequency", number(2.0 * std::numbers::pi / cycle.period) + " ω_n", ""});
  }
}

void add_energy(std::vector<Row>& rows, const LimitCycle& cycle, const ReportUnits& units) {
  const double lost = cycle.energy.lost();
  rows.push_back(scaled_row("energy lost in a period", units.energy(lost), units.energy_unit(),
                            lost, "K rad²", units.stiffness.has_value()));
  const auto share = [&](const char* name, double part) {
    rows.push_back(
        {name, number(units.energy(part)) + " " + units.energy_unit(), percent(part, lost)});
  };
  share("  in the motor's friction", cycle.energy.motor_friction);
  share("  in the load's friction", cycle.energy.load_friction);
  share("  in impacts", cycle.energy.impacts);
}

/// Only its size matters: a bound that no change of rounding moves.
std::string residual_text(double residual) {
  if (std::isnan(residual)) return "nan";
  double bound = 1e-15;
  while (residual >= bound && bound < 1.0) bound *= 10.0;
  return "< " + significant(bound, 2);
}

std::string cycle_table(const LimitCycle& cycle, const LimitCycleReport& report) {
  const ReportUnits& units = report.units;
  std::vector<Row> rows;
  rows.push_back(size_row("size, load", cycle.size, report));
  const CycleBounds bounds = report.analysis.bounds.value_or(CycleBounds{});
  if (bounds.has_cycle) {
    add_range(rows, bounds.size, units.angle.from_radians(report.servo.backlash), units.angle.name);
  }
  rows.push_back(size_row("size, motor", cycle.motor_size, report));
  add_pace(rows, cycle, units);
  if (bounds.has_cycle) add_range(rows, bounds.period, units.time(1.0), units.time_unit());
  rows.push_back({"multiplier", number(cycle.multiplier), "disturbances die away"});
  rows.push_back({"impacts", fmt::format("{} a period", cycle.impacts_per_period),
                  cycle.settles ? "faces stay together" : "faces bounce apart"});
  rows.push_back(scaled_row("hardest impact", units.speed(cycle.impact_speed), units.speed_unit(),
                            cycle.impact_speed, "rad ω_n", units.natural_frequency.has_value()));
  rows.push_back({"faces together",
                  number(units.time(cycle.engaged_time)) + " " + units.time_unit(),
                  percent(cycle.engaged_time, cycle.period) + " of a period"});
  rows.push_back({"faces apart", number(units.time(cycle.separated_time)) + " " + units.time_unit(),
                  percent(cycle.separated_time, cycle.period) + " of a period"});
  add_energy(rows, cycle, units);
  rows.push_back({"residual", residual_text(cycle.residual), "mismatch where the cycle closes"});
  return table(rows);
}

std::string servo_table(const LimitCycleReport& report) {
  const NormalizedServo& servo = report.servo;
  std::vector<Row> rows;
  if (report.units.natural_frequency) {
    const double frequency = *report.units.natural_frequency;
    rows.push_back({"natural frequency, ω_n", number(frequency) + " rad/s",
                    number(frequency / (2.0 * std::numbers::pi)) + " Hz"});
  }
  if (report.units.stiffness) {
    rows.push_back({"loop stiffness, K", number(*report.units.stiffness) + " N m/rad", ""});
  }
  rows.push_back({"damping, ζ", number(servo.damping), ""});
  rows.push_back({"inertia ratio, J_L/J_M", number(servo.inertia_ratio), ""});
  rows.push_back({"friction ratio, F_L/(F_M+F_L)", number(servo.friction_ratio), ""});
  const AngleUnit& unit = report.units.angle;
  rows.push_back({"backlash, b", number(unit.from_radians(servo.backlash)) + " " + unit.name,
                  unit.radians == 1.0 ? "" : number(servo.backlash) + " rad"});
  rows.push_back({"restitution, e", number(servo.restitution), ""});
  rows.push_back({"position sensor", servo.sensor == ShaftName::load ? "load" : "motor", ""});
  const double growth = report.analysis.growth_at_rest;
  rows.push_back({"growth at rest, μ₀", std::isnan(growth) ? "not known" : number(growth),
                  "of small motion in half a cycle"});
  return table(rows);
}

/// Stable cycles with all their properties, then the unstable ones in a line each.
std::string cycle_tables(const LimitCycleReport& report) {
  std::string text;
  std::vector<Row> unstable;
  for (const LimitCycle& cycle : report.analysis.cycles) {
    if (cycle.stable) {
      text += fmt::format("\nLimit cycle: {}, stable\n", name_of(cycle.kind));
      text += cycle_table(cycle, report);
      continue;
    }
    const ReportUnits& units = report.units;
    unstable.push_back({name_of(cycle.kind), swing_text(cycle.size, units.angle, table_digits),
                        fmt::format("period {} {}, multiplier {}", number(units.time(cycle.period)),
                                    units.time_unit(), number(cycle.multiplier))});
  }
  if (unstable.empty()) return text;
  return text + "\nUnstable limit cycles, on which no motion stays\n" + table(unstable);
}

// --- what it means ---

std::string certainty(const LimitCycleAnalysis& analysis) {
  switch (analysis.certainty) {
    case Certainty::searched:
      return "This is what a search has found.";
    case Certainty::computed:
      return "This is computed, not proved.";
    case Certainty::enclosed:
      return "This is proved: by a theorem, whose condition interval arithmetic decides for this "
             "servo.";
    case Certainty::theorem:
      return "This is proved.";
  }
  return "";
}

std::string persistence(const LimitCycleAnalysis& analysis) {
  if (analysis.rests_engaged) {
    return "A large motion may end at rest, with the faces together on either side. Small motion "
           "in "
           "the gap grows";
  }
  return analysis.is_proved() ? "From almost every start the load never comes to rest"
                              : "The load does not come to rest";
}

/// Other starts may end elsewhere; empty where none was seen to.
std::string other_motion(const LimitCycleReport& report) {
  const double size = report.analysis.irregular_size;
  if (std::isnan(size)) return "";
  return "Other starts end in a motion that was not seen to repeat, of up to " +
         swing_text(size, report.units.angle, headline_digits) + ". ";
}

std::string meaning_when_hunting(const LimitCycleReport& report) {
  const LimitCycle* cycle = largest_stable(report.analysis);
  if (cycle == nullptr) {
    return persistence(report.analysis) +
           ", and its motion was not seen to repeat: it stayed within the size reported for as "
           "long "
           "as it was followed.";
  }
  const std::string share =
      significant(cycle->size / report.servo.backlash, headline_digits) + " times the backlash";
  const std::string where =
      cycle->kind == CycleKind::symmetric
          ? "to either side of the position asked for. "
          : "to either side of its middle, which is off the position asked for. ";
  const std::string end = report.analysis.is_proved()
                              ? "it ends in a swing of " + share
                              : "the largest steady swing found is " + share;
  return persistence(report.analysis) + ": " + end + " " + where + other_motion(report) +
         "Size is proportional to backlash: half the backlash, half the swing at the same "
         "frequency. No backlash is small enough to end the hunting; that takes a growth at rest "
         "below 1. " +
         certainty(report.analysis);
}

std::string meaning_when_quiet(const LimitCycleReport& report) {
  const LimitCycleAnalysis& analysis = report.analysis;
  if (report.servo.backlash == 0.0) return "Without backlash there is nothing to hunt in.";
  std::string text = "The load tends to the position asked for, wherever it starts. ";
  if (servo_dynamics(report.servo).plastic_contact() && analysis.growth_at_rest > 0.0) {
    text +=
        "The motor goes on crossing the gap, ever more slowly: each crossing takes longer in "
        "proportion as the load is nearer. ";
  }
  if (analysis.is_dissipative) {
    text +=
        "No restitution can make this servo hunt: apart from the gap it only ever takes energy "
        "from the motion. ";
  }
  return text +
         "However large the backlash is, this stays so: it depends on damping and ratios "
         "alone. " +
         certainty(analysis);
}

std::string meaning_when_undecided(const LimitCycleAnalysis& analysis) {
  if (analysis.neutral_swings) {
    return "Some swings neither grow nor die away as far as numbers can tell (multiplier 1): the "
           "servo lies on a boundary, where any change of a parameter decides.";
  }
  if (analysis.bounds) {
    const Bounds& growth = analysis.bounds->growth_at_rest;
    return fmt::format(
        "The servo lies on the boundary of hunting: its growth at rest is 1 to within {}, the "
        "width "
        "of the interval in which it is known to lie, {} … {}.",
        significant(growth.high - growth.low, 2), significant(growth.low, 17),
        significant(growth.high, 17));
  }
  return "The numerics could not decide; what is known is in the table.";
}

std::string meaning(const LimitCycleReport& report) {
  const std::string sure = certainty(report.analysis);
  switch (report.analysis.verdict) {
    case Verdict::cannot_hunt:
      return meaning_when_quiet(report);
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
      return meaning_when_hunting(report);
    case Verdict::hunts_if_disturbed:
      return "At rest the load stays at rest; a large enough disturbance sets it swinging for "
             "good. " +
             sure;
    case Verdict::grows_without_bound:
      return "There is no friction at all: every swing through the backlash is larger than the "
             "last. " +
             sure;
    case Verdict::undamped:
      return "There is neither friction nor backlash: the load swings for ever as it was started.";
    default:
      return meaning_when_undecided(report.analysis);
  }
}

// --- JSON ---

Json json_energy(const CycleEnergy& energy, double unit) {
  return {{"lost", json_number(unit * energy.lost())},
          {"motor_friction", json_number(unit * energy.motor_friction)},
          {"load_friction", json_number(unit * energy.load_friction)},
          {"impacts", json_number(unit * energy.impacts)}};
}

Json json_cycle(const LimitCycle& cycle) {
  return {{"kind", name_of(cycle.kind)},
          {"stable", cycle.stable},
          {"size", json_number(cycle.size)},
          {"motor_size", json_number(cycle.motor_size)},
          {"period", json_number(cycle.period)},
          {"multiplier", json_number(cycle.multiplier)},
          {"impact_speed", json_number(cycle.impact_speed)},
          {"engaged_time", json_number(cycle.engaged_time)},
          {"separated_time", json_number(cycle.separated_time)},
          {"residual", json_number(cycle.residual)},
          {"impacts_per_period", cycle.impacts_per_period},
          {"settles", cycle.settles},
          {"energy", json_energy(cycle.energy, 1.0)}};
}

Json json_physical_cycle(const LimitCycle& cycle, const ReportUnits& units) {
  const double period = units.time(cycle.period);
  Json json = {{"size", json_number(cycle.size)},
               {"motor_size", json_number(cycle.motor_size)},
               {"period", json_number(period)},
               {"frequency", json_number(1.0 / period)},
               {"impact_speed", json_number(units.speed(cycle.impact_speed))},
               {"engaged_time", json_number(units.time(cycle.engaged_time))},
               {"separated_time", json_number(units.time(cycle.separated_time))}};
  if (units.stiffness) json["energy"] = json_energy(cycle.energy, *units.stiffness);
  return json;
}

Json json_range(const Bounds& bounds) {
  return Json::array({json_number(bounds.low), json_number(bounds.high)});
}

/// What is proved of the numbers; null where nothing is.
Json json_bounds(const std::optional<CycleBounds>& bounds) {
  if (!bounds) return nullptr;
  Json json = {{"growth_at_rest", json_range(bounds->growth_at_rest)}};
  if (!bounds->has_cycle) return json;
  json["size_over_backlash"] = json_range(bounds->size);
  json["period"] = json_range(bounds->period);
  json["multiplier"] = json_range(bounds->multiplier);
  return json;
}

/// How sure each statement is: what is proved of a servo includes that its cycle is stable, and the
/// only one. A cycle that a search found is one to its residual, and its multiplier is computed.
Json json_certainty(const LimitCycleAnalysis& analysis) {
  const Certainty of_cycles = analysis.is_proved() ? analysis.certainty : Certainty::computed;
  Json stability = nullptr;
  if (!analysis.cycles.empty()) stability = name_of(of_cycles);
  return {{"verdict", name_of(analysis.certainty)},
          {"stability", std::move(stability)},
          {"completeness", name_of(analysis.certainty)}};
}

/// The observed cycle in SI, and what the normalised numbers are to be scaled by.
Json json_physical(const LimitCycleReport& report) {
  const LimitCycle* cycle = largest_stable(report.analysis);
  Json json = cycle == nullptr ? Json::object() : json_physical_cycle(*cycle, report.units);
  json["natural_frequency"] = json_number(*report.units.natural_frequency);
  if (report.units.stiffness) json["stiffness"] = json_number(*report.units.stiffness);
  return json;
}

}  // namespace

std::string verdict_line(const LimitCycleReport& report) {
  const LimitCycleAnalysis& analysis = report.analysis;
  const std::string verdict = name_of(analysis.verdict);
  switch (analysis.verdict) {
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
      return verdict + (analysis.rests_engaged ? ", or rests with its faces together: " : ": ") +
             swing_and_pace(report);
    case Verdict::hunts_if_disturbed:
      return verdict + ": " + swing_and_pace(report) + "; " +
             growth_beside_one(analysis.growth_at_rest);
    case Verdict::grows_without_bound:
      return verdict + ": no friction at all (damping 0)";
    case Verdict::undamped:
      return verdict + ": any swing persists (damping 0, backlash 0)";
    case Verdict::cannot_hunt:
      if (report.servo.backlash == 0.0) return verdict + ": no backlash";
      return verdict + ": " + growth_beside_one(analysis.growth_at_rest);
    default:
      return verdict + ": " + growth_beside_one(analysis.growth_at_rest);
  }
}

std::string limit_cycle_text(const LimitCycleReport& report) {
  std::string text =
      verdict_line(report) + "\n" + cycle_tables(report) + "\nServo\n" + servo_table(report) + "\n";
  if (report.margin) text += margin_text(*report.drive, *report.margin, report.units) + "\n";
  if (report.sensitivity) text += sensitivity_text(*report.sensitivity) + "\n";
  if (report.is_drive) {
    text += wrapped("Worked out in closed form: the drive is a servo with proportional control.");
  }
  return text + wrapped(meaning(report));
}

std::string limit_cycle_json(const LimitCycleReport& report) {
  const LimitCycleAnalysis& analysis = report.analysis;
  Json cycles = Json::array();
  for (const LimitCycle& cycle : analysis.cycles) cycles.push_back(json_cycle(cycle));
  Json json = {{"servo", json_servo(report.servo)},
               {"growth_at_rest", json_number(analysis.growth_at_rest)},
               {"method", "closed form"},
               {"verdict", name_of(analysis.verdict)},
               {"proved", analysis.is_proved()},
               {"certainty", json_certainty(analysis)},
               {"bounds", json_bounds(analysis.bounds)},
               {"dissipative", analysis.is_dissipative},
               {"rests_engaged", analysis.rests_engaged},
               {"neutral_swings", analysis.neutral_swings},
               {"cycles", std::move(cycles)}};
  if (!std::isnan(analysis.irregular_size)) {
    json["irregular_size"] = json_number(analysis.irregular_size);
  }
  if (report.units.natural_frequency) json["physical"] = json_physical(report);
  if (report.margin) json["margin"] = margin_json(*report.drive, *report.margin);
  if (report.sensitivity) json["sensitivities"] = sensitivity_json(*report.sensitivity);
  json["provenance"] = json_provenance(report.provenance);
  return json.dump(2) + "\n";
}

}  // namespace gearlash
