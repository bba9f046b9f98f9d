#include "output/answer_meaning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

constexpr int digits = 3;

std::string certainty_text(const Answer& answer) {
  switch (answer.certainty) {
    case Certainty::searched:
      return "A search found this; it is not proved.";
    case Certainty::computed:
      return "This is computed, not proved.";
    case Certainty::enclosed:
      return "This is proved: interval arithmetic decides the condition of a theorem for this "
             "drive.";
    case Certainty::theorem:
      return "This is proved.";
  }
  return "";
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
         swing_text(report.answer.irregular.front().amplitude, report.angle, digits) + ". ";
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
  const auto repeating = static_cast<std::size_t>(
      std::count_if(search.starts.begin(), search.starts.end(), [&](const StartOutcome& start) {
        return start.end == "irregular" && start.which && answer.irregular[*start.which].repeats();
      }));
  std::string text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(search.count("cycle"), "to a cycle");
  add(search.count("rest"), "to rest");
  add(repeating, "to motion whose swings repeat");
  add(search.count("irregular") - repeating, "to motion that was not seen to repeat");
  add(search.count("diverges"), "to runaway");
  add(search.count("undecided"), "undecided");
  return text;
}

std::string search_text(const AnswerReport& report) {
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
      starts_text(search.starts.size()), angle_text(nearest, report.angle, 6),
      angle_text(farthest, report.angle, 6), time_text(longest, report.is_normalized, 6),
      ends_text(report.answer));
  const auto found =
      std::count_if(report.answer.cycles.begin(), report.answer.cycles.end(),
                    [](const Cycle& cycle) { return cycle.stability == Stability::unstable; });
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

}  // namespace gearlash
