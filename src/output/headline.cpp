#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/lists.hpp"
#include "model/quantities.hpp"
#include "output/answer_parts.hpp"
#include "output/answer_report.hpp"

namespace gearlash {
namespace {

constexpr int headline_digits = 3;

DriveUnits headline_units(const AnswerReport& report) {
  return DriveUnits(report.drive, headline_digits);
}

/// ", 2 encoder steps: quantization", the word where the answer has that cause; empty for more
/// steps, or without an encoder.
std::string quantization_text(const AnswerReport& report, const std::optional<double>& steps) {
  if (!steps || *steps > steps_of_quantization) return "";
  return ", " + significant(*steps, 2) + " encoder steps" +
         (report.answer.is_quantization.value_or(false) ? ": quantization" : "");
}

/// ", up to 3 arcmin off": an error that the words before do not have. `known`: what they have,
/// rad.
std::string error_text(const AnswerReport& report, double error, double known) {
  constexpr double clearly = 1.05;
  if (!(error > clearly * known) || !std::isfinite(error)) return "";
  return ", up to " + headline_units(report).angle(error) + " off";
}

/// What swings, of a cycle or of an irregular motion.
struct Swing {
  double load = 0.0;
  double motor = 0.0;
  double error = 0.0;
  std::optional<double> period{};
  std::optional<double> encoder_steps{};
  bool is_of_motor_alone = false;
  bool repeats = true;
  std::size_t starts = 0;
  const Cycle* cycle = nullptr;  ///< nullptr of an irregular motion

