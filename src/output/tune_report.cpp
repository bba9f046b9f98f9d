#include "output/tune_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "output/drive_text.hpp"
#include "output/parameter_text.hpp"

namespace gearlash {
namespace {

constexpr int tuned_digits = 4;
constexpr double turn = 2.0 * std::numbers::pi;

const Drive& present_drive(const TuneReport& report) { return report.task.series.nominal; }

std::string parameter_text(const TuneReport& report, const std::string& path, double value) {
  return ParameterText(present_drive(report), path).of(value);
}

/// "gearbox.backlash = 1 deg, load.inertia = 0.2 kg m2".
template <class Named>
std::string values_text(const TuneReport& report, const std::vector<Named>& named,
                        const std::vector<double>& values) {
  return listed(indices(values.size()), [&](std::size_t i) {
    return named[i].path + " = " + parameter_text(report, named[i].path, values[i]);
  });
}

std::string table_of_values(const TuneReport& report) {
  TextRows rows = {{"parameter", "now", "tuned", "change", "sought"}};
  for (std::size_t i = 0; i < report.tuned.values.size(); ++i) {
    const Axis& axis = report.task.tuned[i];
    const double now = present_value(axis, present_drive(report)).value_or(std::nan(""));
    const double tuned = report.tuned.values[i];
    rows.push_back({axis.path, parameter_text(report, axis.path, now),
                    parameter_text(report, axis.path, tuned),
                    now > 0.0 ? change_text(tuned / now) : "",
                    ParameterText(present_drive(report), axis.path)
                        .of(Bounds{axis.values.front(), axis.values.back()})});
  }
  return table_text(rows);
}

std::string reached_text(const TuneReport& report, const TunedDrive& tuned) {
  if (std::isnan(tuned.reached)) return "";
  switch (report.task.aim) {
    case Aim::bandwidth:
      return ", with a bandwidth of at least " + significant(tuned.reached / turn, tuned_digits) +
             " Hz";
    case Aim::settling:
      return ", settling within " + significant(tuned.reached, tuned_digits) + " s";
    case Aim::static_error:
      return ", with a static error of at most " +
             DriveUnits(present_drive(report), tuned_digits).angle(tuned.reached);
  }
  return "";
}

std::string count_text(const TunedDrive& tuned) {
  if (tuned.units == 0) return "No unit was tried, so none is known to meet";
  if (tuned.units == 1) return tuned.met == 1 ? "The drive meets" : "The drive does not meet";
  if (tuned.met == tuned.units) return fmt::format("All {} units tried meet", tuned.units);
  return fmt::format("{} of {} units tried meet", tuned.met, tuned.units);
}

std::string outcome_text(const TuneReport& report) {
  const TunedDrive& tuned = report.tuned;
  std::string text = count_text(tuned) + " the target";
  if (tuned.meets) return text + reached_text(report, tuned) + ".";
  text = (tuned.stopped ? "The search was stopped; the best values by then are shown. "
                        : "Nothing found that meets the target; the best by count is shown. ") +
         text + ".";
  if (tuned.undecided > 0) {
    text += fmt::format(" What {} of the others do was not decided.", tuned.undecided);
  }
  return text;
}

std::string limiting_text(const TuneReport& report) {
  const std::optional<TunedUnit>& unit = report.tuned.limiting;
  if (!unit) return "";
  const std::string text = values_text(report, report.task.series.varied, unit->values);
  const bool is_searched = unit->answer.verdict != Verdict::undecided || unit->answer.search;
  const std::string what = is_searched ? result_text(unit->answer, present_drive(report))
                                       : "its linear loop lacks the phase margin";
  if (text.empty()) return "What it does then: " + what + ".";
  const bool all_meet = report.tuned.met == report.tuned.units;
  return (all_meet ? "The unit that limits, as an earlier proposal had it: "
                   : "The unit that misses it most: ") +
         text + " (" + what + ").";
}

/// What to give up where nothing meets the target.
std::string advice_text(const TuneReport& report) {
  if (report.tuned.meets) return "";
  std::string text;
  if (const auto why = report.why_integral_action_hunts()) text = *why + ". ";
  if (const std::optional<TunedDrive>& without = report.without_integral) {
    text += "Without integral action: " + count_text(*without) + " the target" +
            reached_text(report, *without) + " (" +
            values_text(report, without_integral_action(report.task)->tuned, without->values) +
            "). A static error then remains, and a steady torque on the load adds to it.";
  }
  return text;
}

std::string effort_text(const TuneReport& report) {
  const TunedDrive& tuned = report.tuned;
  std::string text = fmt::format("Searched, not proved, by {} analyses", tuned.analyses);
  if (tuned.units > 1) {
    text += fmt::format(
        ". Each of {} proposals was put to {} units: the mean one, corners of the tolerances and "
        "points of Sobol's sequence. Other units may miss the target",
        tuned.rounds, tuned.units);
  }
  if (tuned.by_derivatives) text += ". The last values were closed in on by derivatives";
  return text + ". Other values may be better.";
}

}  // namespace

std::vector<Note> TuneReport::notes() const {
  std::vector<Note> found;
  for (std::size_t i = 0; i < tuned.values.size(); ++i) {
    const Axis& axis = task.tuned[i];
    if (!is_at_open_end(axis, present_drive(*this), tuned.values[i])) continue;
    found.push_back({"range-end", axis.path + " ends at the end of its range, " +
                                      parameter_text(*this, axis.path, tuned.values[i]) +
                                      ": a wider range may be better (--parameters " + axis.path +
                                      "=FROM:TO)."});
  }
  return found;
}

std::string tune_text(const TuneReport& report) {
  return fmt::format("target: {}\nat present: {}\ntuned: {}\n\n", report.target_text,
                     result_text(report.present, present_drive(report)),
                     result_text(report.nominal, present_drive(report))) +
         table_of_values(report) + further_paragraph(outcome_text(report)) +
         further_paragraph(listed(report.notes(), &Note::text, " ")) +
         further_paragraph(limiting_text(report)) + further_paragraph(advice_text(report)) +
         further_paragraph(effort_text(report)) +
         hidden_error_text(report.task.target, {&report.nominal}, present_drive(report));
}

std::optional<std::string> TuneReport::why_integral_action_hunts() const {
  return gearlash::why_integral_action_hunts(present_drive(*this));
}

std::string tuned_toml(const TuneReport& report) {
  return fmt::format("# Tuned by: {}\n# {} the target: {}\n\n", report.provenance.command,
                     count_text(report.tuned), report.target_text) +
         to_toml(TolerancedDrive{report.tuned.drive, report.task.series.varied});
}

}  // namespace gearlash
