#include "output/answer_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "gearlash/version.hpp"
#include "model/quantities.hpp"
#include "model/reduced_drive.hpp"
#include "output/answer_parts.hpp"
#include "output/change_report.hpp"

namespace gearlash {
namespace {

std::string joined(const std::vector<std::string>& parts) {
  return listed(parts, std::identity(), ", ");
}

/// From small displacements at least.
bool is_at_rest(const Without& one) {
  const bool rests = one.verdict == Verdict::cannot_hunt || one.verdict == Verdict::comes_to_rest ||
                     one.verdict == Verdict::runs_away_if_disturbed;
  return rests && one.error && std::isfinite(*one.error);
}

/// "a, b and c".
std::string enumerated(const std::vector<std::string>& words) {
  const std::vector<std::string> first(words.begin(), words.end() - 1);
  return first.empty() ? words.back() : listed(first) + " and " + words.back();
}

// ---- the specification --------------------------------------------------------------------------

std::string error_words(const std::optional<double>& error, const DriveUnits& units) {
  if (!error) return "not known";
  return std::isinf(*error) ? "beyond all bounds" : units.angle(*error);
}

/// "the gap".
std::string with_article(Cause cause) {
  const bool is_countable = cause == Cause::gap || cause == Cause::delay ||
                            cause == Cause::encoder || cause == Cause::load_torque;
  return std::string(is_countable ? "the " : "") + name_of(cause) +
         (cause == Cause::encoder ? "'s steps" : "");
}

std::string specification_text(const AnswerReport& report) {
  const Answer& answer = report.answer;
  if (!answer.specification) return "";
  const DriveUnits units(report.drive);
  const SpecificationAnswer& judged = *answer.specification;
  std::string text = fmt::format("Specification, an error of {}: {}", units.angle(judged.permitted),
                                 name_of(judged.small));
  const std::optional<double> error = answer.value(Quantity::error);
  if (error) text += fmt::format("; the load ends up to {} off", error_words(error, units));
  if (judged.excess && !std::isinf(*judged.excess)) {
    text += fmt::format(", {} more than is permitted", units.angle(*judged.excess));
  }
  if (judged.cause) text += ", most of it due to " + with_article(*judged.cause);
  if (judged.small == Fulfilment::met && judged.if_disturbed != Fulfilment::met) {
    const std::optional<double> worst = answer.value(Quantity::error_if_disturbed);
    text += worst ? "; after larger disturbances " + error_words(worst, units)
                  : "; what larger disturbances lead to is not known";
  }
  text += ".";
  const std::optional<double> widest = report.widest_backlash();
  if (widest) {
    text += " Every backlash up to " + units.at_least(*widest) +
            " provably keeps the load within it of the motion without a gap.";
  }
  return further_paragraph(text);
}

// ---- motions ------------------------------------------------------------------------------------

std::string cycle_row_text(const Cycle& cycle, const DriveUnits& units) {
  return units.swing(cycle.amplitude) + units.pace(cycle.period);
}

/// The cycle that is seen in practice.
std::string motion_table(const AnswerReport& report) {
  const Cycle* cycle = first_cycle(report.answer);
  if (cycle == nullptr || is_of_motor_alone(*cycle)) return "";  // the headline has it
  const DriveUnits units(report.drive);
  const double backlash = backlash_of(report.drive, report.answer);
  TextRows rows = {
      {"load", units.swing(cycle->amplitude),
       backlash > 0.0 ? units.number(cycle->amplitude / backlash) + " of the backlash" : ""},
      {"motor", units.swing(cycle->motor_amplitude)},
      {"period", units.time(cycle->period),
       units.is_normalized() ? "" : units.number(cycle->frequency()) + " Hz"}};
  constexpr double clearly = 1.01;
  if (cycle->error > clearly * cycle->amplitude)
    rows.push_back({"largest error", units.angle(cycle->error)});
  if (cycle->impact_speed > 0.0) {
    rows.push_back({"hardest impact", units.in(cycle->impact_speed, " rad ω_n", " rad/s")});
  }
  if (cycle->mesh_torque) {
    rows.push_back({"largest mesh torque", units.in(*cycle->mesh_torque, " K rad", " N m")});
  }
  return fmt::format("\nLimit cycle: {}, {}{}\n", name_of(cycle->kind), name_of(cycle->stability),
                     cycle->has_mirror_image ? ", and its mirror image" : "") +
         table_text(rows);
}

/// What feeds the cycle, and what each loss takes.
std::string balance_text(const AnswerReport& report) {
  const Cycle* cycle = first_cycle(report.answer);
  if (cycle == nullptr || !cycle->energy || is_of_motor_alone(*cycle)) return "";
  const DriveUnits units(report.drive);
  const EnergyBalance& energy = *cycle->energy;
  TextRows rows;
  const auto add = [&](const char* name, double part, double whole) {
    if (part == 0.0) return;
    rows.push_back(
        {name, units.in(part, " K rad²", " J"), fmt::format("{:.3g} %", 100.0 * part / whole)});
  };
  add("fed by the motor", energy.motor, energy.fed());
  add("fed by the load torque", energy.load_torque, energy.fed());
  add("lost in the motor's viscous friction", energy.motor_friction, energy.lost());
  add("lost in the load's viscous friction", energy.load_friction, energy.lost());
  add("lost in the motor's dry friction", energy.motor_dry_friction, energy.lost());
  add("lost in the load's dry friction", energy.load_dry_friction, energy.lost());
  add("lost in impacts", energy.impacts, energy.lost());
  add("lost in the faces' damping", energy.contact_damping, energy.lost());
  return "\nEnergy of a period\n" + table_text(rows);
}

/// The other motions that last: stable ones in a line each, those of few encoder steps together.
std::string others_text(const AnswerReport& report) {
  const Answer& answer = report.answer;
  const DriveUnits units(report.drive);
  TextRows rows;
  std::size_t small = 0;
  std::size_t unstable = 0;
  double largest_small = 0.0;
  constexpr std::size_t most = 4;
  std::size_t more = 0;
  const auto is_small = [](const auto& motion) {
    return motion.encoder_steps && *motion.encoder_steps <= steps_of_quantization;
  };
  const auto add = [&](const auto& motion, const char* name, const std::string& text) {
    if (is_small(motion)) {
      ++small;
      largest_small = std::max(largest_small, motion.amplitude);
    } else if (rows.size() < most) {
      rows.push_back({name, text});
    } else {
      ++more;
    }
  };
  for (const Cycle& cycle : answer.cycles) {
    if (&cycle == first_cycle(answer)) continue;
    if (cycle.stability == Stability::unstable) {
      ++unstable;
    } else {
      add(cycle, "limit cycle", cycle_row_text(cycle, units));
    }
  }
  const bool is_first_named = first_cycle(answer) == nullptr;
  for (std::size_t i = is_first_named ? 1 : 0; i < answer.irregular.size(); ++i) {
    const IrregularMotion& motion = answer.irregular[i];
    add(motion, motion.repeats() ? "swings that repeat" : "irregular",
        "up to " + units.swing(motion.amplitude));
  }
  if (more > 0) rows.push_back({"and", std::to_string(more) + " more"});
  if (small > 0) {
    rows.push_back({"of few encoder steps", std::to_string(small),
                    largest_small > 0.0 ? "up to " + units.swing(largest_small) + " of the load"
                                        : "of the motor alone"});
  }
  if (unstable > 0) rows.push_back({"unstable cycles", std::to_string(unstable)});
  return rows.empty() ? "" : "\nOther motions\n" + table_text(rows);
}

// ---- causes -------------------------------------------------------------------------------------

/// Which causes a motion needs, and how far off the drive is without each.
std::string causes_text(const AnswerReport& report) {
  const Answer& answer = report.answer;
  if (answer.without.empty() || answer.engine != Engine::general) return "";
  const DriveUnits units(report.drive);
  TextRows rows;
  std::vector<std::string> needed;
  for (const Without& one : answer.without) {
    if (one.verdict == Verdict::undecided) continue;
    const std::string name = "without " + with_article(one.cause);
    const std::string end = is_at_rest(one) ? "comes to rest" : name_of(one.verdict);
    rows.push_back({name, end,
                    !one.error          ? ""
                    : *one.error == 0.0 ? "at the reference"
                                        : "up to " + error_words(one.error, units) + " off"});
    if (is_at_rest(one)) needed.push_back(with_article(one.cause));
  }
  std::string text = "\nThe same drive\n" + table_text(rows);
  const bool swings = answer.largest_stable() != nullptr || !answer.irregular.empty();
  if (swings && !needed.empty()) {
    text += wrapped("So its hunting needs " + enumerated(needed) + ".");
  }
  return text;
}

// ---- linear loop and step -----------------------------------------------------------------------

std::string loop_text(const AnswerReport& report) {
  const Answer& answer = report.answer;
  if (!answer.loop) return "";
  const DriveUnits units(report.drive);
  const LinearLoop& loop = *answer.loop;
  const auto frequency = [&](double hertz) {
    return is_normalized(report.drive) ? units.number(2.0 * std::numbers::pi * hertz) + " ω_n"
                                       : units.number(hertz) + " Hz";
  };
  constexpr double degrees = 180.0 / std::numbers::pi;
  const std::string text =
      joined({loop.phase_margin ? "phase margin " + units.number(*loop.phase_margin * degrees) +
                                      "° at " + frequency(*loop.crossover)
                                : "",
              loop.gain_margin ? "gain margin ×" + units.number(*loop.gain_margin) + " at " +
                                     frequency(*loop.phase_crossover)
                               : "",
              loop.bandwidth ? "bandwidth " + frequency(*loop.bandwidth) : "",
              loop.lag ? "lag " + units.angle(*loop.lag) + " behind the moving reference" : ""});
  return "\nLinear loop, with the gap closed: " +
         std::string(loop.is_stable ? "stable" : "not stable") + "\n" +
         (text.empty() ? "" : table_text({{text}}));
}

std::string step_text(const AnswerReport& report) {
  const Answer& answer = report.answer;
  if (!answer.step || !answer.rest) return "";
  const DriveUnits units(report.drive);
  const StepResponse& step = *answer.step;
  const std::string band = units.swing(step.band);
  const bool is_within_gap = std::abs(step.step) < backlash_of(report.drive, report.answer);
  constexpr double seen = 1e-6;
  const bool ends_off =
      !step.settling_time && std::abs(step.final_error) > seen * std::abs(step.step);
  const std::string text = joined(
      {step.rise_time ? "rises in " + units.time(*step.rise_time) : "does not rise",
       step.overshoot && step.rise_time
           ? "overshoots by " + significant(100.0 * *step.overshoot, 3) + " %"
           : "",
       step.settling_time ? "settles within " + band + " in " + units.time(*step.settling_time)
                          : "does not settle within " + band,
       ends_off ? "ends " + units.angle(std::abs(step.final_error)) + " off" : ""});
  return "\nStep of " + units.angle(step.step) +
         (is_within_gap ? ", less than the gap: --step gives another" : "") + "\n" +
         table_text({{text}});
}

// ---- rest ---------------------------------------------------------------------------------------

std::string short_rest_text(const AnswerReport& report) {
  if (!report.answer.rest) return "";
  const DriveUnits units(report.drive);
  const Rest& rest = *report.answer.rest;
  TextRows rows = {{"error, reference − load", units.angles(rest.error),
                    rest.certainty == Certainty::computed ? "all equilibria" : "where starts led"}};
  for (const RestPiece& piece : rest.pieces) {
    if (piece.kind == RestKind::no_limit) continue;
    rows.push_back(
        {piece.kind == RestKind::dead_band ? "load in the dead band" : "load at the torque limit",
         units.angles(piece.load)});
  }
  if (rest.time) {
    rows.push_back({"time to rest",
                    units.time(rest.time->longest) + ", median " + units.time(rest.time->median),
                    "within " + units.swing(rest.time->band) + " of where it ends"});
  }
  if (rest.creeping_starts > 0) {
    rows.push_back({"creeps there", starts_text(rest.creeping_starts)});
  }
  return "\nRest\n" + table_text(rows);
}

/// "±8.56 arcmin: gap 5.94, motor friction 1.75".
std::string short_ceiling_text(const AnswerReport& report) {
  if (!report.answer.ceiling) return "";
  const Ceiling& ceiling = *report.answer.ceiling;
  if (!ceiling.load) return further_paragraph("No proved ceiling: " + ceiling.reason + ".");
  const auto angle = [&](double value) { return DriveUnits(report.drive).swing_at_most(value); };
  std::string text = "Ceiling: in the end no motion is farther than " + angle(*ceiling.load) +
                     " from that without a gap" + below_limit_text(ceiling) + " (proved)";
  if (ceiling.terms.size() > 1) {
    text += ": " + listed(ceiling.terms, [&](const CeilingTerm& term) {
              return term.source + " " + angle(term.load);
            });
  }
  return further_paragraph(text + ".");
}

// ---- notes --------------------------------------------------------------------------------------

/// Hints at results that further options add.
std::string offer_text(const AnswerReport& report, Detail detail, const std::string& left_out) {
  const std::string verbose =
      "--verbose" + (left_out.empty() ? "" : " (with " + left_out + ", left out here)");
  const std::string text = listed(std::array{
      detail == Detail::all ? "" : verbose, std::string(report.margin ? "" : "--margins"),
      std::string(report.sensitivity ? "" : "--sensitivities")});
  return text.empty() ? "" : "More: " + text + ".\n";
}

/// A part of a report; it is left out of a report that is too long if it has a name.
struct ReportPart {
  std::string text;
  std::string name{};
};

constexpr std::ptrdiff_t most_lines = 40;  // of a report of Detail::usual

std::ptrdiff_t lines_of(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

/// Empties sections with names, one after the other, until the others and a last line keep the
/// limit. Gives their names.
std::string left_out_of(std::vector<ReportPart>& sections, std::ptrdiff_t limit) {
  std::ptrdiff_t lines = 1;
  for (const ReportPart& section : sections) lines += lines_of(section.text);
  std::vector<std::string> names;
  for (ReportPart& section : sections) {
    if (section.name.empty() || section.text.empty() || lines <= limit) continue;
    lines -= lines_of(section.text);
    section.text.clear();
    names.push_back(section.name);
  }
  return listed(names);
}

bool comes_first(const Note& note) { return note.code == "drifts-in-gap"; }

/// What a reader needs to know even of a short report.
bool is_short(const Note& note) {
  constexpr std::array details = {"firmware", "gravity", "no-load-current", "undecided-start"};
  return !comes_first(note) &&
         !any_of(details, [&](const char* code) { return note.code == code; });
}

std::string notes_text(const AnswerReport& report, const std::function<bool(const Note&)>& shown) {
  std::string text;
  for (const Note& note : report.answer.notes) {
    if (shown(note)) text += wrapped(note.text);
  }
  return text.empty() ? "" : "\n" + text;
}

}  // namespace

double backlash_of(const Drive& drive, const Answer& answer) {
  if (answer.normal_form) return answer.normal_form->backlash;
  return drive.servo ? drive.servo->backlash : drive.gearbox.backlash;
}

std::string starts_text(std::size_t count) {
  return fmt::format("{} start{}", count, count == 1 ? "" : "s");
}

bool is_of_motor_alone(const Cycle& cycle) {
  constexpr double unseen = 1e-9;  // of the motor amplitude; rounding moves the load by less
  return cycle.amplitude <= unseen * cycle.motor_amplitude;
}

AnswerReport report_of(const Drive& drive, const Answer& answer, const Provenance& provenance) {
  return {.drive = drive, .answer = answer, .provenance = provenance};
}

std::vector<ParameterFacts> AnswerReport::parameters() const {
  if (!margin) return {};
  return of_each(margin->parameters,
                 [&](const ParameterMargin& one) { return facts_of(drive, one.parameter); });
}

AnswerReport report_of(const Drive& drive, const Answer& answer) {
  return report_of(drive, answer, {.command = "", .version = version});
}

std::string answer_text(const AnswerReport& report, Detail detail) {
  const bool is_short_report = detail == Detail::usual;
  std::string asked;
  if (report.margin) asked += "\n" + margin_text(report.drive, *report.margin);
  if (report.sensitivity) asked += "\n" + sensitivity_text(*report.sensitivity);
  std::vector<ReportPart> sections = {
      {headline(report) + "\n" + notes_text(report, comes_first) + specification_text(report)},
      {is_short_report ? motion_table(report) : ""},
      {balance_text(report)},
      {causes_text(report)},
      {loop_text(report)},
      {step_text(report), "the step"},
      {is_short_report ? short_rest_text(report) : details_text(report)},
      {is_short_report ? others_text(report) : "", "other motions"},
      {is_short_report ? short_ceiling_text(report) : ""},
      {measured_text(report) + asked},
      {notes_text(
          report,
          [&](const Note& note) { return is_short_report ? is_short(note) : !comes_first(note); })},
      {further_paragraph(is_short_report ? short_meaning_text(report) : meaning_text(report))}};
  const std::string left_out =
      is_short_report ? left_out_of(sections, most_lines + lines_of(asked)) : "";
  std::string text;
  for (const ReportPart& section : sections) text += section.text;
  return text + offer_text(report, detail, left_out);
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