  double extent() const { return std::max(load, motor); }
};

Swing swing_of(const Cycle& cycle) {
  return {cycle.amplitude,
          cycle.motor_amplitude,
          cycle.error,
          cycle.period,
          cycle.encoder_steps,
          is_of_motor_alone(cycle),
          true,
          cycle.starts,
          &cycle};
}

Swing swing_of(const IrregularMotion& motion) {
  return {motion.amplitude,     motion.motor_amplitude.value_or(0.0),
          motion.error,         motion.mean_period,
          motion.encoder_steps, motion.is_motor_alone && motion.motor_amplitude,
          motion.repeats(),     motion.starts};
}

std::string swing_text(const AnswerReport& report, const Swing& swing) {
  const DriveUnits units = headline_units(report);
  const std::string at = swing.period ? units.pace(*swing.period) : "";
  if (swing.is_of_motor_alone) {
    return "the motor within the gap, " + units.swing(swing.motor) + at +
           ", while the load stands" + error_text(report, swing.error, 0.0);
  }
  return (swing.repeats ? "" : "up to ") + units.swing(swing.load) + at +
         quantization_text(report, swing.encoder_steps) +
         error_text(report, swing.error, swing.load);
}

/// The motion that the verdict is about, then the others.
std::vector<Swing> swings_of(const Answer& answer) {
  std::vector<Swing> swings;
  if (const Cycle* cycle = answer.largest_stable()) swings.push_back(swing_of(*cycle));
  for (const IrregularMotion& motion : answer.irregular) swings.push_back(swing_of(motion));
  return swings;
}

/// The motion that small displacements lead to, where a search has it; else that of the verdict.
std::optional<Swing> first_swing(const Answer& answer) {
  if (answer.search) {
    std::optional<Swing> largest;
    for (const std::size_t i : smallest_starts(*answer.search)) {
      const StartOutcome& start = answer.search->starts[i];
      if (!start.which) continue;
      const Swing swing = start.end == "cycle" ? swing_of(answer.cycles[*start.which])
                                               : swing_of(answer.irregular[*start.which]);
      if (!largest || swing.extent() > largest->extent()) largest = swing;
    }
    if (largest) return largest;
  }
  const std::vector<Swing> swings = swings_of(answer);
  return swings.empty() ? std::nullopt : std::optional(swings.front());
}

std::string motion_text(const AnswerReport& report) {
  const std::optional<Swing> swing = first_swing(report.answer);
  return swing ? swing_text(report, *swing) : "amplitude not known";
}

/// "after steps from 0.07 rad on"; the smaller step if the directions differ. Empty if it is not
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
  return "after steps from " + headline_units(report).angle(least->from) + way + " on";
}

/// ", after up to 12 min", where that is minutes or more.
std::string minutes_text(const AnswerReport& report) {
  const std::optional<double> time = report.answer.value(Quantity::time_to_rest);
  constexpr double minute = 60.0;
  if (headline_units(report).is_normalized() || !time || *time < minute) return "";
  constexpr double hour = 60.0;  // min
  constexpr double day = 24.0 * hour;
  const double minutes = *time / minute;
  const auto [unit, name] = minutes < 2.0 * hour  ? std::pair(1.0, "min")
                            : minutes < 2.0 * day ? std::pair(hour, "h")
                                                  : std::pair(day, "days");
  return fmt::format(", after up to {:.2g} {}", minutes / unit, name);
}

/// "comes to rest, up to 5 arcmin off".
std::string rest_clause(const AnswerReport& report) {
  const std::optional<double> error = report.answer.value(Quantity::static_error);
  constexpr double unseen = 1e-6;  // of the backlash: rounding
  const std::string where = !error ? ""
                            : *error <= unseen * backlash_of(report.drive, report.answer)
                                ? " at the reference"
                                : error_text(report, *error, 0.0);
  return "comes to rest" + where + minutes_text(report);
}

/// What small displacements lead to.
std::string small_clause(const AnswerReport& report) {
  const Answer& answer = report.answer;
  switch (answer.verdict) {
    case Verdict::hunts:
      return (answer.rests_engaged ? "hunts, or rests with its faces together: " : "hunts: ") +
             motion_text(report);
    case Verdict::hunts_irregularly:
      return "hunts irregularly: " + motion_text(report);
    case Verdict::forced:
      return "forced oscillation: " + motion_text(report);
    case Verdict::grows_without_bound:
      return "grows without bound: no friction at all (damping 0)";
    case Verdict::undamped:
      return "undamped: every oscillation persists (damping 0, backlash 0)";
    case Verdict::hunts_if_disturbed:
    case Verdict::runs_away_if_disturbed:
      break;
    case Verdict::cannot_hunt:
      return "cannot hunt: " + (backlash_of(report.drive, report.answer) == 0.0
                                    ? "no backlash"
                                    : rest_clause(report));
    case Verdict::comes_to_rest:
      return rest_clause(report);
    case Verdict::runs_away:
      return name_of(answer.verdict);
    case Verdict::undecided:
      return "undecided" + (answer.growth_at_rest
                                ? ": growth at rest " + significant(*answer.growth_at_rest, 17)
                                : "");
  }
  // Some starts rest, others swing or run away: those of the smallest displacements.
  const auto ends = [&](const char* end) {
    return answer.search && any_of(smallest_starts(*answer.search), [&](std::size_t i) {
             return answer.search->starts[i].end == end;
           });
  };
  if (ends("cycle") || ends("irregular")) return "hunts: " + motion_text(report);
  const bool rests = answer.rest && !(answer.search && answer.search->count("rest") == 0);
  return rests && !ends("undecided") && !ends("diverges") ? rest_clause(report) : "";
}

/// What larger displacements lead to: hunting beside rest, or a much larger motion.
std::string larger_clause(const AnswerReport& report, const std::string& small) {
  const Answer& answer = report.answer;
  const std::vector<Swing> swings = swings_of(answer);
  if (swings.empty() || answer.verdict == Verdict::undecided) return "";
  const bool is_named = small.find("hunts") == 0 || small.find("forced") == 0;
  if (!is_named) {
    const std::string steps = steps_text(report, "hunting");
    return "hunts, " + swing_text(report, swings.front()) + ", " +
           (steps.empty() ? "if disturbed" : steps);
  }
  const Swing& largest = *std::max_element(swings.begin(), swings.end(), by(&Swing::extent));
  constexpr double much = 1.5;  // irregular motion varies
  const double named = first_swing(answer)->extent();
  if (largest.starts == 0 || largest.extent() <= much * named) {
    if (answer.verdict != Verdict::hunts_if_disturbed || !answer.search) return "";
    return fmt::format("comes to rest from {} of {}", answer.search->count("rest"),
                       starts_text(answer.search->starts.size()));
  }
  return fmt::format("{} of {} hunt by {}", largest.starts,
                     starts_text(answer.search->starts.size()),
                     headline_units(report).swing(largest.extent()));
}

/// Beyond that.
std::string runaway_clause(const AnswerReport& report) {
  const Answer& answer = report.answer;
  if (!answer.runaway() || answer.verdict == Verdict::runs_away) return "";
  const bool winds_up =
      any_of(answer.notes, [](const Note& note) { return note.code == "wind-up"; });
  const std::string steps = steps_text(report, "running away");
  return (winds_up ? "winds up and runs away " : "runs away ") +
         (steps.empty() ? fmt::format("from {} of {}", answer.search->count("diverges"),
                                      starts_text(answer.search->starts.size()))
                        : steps);
}

std::string open_clause(const AnswerReport& report) {
  if (!report.answer.search) return "";
  const std::size_t open = report.answer.search->count("undecided");
  if (open == 0) return "";
  return fmt::format("{} of {} undecided", open, starts_text(report.answer.search->starts.size()));
}

/// "(proved)", "(found from 24 starts)".
std::string certainty_clause(const Answer& answer) {
  if (answer.verdict == Verdict::undecided) return "";
  if (answer.certainty >= Certainty::enclosed) return " (proved)";
  if (answer.certainty == Certainty::computed) return " (computed)";
  if (!answer.search) return "";
  return fmt::format(" (found from {})", starts_text(answer.search->starts.size()));
}

}  // namespace

const Cycle* first_cycle(const Answer& answer) {
  const std::optional<Swing> swing = first_swing(answer);
  return swing ? swing->cycle : nullptr;
}

std::string headline(const AnswerReport& report) {
  const std::string small = small_clause(report);
  const bool is_stopped = report.answer.search && !report.answer.search->is_complete;
  const std::vector<std::string> clauses = {small, larger_clause(report, small),
                                            runaway_clause(report),
                                            is_stopped ? "stopped early" : "", open_clause(report)};
  return listed(clauses, std::identity(), "; ") + certainty_clause(report.answer);
}

}  // namespace gearlash
