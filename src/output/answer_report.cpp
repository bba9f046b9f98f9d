#include "output/answer_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "gearlash/version.hpp"
#include "model/gains.hpp"
#include "model/reduced_drive.hpp"
#include "output/answer_parts.hpp"
#include "output/change_report.hpp"
#include "output/columns.hpp"

namespace gearlash {
namespace {

std::string percent(double part, double whole) {
  return fmt::format("{:.1f} %", 100.0 * part / whole);
}

double backlash_of(const AnswerReport& report) {
  if (report.answer.normal_form) return report.answer.normal_form->backlash;
  return report.drive.servo ? report.drive.servo->backlash : report.drive.gearbox.backlash;
}

TextRow amplitude_row(const AnswerReport& report, std::string name, double amplitude) {
  const AnswerUnits units(report);
  const double backlash = backlash_of(report);
  return {std::move(name), units.swing(amplitude),
          backlash == 0.0 ? "" : units.number(amplitude / backlash) + " of the backlash"};
}

// ---- headline -----------------------------------------------------------------------------------

constexpr int headline_digits = 3;

std::string pace(const AnswerReport& report, double period) {
  if (report.is_normalized) {
    return fmt::format(", period {} / ω_n", significant(period, headline_digits + 1));
  }
  return fmt::format(" at {} Hz", significant(1.0 / period, headline_digits));
}

/// ", 2 encoder steps: quantization", the word where the answer has that cause; empty for more
/// steps, or without an encoder.
std::string quantization_text(const AnswerReport& report, const std::optional<double>& steps) {
  if (!steps || *steps > steps_of_quantization) return "";
  return ", " + significant(*steps, 2) + " encoder steps" +
         (report.answer.is_quantization.value_or(false) ? ": quantization" : "");
}

std::string motion_text(const AnswerReport& report) {
  const AnswerUnits units(report, headline_digits);
  const auto of_motor = [&](double amplitude) {
    return "the motor within the gap, " + units.swing(amplitude);
  };
  if (const Cycle* cycle = report.answer.largest_stable()) {
    if (is_of_motor_alone(*cycle)) {
      return of_motor(cycle->motor_amplitude) + pace(report, cycle->period) +
             ", while the load stands still";
    }
    return units.swing(cycle->amplitude) + pace(report, cycle->period) +
           quantization_text(report, cycle->encoder_steps);
  }
  if (report.answer.irregular.empty()) return "amplitude not known";
  const IrregularMotion& motion = report.answer.irregular.front();
  const std::string at = motion.mean_period ? pace(report, *motion.mean_period) : "";
  if (motion.is_motor_alone && motion.motor_amplitude) {
    return of_motor(*motion.motor_amplitude) + at + ", while the load hardly moves";
  }
  return (motion.repeats() ? "" : "up to ") + units.swing(motion.amplitude) + at +
         quantization_text(report, motion.encoder_steps);
}

/// "steps from 0.07 rad on"; the smaller step if the directions differ. Empty if it is not
/// known, or where the smallest step that was tried leads there.
std::string steps_text(const AnswerReport& report, const std::string& end) {
  const Threshold* least = nullptr;
  for (const Threshold& threshold : report.answer.thresholds) {
    if (threshold.end == end && (least == nullptr || threshold.from < least->from))
      least = &threshold;
  }
  if (least == nullptr || least->below == 0.0) return "";
  const std::string way = least->direction == 0.0  ? ""
                          : least->direction > 0.0 ? " forward"
                                                   : " backward";
  return "steps from " + AnswerUnits(report, headline_digits).angle(least->from) + way + " on";
}

/// μ₀ with enough digits to show on which side of 1 it lies.
std::string growth_text(double growth) {
  int digits = headline_digits;
  while (digits < 17 && growth != 1.0 && significant(growth, digits) == "1") ++digits;
  return significant(growth, digits);
}

std::string growth_beside_one(const Answer& answer) {
  if (!answer.growth_at_rest) return "growth at rest not known";
  const double growth = *answer.growth_at_rest;
  const char* relation = growth < 1.0 ? "<" : growth > 1.0 ? ">" : "=";
  return fmt::format("growth at rest {} {} 1", growth_text(growth), relation);
}

// ---- cycles, rest, irregular motion -------------------------------------------------------------

/// Adds the proved range if the enclosure is too wide for the table's digits.
void add_range(TextRows& rows, const AnswerUnits& units, const Bounds& range, double scale,
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

void add_energy(TextRows& rows, const EnergyBalance& energy, const AnswerUnits& units) {
  const double total = energy.lost();
  const auto text = [&](double part) { return units.in(part, " K rad²", " J"); };
  rows.push_back({"energy lost per period", text(total)});
  const auto share = [&](const char* name, double part) {
    rows.push_back({name, text(part), percent(part, total)});
  };
  share("  in the motor's friction", energy.motor_friction);
  share("  in the load's friction", energy.load_friction);
  const auto share_if_any = [&](const char* name, double part) {
    if (part != 0.0) share(name, part);
  };
  share_if_any("  in the motor's dry friction", energy.motor_dry_friction);
  share_if_any("  in the load's dry friction", energy.load_dry_friction);
  share_if_any("  in impacts", energy.impacts);
  share_if_any("  in the faces' damping", energy.contact_damping);
  share_if_any("energy fed by the load torque", energy.load_torque);
}

/// On a multiplier, in the order of Stability.
constexpr const char* multiplier_remarks[] = {
    "disturbances decay", "disturbances neither grow nor decay", "disturbances grow"};

void add_contact(TextRows& rows, const Cycle& cycle, const Answer& answer,
                 const AnswerUnits& units) {
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
  const AnswerUnits units(report);
  const Answer& answer = report.answer;
  TextRows rows = {amplitude_row(report, "amplitude, load", cycle.amplitude)};
  const bool has_bounds = answer.bounds && answer.bounds->has_cycle;
  if (has_bounds) {
    add_range(rows, units, answer.bounds->amplitude, report.angle.radians, report.angle.name);
  }
  rows.push_back(amplitude_row(report, "amplitude, motor", cycle.motor_amplitude));
  if (cycle.center != 0.0) {
    rows.push_back({"center, from the reference", units.angle(cycle.center)});
  }
  rows.push_back({"period", units.time(cycle.period)});
  if (has_bounds) {
    add_range(rows, units, answer.bounds->period, 1.0, report.is_normalized ? "/ ω_n" : "s");
  }
  rows.push_back({"frequency", report.is_normalized
                                   ? units.number(2.0 * std::numbers::pi / cycle.period) + " ω_n"
                                   : units.number(cycle.frequency()) + " Hz"});
  rows.push_back({"multiplier", units.number(cycle.multiplier),
                  multiplier_remarks[static_cast<std::size_t>(cycle.stability)]});
  add_contact(rows, cycle, answer, units);
  if (cycle.energy) add_energy(rows, *cycle.energy, units);
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
  const AnswerUnits units(report);
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
  const AnswerUnits units(report);
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
  const AnswerUnits units(report);
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
  const AnswerUnits units(report);
  const NormalFormNumbers& form = *report.answer.normal_form;
  TextRows rows;
  if (!report.is_normalized) {
    rows.push_back({"natural frequency, ω_n", units.number(form.natural_frequency) + " rad/s",
                    units.number(form.natural_frequency / (2.0 * std::numbers::pi)) + " Hz"});
    if (form.stiffness) {
      rows.push_back({"loop stiffness, K", units.number(*form.stiffness) + " N m/rad"});
    }
  }
  rows.push_back({"damping, ζ", units.number(form.damping)});
  rows.push_back({"inertia ratio, J_L/J_M", units.number(form.inertia_ratio)});
  rows.push_back({"friction ratio, F_L/(F_M+F_L)", units.number(form.friction_ratio)});
  rows.push_back({"backlash, b", units.angle(form.backlash),
                  report.angle.radians == 1.0 ? "" : units.number(form.backlash) + " rad"});
  rows.push_back({"restitution, e", units.number(form.restitution)});
  const auto& growth = report.answer.growth_at_rest;
  rows.push_back({"growth at rest, μ₀", growth ? units.number(*growth) : "not known",
                  "of small motion in half a cycle"});
  return "\nServo\n" + table_text(rows);
}

/// The gains of a torque-controlled drive at both shafts.
std::string gains_table(const AnswerReport& report) {
  const AnswerUnits units(report);
  const TextRows rows = of_each(placed_gains(report.drive), [&](const PlacedGain& gain) -> TextRow {
    return {std::string(gain.path.substr(gain.path.find('.') + 1)),
            fmt::format("{} {} at the joint", units.number(gain.at_joint), gain.unit),
            fmt::format("{} {} at the motor", units.number(gain.at_motor), gain.unit)};
  });
  return rows.empty() ? "" : "\nGains, as torque per angle of the same shaft\n" + table_text(rows);
}

/// Hints at results that further options add.
std::string offer_text(const AnswerReport& report) {
  const std::string text = listed(
      std::array{report.margin ? ""
                               : "--margins adds how far each parameter is from the limit of "
                                 "hunting",
                 report.sensitivity ? "" : "--sensitivities adds what the amplitude depends on"},
      std::identity(), "; ");
  return further_paragraph(text.empty() ? "" : "Not shown: " + text + ".");
}

}  // namespace

std::string starts_text(std::size_t count) {
  return fmt::format("{} start{}", count, count == 1 ? "" : "s");
}

std::string AnswerUnits::angles(const Bounds& range) const {
  const double low = angle_unit.from_radians(range.low);
  const double high = angle_unit.from_radians(range.high);
  constexpr double unseen = 1e-9;  // relative to the larger; closer ends print as one number
  if (high - low <= unseen * std::max(std::abs(low), std::abs(high))) return angle(range.low);
  return fmt::format("{} … {} {}", number(low), number(high), angle_unit.name);
}

bool is_of_motor_alone(const Cycle& cycle) {
  constexpr double unseen = 1e-9;  // of the motor amplitude; rounding moves the load by less
  return cycle.amplitude <= unseen * cycle.motor_amplitude;
}

AnswerReport report_of(const Drive& drive, const Answer& answer, const AngleUnit& angle,
                       const Provenance& provenance) {
  return {.drive = drive,
          .answer = answer,
          .angle = angle,
          .is_normalized = is_normalized(drive),
          .provenance = provenance};
}

std::vector<ParameterFacts> AnswerReport::parameters() const {
  if (!margin) return {};
  return of_each(margin->parameters,
                 [&](const ParameterMargin& one) { return facts_of(drive, one.parameter); });
}

AnswerReport report_of(const Drive& drive, const Answer& answer) {
  return report_of(drive, answer, {}, {.command = "", .version = version});
}

namespace {

struct SeenMotion {
  double load = 0.0;
  double motor = 0.0;
  std::size_t starts = 0;

