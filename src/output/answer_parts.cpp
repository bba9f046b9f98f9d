#include "output/answer_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "model/reduced_drive.hpp"
#include "model/signal.hpp"

namespace gearlash {

// ---- the meaning --------------------------------------------------------------------------------

namespace {

constexpr int digits = 3;

/// In the order of Certainty.
constexpr const char* certainty_texts[] = {
    "A search found this; it is not proved.", "This is computed, not proved.",
    "This is proved: interval arithmetic decides the condition of a theorem for this drive.",
    "This is proved."};

std::string certainty_text(const Answer& answer) {
  return certainty_texts[static_cast<std::size_t>(answer.certainty)];
}

bool is_proved(const Answer& answer) { return answer.certainty >= Certainty::enclosed; }

std::string persistence(const Answer& answer) {
  if (answer.rests_engaged) {
    return "A large motion may end at rest, with the faces together on either side. A small motion "
           "in the gap grows. ";
  }
  return is_proved(answer) ? "From almost every start the load never comes to rest. "
                           : "The load does not come to rest. ";
}

/// Other starts that end in irregular motion; empty if none was found.
std::string other_motion(const AnswerReport& report) {
  if (report.answer.irregular.empty()) return "";
  return "Other starts end in a motion that was not seen to repeat, up to " +
         DriveUnits(report.drive, digits).swing(report.answer.irregular.front().amplitude) + ". ";
}

std::string meaning_when_hunting(const AnswerReport& report) {
  const Answer& answer = report.answer;
  const Cycle* cycle = answer.largest_stable();
  if (cycle == nullptr) {
    return persistence(answer) +
           "The motion was not seen to repeat. It stayed within the reported amplitude for as long "
           "as it was followed.";
  }
  const std::string share =
      significant(cycle->amplitude / answer.normal_form->backlash, digits) + " times the backlash";
  const std::string where = cycle->kind == CycleKind::symmetric
                                ? ", centered on the reference. "
                                : ", centered beside the reference. ";
  const std::string end = is_proved(answer)
                              ? "It ends in an oscillation with an amplitude of " + share
                              : "The largest stable oscillation found has an amplitude of " + share;
  return persistence(answer) + end + where + other_motion(report) +
         "The amplitude is proportional to the backlash, and the frequency does not depend on it. "
         "So no backlash is small enough to stop the hunting. To stop it, the growth at rest must "
         "be below 1. " +
         certainty_text(answer);
}

std::string meaning_when_quiet(const Answer& answer) {
  const NormalFormNumbers& form = *answer.normal_form;
  if (form.backlash == 0.0) return "Without backlash there is no hunting.";
  std::string text = "From every start the load tends to the reference. ";
  const bool is_massless = form.inertia_ratio == 0.0 || std::isinf(form.inertia_ratio);
  const bool is_plastic = form.restitution == 0.0 || is_massless;
  if (is_plastic && answer.growth_at_rest && *answer.growth_at_rest > 0.0) {
    text +=
        "The motor keeps crossing the gap. Each crossing takes longer, because the load is nearer "
        "to the reference. ";
  }
  if (answer.is_dissipative) {
    text +=
        "The servo cannot hunt with any restitution, because everything outside the gap only takes "
        "energy from the motion. ";
  }
  return text + "This holds for any backlash, because only damping and ratios matter. " +
         certainty_text(answer);
}

std::string meaning_when_undecided(const Answer& answer) {
  if (answer.neutral_swings) {
    return "Some oscillations neither grow nor decay, to within rounding (multiplier 1). The servo "
           "lies on a boundary, where any change of a parameter decides.";
  }
  if (answer.bounds) {
    const Bounds& growth = answer.bounds->growth_at_rest;
    return fmt::format(
        "The servo lies on the boundary of hunting. Its growth at rest is 1 to within {}, the "
        "width of the interval that contains it: {} … {}.",
        significant(growth.high - growth.low, 2), significant(growth.low, 17),
        significant(growth.high, 17));
  }
  return "The numerics could not decide. The table has what is known.";
}

std::string meaning_of_solution(const AnswerReport& report) {
  const Answer& answer = report.answer;
  switch (answer.verdict) {
    case Verdict::cannot_hunt:
      return meaning_when_quiet(answer);
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
      return meaning_when_hunting(report);
    case Verdict::hunts_if_disturbed:
      return "Rest is stable. A large enough disturbance leads to an oscillation that does not "
             "stop. " +
             certainty_text(answer);
    case Verdict::grows_without_bound:
      return "There is no friction at all. Every swing through the backlash is larger than the one "
             "before. " +
             certainty_text(answer);
    case Verdict::undamped:
      return "There is neither friction nor backlash. The load keeps the oscillation that it "
             "started with.";
    default:
      return meaning_when_undecided(answer);
  }
}

std::string meaning_by_energy(const Answer& answer) {
  return "Every motion comes to rest. The contact and the dry frictions only take energy, whatever "
         "the restitution, and so does everything else. No search was needed. " +
         certainty_text(answer);
}

// ---- the search ---------------------------------------------------------------------------------

/// "24 to a cycle, 12 to rest".
std::string ends_text(const Answer& answer) {
  const SearchRecord& search = *answer.search;
  const std::size_t repeating = count_of(search.starts, [&](const StartOutcome& start) {
    return start.end == "irregular" && start.which && answer.irregular[*start.which].repeats();
  });
  const std::pair<std::size_t, const char*> ends[] = {
      {search.count("cycle"), "to a cycle"},
      {search.count("rest"), "to rest"},
      {repeating, "to motion whose swings repeat"},
      {search.count("irregular") - repeating, "to motion that was not seen to repeat"},
      {search.count("diverges"), "to runaway"},
      {search.count("undecided"), "undecided"}};
  return listed(ends, [](const auto& end) {
    return end.first == 0 ? "" : fmt::format("{} {}", end.first, end.second);
  });
}

std::string search_text(const AnswerReport& report) {
  const DriveUnits units(report.drive, all_digits);
  const SearchRecord& search = *report.answer.search;
  const double reference =
      drive::value_at(drive::settled(report.drive.reference.value_or(0.0)), 0.0);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  double longest = 0.0;
  for (const StartOutcome& start : search.starts) {
    longest = std::max(longest, start.watched);
    const double distance = std::abs(start.load_position - reference);
    if (distance > 0.0) nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  std::string text = fmt::format(
      "Searched from {}, with the load {} to {} from the reference. Each was followed for up to "
      "{}: {}. Shooting closed the cycles. ",
      starts_text(search.starts.size()), units.angle(nearest), units.angle(farthest),
      units.time(longest), ends_text(report.answer));
  const std::size_t found = count_of(report.answer.cycles, [](const Cycle& cycle) {
    return cycle.stability == Stability::unstable;
  });
  text += search.borders == 0
              ? "No border between starts with different ends had to be searched. "
              : fmt::format(
                    "Searched {} border{} between starts with different ends and found {} unstable "
                    "cycle{}. ",
                    search.borders, search.borders == 1 ? "" : "s", found, found == 1 ? "" : "s");
  if (!search.is_complete) text += "The search was stopped early. ";
  return text + "A search is no proof: it misses what no start leads to.";
}

}  // namespace

std::string meaning_text(const AnswerReport& report) {
  if (report.answer.engine != Engine::general) return meaning_of_solution(report);
  if (report.answer.search) return search_text(report);
  return report.answer.verdict == Verdict::cannot_hunt ? meaning_by_energy(report.answer) : "";
}

std::string short_meaning_text(const AnswerReport& report) {
  if (!report.answer.search || report.answer.engine != Engine::general) return meaning_text(report);
  return "Searched from " + starts_text(report.answer.search->starts.size()) + ": " +
         ends_text(report.answer) + ". A search is no proof: it misses what no start leads to.";
}

// ---- the ceiling --------------------------------------------------------------------------------

namespace {

std::string torque_text(double torque, const AnswerReport& report) {
  return fmt::format("±{} {}", significant(rounded_up(torque, usual_digits), usual_digits),
                     is_normalized(report.drive) ? "K rad" : "N m at the load");
}

std::string remark_on_limit(const Ceiling& ceiling) {
  if (!ceiling.meets_limit) return "";
  return *ceiling.meets_limit ? "below the torque limit" : "the torque limit may be reached";
}

/// Whether the reference or the load torque moves until a time and then goes on as it is analysed.
bool has_ending_signal(const Drive& drive) {
  const auto ends = [](const std::optional<Signal>& signal) {
    return signal && drive::settling_time(*signal) > 0.0;
  };
  return ends(drive.reference) || ends(drive.load_torque);
}

std::string safe_starts_text(const AnswerReport& report) {
  const std::optional<SafeStarts>& starts = report.answer.ceiling->safe_starts;
  if (!starts) return "";
  const DriveUnits units(report.drive);
  return further_paragraph(fmt::format(
      "{}tarts displaced by up to ±{} from the motion with the gap closed never meet the torque "
      "limit, nor do starts on it whose speed differs by up to ±{}/s (proved).",
      has_ending_signal(report.drive) ? "Once the signals have ended, s" : "S",
      units.at_least(starts->position), units.at_least(starts->speed)));
}

/// The bound of the mesh torque of a drive whose swing has none.
std::string mesh_torque_alone(const AnswerReport& report) {
  const Ceiling& ceiling = *report.answer.ceiling;
  if (!ceiling.mesh_torque) return "";
  return wrapped(
      fmt::format("In the end the mean mesh torque of every motion is within {}{} "
                  "(proved).",
                  torque_text(*ceiling.mesh_torque, report), below_limit_text(ceiling)));
}

}  // namespace

std::string below_limit_text(const Ceiling& ceiling) {
  return ceiling.is_below_limit ? ", if it stays off its limits" : "";
}

std::optional<double> AnswerReport::widest_backlash() const {
  if (!answer.ceiling || !drive.specification.error) return std::nullopt;
  const double backlash = drive.servo ? drive.servo->backlash : drive.gearbox.backlash;
  return answer.ceiling->widest_backlash(*drive.specification.error, backlash);
}

std::string ceiling_text(const AnswerReport& report) {
  if (!report.answer.ceiling) return "";
  const Ceiling& ceiling = *report.answer.ceiling;
  if (!ceiling.load) {
    return further_paragraph("No ceiling: " + ceiling.reason + ".") + mesh_torque_alone(report);
  }
  const auto angle = [&](double value) { return DriveUnits(report.drive).swing_at_most(value); };
  TextRows rows = {{"load", angle(*ceiling.load)}};
  if (ceiling.terms.size() > 1) {
    for (const CeilingTerm& term : ceiling.terms) {
      rows.push_back({"  " + term.source, angle(term.load)});
    }
  }
  rows.push_back({"motor", angle(*ceiling.motor)});
  if (ceiling.effort) {
    rows.push_back(
        {"motor torque", torque_text(*ceiling.effort, report), remark_on_limit(ceiling)});
  }
  if (ceiling.mesh_torque) {
    rows.push_back({"mean mesh torque", torque_text(*ceiling.mesh_torque, report)});
  }
  return "\nCeiling: what no motion exceeds in the end" + below_limit_text(ceiling) +
         " (proved)\n" + table_text(rows) + safe_starts_text(report);
}

// ---- measured hunting ---------------------------------------------------------------------------

namespace {

/// The larger ratio of the two, of whatever direction.
double distance(const MotionBesideMeasured& motion) {
  return std::max(std::abs(std::log1p(motion.amplitude_share)),
                  std::abs(std::log1p(motion.frequency_share)));
}

std::string share_text(double share) { return fmt::format("{:+.3g} %", 100.0 * share); }

}  // namespace

std::vector<MotionBesideMeasured> AnswerReport::beside_measured() const {
  std::vector<MotionBesideMeasured> all;
  if (!measured) return all;
  const auto add = [&](const char* list, std::size_t index, double amplitude, double frequency) {
    if (!(amplitude > 0.0)) return;
    all.push_back({list, index, amplitude, frequency, measured->amplitude / amplitude - 1.0,
                   measured->frequency / frequency - 1.0});
  };
  for (std::size_t i = 0; i < answer.cycles.size(); ++i) {
    const Cycle& cycle = answer.cycles[i];
    if (cycle.stability == Stability::unstable) continue;
    add("cycles", i, cycle.amplitude, cycle.frequency());
  }
  for (std::size_t i = 0; i < answer.irregular.size(); ++i) {
    const IrregularMotion& motion = answer.irregular[i];
    if (!motion.mean_period || motion.is_motor_alone) continue;
    add("irregular", i, motion.amplitude, 1.0 / *motion.mean_period);
  }
  sort_by(all, distance);
  return all;
}

std::string measured_text(const AnswerReport& report) {
  if (!report.measured) return "";
  const DriveUnits units(report.drive);
  const auto motion = [&](double amplitude, double frequency) {
    return units.swing(amplitude) + " at " + units.number(frequency) + " Hz";
  };
  const MeasuredHunting& measured = *report.measured;
  const std::vector<MotionBesideMeasured> all = report.beside_measured();
  const std::string text =
      "\nMeasured: " + motion(measured.amplitude, measured.frequency) + ", beside what was found\n";
  if (all.empty()) return text + "  no motion of the load that does not fade\n";
  TextRows rows;
  for (const MotionBesideMeasured& one : all) {
    const bool is_cycle = one.list == "cycles";
    rows.push_back(
        {fmt::format("{} {}", is_cycle ? "limit cycle" : "irregular motion", one.index + 1),
         motion(one.amplitude, one.frequency),
         "amplitude " + share_text(one.amplitude_share) + ", frequency " +
             share_text(one.frequency_share)});
  }
  return text + table_text(rows);
}

}  // namespace gearlash
