#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "model/gains.hpp"
#include "output/answer_parts.hpp"

namespace gearlash {
namespace {

std::string percent(double part, double whole) {
  return fmt::format("{:.1f} %", 100.0 * part / whole);
}

TextRow amplitude_row(const AnswerReport& report, std::string name, double amplitude) {
  const DriveUnits units(report.drive, all_digits);
  const double backlash = backlash_of(report.drive, report.answer);
  return {std::move(name), units.swing(amplitude),
          backlash == 0.0 ? "" : units.number(amplitude / backlash) + " of the backlash"};
}

// ---- cycles, rest, irregular motion -------------------------------------------------------------

/// Adds the proved range if the enclosure is too wide for the table's digits.
void add_range(TextRows& rows, const DriveUnits& units, const Bounds& range, double scale,
               const std::string& unit) {
  constexpr double unseen = 1e-6;
  if (range.high - range.low <= unseen * range.high) return;
  rows.push_back({"  proved", fmt::format("{} … {} {}", units.number(range.low / scale),
                                          units.number(range.high / scale), unit)});
}

/// A power of ten above the residual: only its order matters, and rounding does not change the
/// text.
std::string residual_text(double residual) {
  if (std::isnan(residual)) return "not known";
  double bound = 1e-15;
  while (residual >= bound && bound < 1.0) bound *= 10.0;
  return "< " + significant(bound, 2);
}

/// On a multiplier, in the order of Stability.
constexpr const char* multiplier_remarks[] = {
    "disturbances decay", "disturbances neither grow nor decay", "disturbances grow"};

void add_contact(TextRows& rows, const Cycle& cycle, const Answer& answer,
                 const DriveUnits& units) {
  if (answer.engine != Engine::general) {
    rows.push_back({"impacts", fmt::format("{} per period", cycle.events_per_period),
                    cycle.settles ? "faces stay together" : "faces bounce apart"});
  }
  if (cycle.impact_speed > 0.0) {
    rows.push_back({"hardest impact", units.in(cycle.impact_speed, " rad ω_n", " rad/s")});
  }
  rows.push_back({"faces together", units.time(cycle.engaged_time),
                  percent(cycle.engaged_time, cycle.period) + " of a period"});
  rows.push_back({"faces apart", units.time(cycle.separated_time),
                  percent(cycle.separated_time, cycle.period) + " of a period"});
}

std::string cycle_text(const AnswerReport& report, const Cycle& cycle) {
  const DriveUnits units(report.drive, all_digits);
  const Answer& answer = report.answer;
  TextRows rows = {amplitude_row(report, "amplitude, load", cycle.amplitude)};
  const bool has_bounds = answer.bounds && answer.bounds->has_cycle;
  if (has_bounds) {
    add_range(rows, units, answer.bounds->amplitude, report.drive.angle_unit.radians,
              report.drive.angle_unit.name);
  }
  rows.push_back(amplitude_row(report, "amplitude, motor", cycle.motor_amplitude));
  if (cycle.center != 0.0) {
    rows.push_back({"center, from the reference", units.angle(cycle.center)});
  }
  rows.push_back({"period", units.time(cycle.period)});
  if (has_bounds) {
    add_range(rows, units, answer.bounds->period, 1.0, units.is_normalized() ? "/ ω_n" : "s");
  }
  rows.push_back({"frequency", units.frequency(cycle.period)});
  rows.push_back({"multiplier", units.number(cycle.multiplier),
                  multiplier_remarks[static_cast<std::size_t>(cycle.stability)]});
  add_contact(rows, cycle, answer, units);
  if (answer.engine == Engine::general) {
    rows.push_back({"events per period", std::to_string(cycle.events_per_period)});
    rows.push_back({"reached from", starts_text(cycle.starts)});
  }
  rows.push_back({"residual", residual_text(cycle.residual), "mismatch where the cycle closes"});
  return fmt::format("\nLimit cycle: {}, {}{}\n", name_of(cycle.kind), name_of(cycle.stability),
                     cycle.has_mirror_image ? ", and its mirror image" : "") +
         table_text(rows);
}

/// The observable cycles with all their properties, then the unstable ones with one line each.
std::string cycle_tables(const AnswerReport& report) {
  std::string text;
  TextRows unstable;
  const DriveUnits units(report.drive, all_digits);
  for (const Cycle& cycle : report.answer.cycles) {
    if (cycle.stability != Stability::unstable) {
      text += cycle_text(report, cycle);
      continue;
    }
    unstable.push_back({name_of(cycle.kind), units.swing(cycle.amplitude),
                        fmt::format("period {}, multiplier {}", units.time(cycle.period),
                                    units.number(cycle.multiplier))});
  }
  if (unstable.empty()) return text;
  return text + "\nUnstable limit cycles, on which no motion stays\n" + table_text(unstable);
}

std::string irregular_text(const AnswerReport& report, const IrregularMotion& motion) {
  if (!motion.mean_period) return "";  // the headline or the meaning states its extent
  const DriveUnits units(report.drive, all_digits);
  const auto spread = [](double mean, double deviation) {
    return fmt::format("spread {:.2g} %", 100.0 * deviation / mean);
  };
  const std::string title = motion.is_motor_alone
                                ? "The motor hunts within the gap, while the load hardly moves"
                            : motion.repeats() ? "Motion whose swings repeat"
                                               : "Motion that was not seen to repeat";
  TextRows rows = {amplitude_row(report, "amplitude, load", motion.amplitude),
                   amplitude_row(report, "amplitude, motor", *motion.motor_amplitude),
                   {"center, from the reference", units.angle(motion.center)},
                   {"mean amplitude", units.swing(*motion.mean_amplitude),
                    spread(*motion.mean_amplitude, *motion.amplitude_deviation)},
                   {"mean period", units.time(*motion.mean_period),
                    spread(*motion.mean_period, *motion.period_deviation)},
                   {"swings repeat to within", fmt::format("{:.2g} %", 100.0 * *motion.mismatch)}};
  if (motion.exponent) {
    constexpr double chaotic = 10.0;    // e-foldings of the separation of neighbouring motions
    constexpr double repeating = 1e-3;  // swings that agree to this share repeat
    const bool is_chaotic =
        *motion.exponent * *motion.watched > chaotic && *motion.mismatch > repeating;
    rows.push_back({"neighboring motions part at", units.in(*motion.exponent, " ω_n", " /s"),
                    is_chaotic ? "chaotic" : ""});
  }
  rows.push_back({"followed for", units.time(*motion.watched)});
  rows.push_back({"reached from", starts_text(motion.starts)});
  return "\n" + title + "\n" + table_text(rows);
}

std::string rest_text(const AnswerReport& report) {
  const DriveUnits units(report.drive, all_digits);
  const Rest& rest = *report.answer.rest;
  TextRows rows = {
      {"load, from the reference", units.angles(rest.load)},
      {"motor, from the reference", units.angles(rest.motor)},
      {"these are",
       rest.certainty == Certainty::computed ? "the ends of all equilibria" : "where starts led"}};
  for (const RestPiece& piece : rest.pieces) {
    if (piece.kind == RestKind::no_limit) continue;
    rows.push_back({piece.kind == RestKind::dead_band ? "load in the dead band"
                    : piece.side > 0.0                ? "load at the limit, forward"
                                                      : "load at the limit, backward",
                    units.angles(piece.load)});
  }
  if (rest.starts > 0) rows.push_back({"reached from", starts_text(rest.starts)});
  if (rest.time) {
    rows.push_back({"time to rest, longest", units.time(rest.time->longest),
                    "within " + units.swing(rest.time->band)});
    rows.push_back({"time to rest, median", units.time(rest.time->median)});
  }
  if (rest.creeping_starts > 0) {
    rows.push_back(
        {"creeps there", starts_text(rest.creeping_starts), "moves ever later, or hardly ever"});
  }
  if (rest.swing_ratio) {
    rows.push_back(
        {"approached by swings, ratio", units.number(*rest.swing_ratio), "never quite reached"});
  }
  return "\nRest\n" + table_text(rows);
}

// ---- the drive ----------------------------------------------------------------------------------

/// The drive as a servo of 1960.
std::string normal_form_table(const AnswerReport& report) {
  const DriveUnits units(report.drive, all_digits);
  const NormalFormNumbers& form = *report.answer.normal_form;
  TextRows rows;
  if (!units.is_normalized()) {
    rows.push_back({"natural frequency, ω_n", units.number(form.natural_frequency) + " rad/s",
                    units.number(form.natural_frequency / (2.0 * std::numbers::pi)) + " Hz"});
    if (form.stiffness) {
      rows.push_back({"loop stiffness, K", units.number(*form.stiffness) + " N m/rad"});
    }
  }
  rows.push_back({"damping, ζ", units.number(form.damping)});
  rows.push_back({"inertia ratio, J_L/J_M", units.number(form.inertia_ratio)});
  rows.push_back({"friction ratio, F_L/(F_M+F_L)", units.number(form.friction_ratio)});
  rows.push_back(
      {"backlash, b", units.angle(form.backlash),
       report.drive.angle_unit.radians == 1.0 ? "" : units.number(form.backlash) + " rad"});
  rows.push_back({"restitution, e", units.number(form.restitution)});
  const auto& growth = report.answer.growth_at_rest;
  rows.push_back({"growth at rest, μ₀", growth ? units.number(*growth) : "not known",
                  "of small motion in half a cycle"});
  return "\nServo\n" + table_text(rows);
}

/// The gains of a torque-controlled drive at both shafts.
std::string gains_table(const AnswerReport& report) {
  const DriveUnits units(report.drive, all_digits);
  const TextRows rows = of_each(placed_gains(report.drive), [&](const PlacedGain& gain) -> TextRow {
    return {std::string(gain.path.substr(gain.path.find('.') + 1)),
            fmt::format("{} {} at the joint", units.number(gain.at_joint), gain.unit),
            fmt::format("{} {} at the motor", units.number(gain.at_motor), gain.unit)};
  });
  return rows.empty() ? "" : "\nGains, as torque per angle of the same shaft\n" + table_text(rows);
}

}  // namespace

std::string details_text(const AnswerReport& report) {
  const Answer& answer = report.answer;
  std::string text = cycle_tables(report);
  for (const IrregularMotion& motion : answer.irregular) text += irregular_text(report, motion);
  if (answer.rest) text += rest_text(report);
  text += ceiling_text(report);
  if (answer.normal_form) text += normal_form_table(report);
  return text + gains_table(report);
}

}  // namespace gearlash