  double extent() const { return std::max(load, motor); }
};

/// "; 4 of 24 starts hunt by ±116 deg": where that is more than what the headline has.
std::string larger_motion(const AnswerReport& report) {
  std::vector<SeenMotion> motions;
  if (const Cycle* cycle = report.answer.largest_stable()) {
    motions.push_back({cycle->amplitude, cycle->motor_amplitude, cycle->starts});
  }
  for (const IrregularMotion& motion : report.answer.irregular) {
    motions.push_back({motion.amplitude, motion.motor_amplitude.value_or(0.0), motion.starts});
  }
  if (motions.empty()) return "";
  const SeenMotion& largest =
      *std::max_element(motions.begin(), motions.end(), by(&SeenMotion::extent));
  constexpr double clearly = 1.5;  // irregular motion varies
  if (largest.starts == 0 || largest.extent() <= clearly * motions.front().extent()) return "";
  return fmt::format("; {} of {} hunt by {}", largest.starts,
                     starts_text(report.answer.search->starts.size()),
                     AnswerUnits(report, headline_digits).swing(largest.extent()));
}

/// What a search leaves open or has found besides: "; 2 of 28 starts run away, 3 undecided".
std::string besides(const AnswerReport& report) {
  const Answer& answer = report.answer;
  if (!answer.search) return "";
  const bool is_verdict_on_runaway =
      answer.verdict == Verdict::runs_away || answer.verdict == Verdict::runs_away_if_disturbed;
  const std::size_t away = is_verdict_on_runaway ? 0 : answer.search->count("diverges");
  const std::size_t open = answer.search->count("undecided");
  std::string text = (answer.search->is_complete ? "" : "; stopped early") + larger_motion(report);
  const std::string steps = is_verdict_on_runaway ? "" : steps_text(report, "running away");
  if (!steps.empty()) text += "; runs away after " + steps;
  if (away + open == 0) return text;
  const std::string of_all = fmt::format(" of {}", starts_text(answer.search->starts.size()));
  if (away > 0 && steps.empty()) text += fmt::format("; {}{} run away", away, of_all);
  if (open > 0) text += fmt::format("; {}{} undecided", open, of_all);
  return text;
}

/// What small steps lead to first: "comes to rest; runs away after steps from 61.9 deg on".
std::string text_of_runaway(const AnswerReport& report) {
  const SearchRecord& search = *report.answer.search;
  const std::size_t rests = search.count("rest");
  const std::string steps = steps_text(report, "running away");
  if (!steps.empty()) return (rests > 0 ? "comes to rest; " : "") + ("runs away after " + steps);
  const std::string of = " of " + starts_text(search.starts.size());
  const std::string away = fmt::format("runs away from {}", search.count("diverges"));
  return rests == 0 ? away + of : fmt::format("comes to rest from {}{}, {}", rests, of, away);
}

/// ", after up to 12 min", where that is minutes or more.
std::string minutes_text(const AnswerReport& report) {
  const std::optional<double> time = report.answer.value(Quantity::time_to_rest);
  constexpr double minute = 60.0;
  if (report.is_normalized || !time || *time < minute) return "";
  constexpr double hour = 60.0;  // min
  constexpr double day = 24.0 * hour;
  const double minutes = *time / minute;
  const auto [unit, name] = minutes < 2.0 * hour  ? std::pair(1.0, "min")
                            : minutes < 2.0 * day ? std::pair(hour, "h")
                                                  : std::pair(day, "days");
  return fmt::format(", after up to {:.2g} {}", minutes / unit, name);
}

std::string headline_of_verdict(const AnswerReport& report) {
  const Answer& answer = report.answer;
  std::string verdict = name_of(answer.verdict);
  switch (answer.verdict) {
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
      return verdict + (answer.rests_engaged ? ", or rests with its faces together: " : ": ") +
             motion_text(report);
    case Verdict::forced:
      return "forced oscillation: " + motion_text(report);
    case Verdict::hunts_if_disturbed: {
      const std::string steps = steps_text(report, "hunting");
      return verdict + ": " + motion_text(report) + (steps.empty() ? "" : ", by " + steps) +
             (answer.growth_at_rest ? "; " + growth_beside_one(answer) : "");
    }
    case Verdict::runs_away_if_disturbed:
      return text_of_runaway(report);
    case Verdict::grows_without_bound:
      return verdict + ": no friction at all (damping 0)";
    case Verdict::undamped:
      return verdict + ": every oscillation persists (damping 0, backlash 0)";
    case Verdict::comes_to_rest: {
      const std::size_t all = answer.search->starts.size();
      const std::size_t some = answer.search->count("rest");
      const std::string of = some < all ? fmt::format("{} of", some) : "all";
      return fmt::format("{} from {} {}{}", verdict, of, starts_text(all), minutes_text(report));
    }
    case Verdict::cannot_hunt:
      if (answer.engine == Engine::general) {
        return verdict + ": everything outside the gap only takes energy";
      }
      if (backlash_of(report) == 0.0) return verdict + ": no backlash";
      return verdict + ": " + growth_beside_one(answer);
    case Verdict::undecided:
      return answer.engine != Engine::general ? verdict + ": " + growth_beside_one(answer)
                                              : verdict;
    default:
      return verdict;
  }
}

}  // namespace

std::string headline(const AnswerReport& report) {
  return headline_of_verdict(report) + besides(report);
}

std::string answer_text(const AnswerReport& report) {
  const Answer& answer = report.answer;
  std::string text = headline(report) + "\n" + cycle_tables(report);
  for (const IrregularMotion& motion : answer.irregular) text += irregular_text(report, motion);
  if (answer.rest) text += rest_text(report);
  text += ceiling_text(report);
  text += specification_text(report);
  text += measured_text(report);
  if (answer.normal_form) text += normal_form_table(report);
  text += gains_table(report);
  text += "\n";
  if (report.margin) {
    text += margin_text(report.drive, *report.margin, report.angle) + "\n";
  }
  if (report.sensitivity) text += sensitivity_text(*report.sensitivity) + "\n";
  for (const Note& note : answer.notes) {
    if (note.code != "undecided-start") text += wrapped(note.text);
  }
  text += wrapped(meaning_text(report));
  for (const Note& note : answer.notes) {
    if (note.code == "undecided-start") text += wrapped(note.text);
  }
  if (answer.engine != Engine::general) text += offer_text(report);
  return text;
}

std::string headline(const Drive& drive, const Answer& answer) {
  return headline(report_of(drive, answer));
}

std::string to_text(const Drive& drive, const Answer& answer) {
  return answer_text(report_of(drive, answer));
}

std::ostream& operator<<(std::ostream& stream, const Answer& answer) {
  return stream << headline(report_of(Drive{}, answer));
}

}  // namespace gearlash
