#include "output/design_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "model/reduced_drive.hpp"
#include "question/change/proved_values.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash {
namespace {

constexpr int few_digits = 3;
constexpr double degree = std::numbers::pi / 180.0;

/// What a change costs, in the order of names_of_costs(): of a closed form the figures of its
/// normal form, relative to the present ones.
std::vector<std::string> names_of_costs(const DesignReport& report) {
  if (report.design.present.answer.normal_form) return {"ω_n", "ζ", "K"};
  return {"error", "rise", "overshoot", "settles", "bandwidth", "phase margin"};
}

std::string change_between(const std::optional<double>& before,
                           const std::optional<double>& after) {
  if (!before || !after) return "";
  return *before == *after ? "0 %" : change_text(*after / *before);
}

TextRow costs_text(const DesignReport& report, const DriveWithValue& one) {
  if (const auto& before = report.design.present.answer.normal_form) {
    const NormalFormNumbers after = one.answer.normal_form.value_or(NormalFormNumbers{});
    return {change_between(before->natural_frequency, after.natural_frequency),
            significant(after.damping, few_digits),
            change_between(before->stiffness, after.stiffness)};
  }
  const auto error = one.answer.value(Quantity::error);
  const StepResponse response = one.answer.step.value_or(StepResponse{});
  const LinearLoop loop = one.answer.loop.value_or(LinearLoop{});
  const auto time = [](const std::optional<double>& seconds) {
    return seconds ? significant(*seconds, few_digits) + " s" : "";
  };
  return {error ? DriveUnits(report.drive, few_digits).angle(*error) : "",
          time(response.rise_time),
          response.overshoot ? fmt::format("{:.1f} %", 100.0 * *response.overshoot) : "",
          time(response.settling_time),
          loop.bandwidth ? significant(*loop.bandwidth, few_digits) + " Hz" : "",
          loop.phase_margin ? fmt::format("{:.1f} deg", *loop.phase_margin / degree) : ""};
}

std::string result_of(const DesignReport& report, const Answer& answer) {
  return result_text(answer, report.drive);
}

/// Of what was searched value by value the ends are those of a grid, and are named.
std::string interval_text(const ParameterText& shown, const FeasibleValues& values,
                          const Bounds& interval) {
  const bool from_start = interval.low <= values.searched.low;
  const bool to_end = interval.high >= values.searched.high;
  if (values.kind == SearchKind::searched || (!from_start && !to_end)) return shown.of(interval);
  if (from_start && to_end) return "any";
  return from_start ? "at most " + shown.at_most(interval.high)
                    : "at least " + shown.at_least(interval.low);
}

/// The first row of a parameter names it; further rows are alternatives.
TextRow row_text(const DesignReport& report, const DesignedParameter& parameter,
                 std::size_t index) {
  const FeasibleValues& values = parameter.values;
  const ParameterText text(report.drive, values.parameter);
  const DriveWithValue& one = parameter.results[index];
  const bool has_ratio = !text.is_word() && values.present != 0.0 && !std::isnan(values.present);
  const bool is_first = index == 0;
  const std::string change = one.value == values.present ? "0 %"
                             : has_ratio                 ? change_text(one.value / values.present)
                                                         : "";
  TextRow row = {is_first ? values.parameter : "  or", is_first ? text.of(values.present) : "",
                 interval_text(text, values, values.intervals[index]), change,
                 result_of(report, one.answer)};
  for (std::string& cell : costs_text(report, one)) row.push_back(std::move(cell));
  return row;
}

std::string table_of_results(const DesignReport& report) {
  TextRows rows = {{"parameter", "now", "meets the target", "change", "result"}};
  for (std::string& name : names_of_costs(report)) rows.front().push_back(std::move(name));
  for (const DesignedParameter& parameter : report.design.parameters) {
    for (std::size_t i = 0; i < parameter.values.intervals.size(); ++i) {
      rows.push_back(row_text(report, parameter, i));
    }
  }
  if (rows.size() == 1) return "";
  const std::string costs =
      report.design.present.answer.normal_form
          ? "ω_n, ζ and K show its cost"
          : "its result at the value nearest to the present one,\n" +
                step_text(report.design.present.answer.step.value_or(StepResponse{}),
                          report.drive) +
                ", and the linear loop without the gap";
  return "One change by itself, other parameters fixed; " + costs + "\n" + table_text(rows) + "\n";
}

/// Why no value meets the target.
std::string reason(const DesignReport& report, const DesignedParameter& parameter) {
  const FeasibleValues& values = parameter.values;
  const ParameterText shown(report.drive, values.parameter);
  if (values.searched.low == values.searched.high && values.searched.low == 0.0) {
    return "is 0 and has no multiples";
  }
  const Target& target = report.target;
  const bool asks_for_rest = target.no_hunting || target.no_hunting_if_disturbed ||
                             !std::isinf(target.permitted(Quantity::growth_at_rest).high);
  if (asks_for_rest && values.kind != SearchKind::searched &&
      values.parameter == path_of_backlash(report.drive)) {
    return "no value stops the hunting; the amplitude is proportional to it";
  }
  const std::string tried = values.kind == SearchKind::certified ? "" : " of those tried";
  const std::string what = shown.is_word()
                               ? "no choice"
                               : "no value" + tried + " from " + shown.of(values.searched.low) +
                                     " to " + shown.of(values.searched.high);
  const Axis searched{values.parameter, {values.searched.low, values.searched.high}};
  const bool may_go_on = !shown.is_word() && values.kind != SearchKind::certified &&
                         is_at_open_end(searched, report.drive, *values.closest);
  return what + "; closest is " + shown.of(*values.closest) + " (" +
         result_of(report, parameter.results.at(0).answer) + ")" +
         (may_go_on ? ", an end of that range: a wider one may have a value" : "");
}

std::string reasons(const DesignReport& report) {
  const auto line = [&](const DesignedParameter& parameter) {
    const FeasibleValues& values = parameter.values;
    const bool has_none = values.intervals.empty() && !values.stopped;
    return has_none ? "  " + values.parameter + ": " + reason(report, parameter) + "\n" : "";
  };
  const std::string text = listed(report.design.parameters, line, "");
  return text.empty() ? "" : "No value meets the target\n" + text + "\n";
}

/// In the order of BorderKind.
constexpr const char* border_texts[] = {
    "the target's limit is reached",
    "fold at {at}: a stable and an unstable limit cycle meet and end",
    "branching at {at}: another limit cycle crosses this one",
    "flip at {at}: a limit cycle of twice the period begins",
    "Neimark–Sacker bifurcation at {at}: a limit cycle gives way to motion on a torus",
    "grazing at {at}: a limit cycle touches \"{event}\"",
    "the period of a limit cycle grows beyond all bounds near {at}",
    "starts that lead to rest appear or vanish",
    "the motion changes; no limit cycle that was followed accounts for it"};

std::string border_text(const ParameterText& shown, const Border& border) {
  return fmt::format(fmt::runtime(border_texts[static_cast<std::size_t>(border.kind)]),
                     fmt::arg("at", shown.of(border.at)), fmt::arg("event", border.event));
}

std::string borders_text(const DesignReport& report) {
  TextRows rows;
  for (const DesignedParameter& parameter : report.design.parameters) {
    const ParameterText shown(report.drive, parameter.values.parameter);
    for (const Border& border : parameter.values.borders) {
      rows.push_back(
          {parameter.values.parameter, shown.of(border.end), border_text(shown, border)});
    }
  }
  if (rows.empty()) return "";
  rows.insert(rows.begin(), {"parameter", "end", "what happens there"});
  return "Where intervals end\n" + table_text(rows) + "\n";
}

/// Bounds usually enclose a limit to 1e-9 of its value; wider undecided parts are reported.
bool is_worth_naming(const FeasibleValues& values, const Bounds& part) {
  constexpr double narrow = 1e-6;
  return values.kind != SearchKind::certified || part.high - part.low > narrow * part.high;
}

/// The undecided parts of the ranges that were searched in this way.
std::string undecided_parts(const DesignReport& report, SearchKind kind) {
  constexpr std::size_t most_named = 4;
  std::string parts;
  for (const DesignedParameter& parameter : report.design.parameters) {
    const FeasibleValues& values = parameter.values;
    if (values.kind != kind) continue;
    const ParameterText shown(report.drive, values.parameter);
    std::size_t count = 0;
    for (const Bounds& part : values.undecided) {
      if (!is_worth_naming(values, part) || ++count > most_named) continue;
      parts += (parts.empty() ? "" : "; ") + values.parameter + " " + shown.of(part);
    }
    if (count > most_named) parts += fmt::format(" and {} more", count - most_named);
  }
  return parts;
}

/// What is proved of the intervals of a target on ceilings; empty for other targets.
std::string proofs_text(const DesignReport& report) {
  std::string text;
  for (const DesignedParameter& parameter : report.design.parameters) {
    const FeasibleValues& values = parameter.values;
    const ParameterText shown(report.drive, values.parameter);
    for (std::size_t i = 0; i < values.proofs.size(); ++i) {
      const IntervalProof& proof = values.proofs[i];
      text += "  " + values.parameter + " " + shown.of(values.intervals[i]) + ": ";
      if (proof.parts.empty()) {
        text += "searched, not proved: " + proof.reason + "\n";
        continue;
      }
      text += "proved for";
      for (const Bounds& part : proof.parts) {
        text += (&part == &proof.parts.front() ? " " : " and ") + shown.of(part);
      }
      text += fmt::format(" ({} {})\n", proof.boxes, proof.boxes == 1 ? "box" : "boxes");
    }
  }
  if (text.empty()) return "";
  const bool is_all = all_of(report.target.limits, &is_provable) && !report.target.no_hunting &&
                      !report.target.no_hunting_if_disturbed && !report.target.no_runaway;
  return (is_all ? "Every value of these parts meets the target\n"
                 : "Every value of these parts keeps the limits of ceilings\n") +
         text + "\n";
}

/// Whether the motion was searched at all, and not figures alone.
bool is_of_figures(const DesignReport& report, const FeasibleValues& values) {
  return values.searched_within == report.target;
}

/// A number that is 0 and has no multiples.
bool is_empty_range(const FeasibleValues& values) {
  return values.searched.low == values.searched.high && values.intervals.empty();
}

/// The parameters that were searched in this way: "load.friction, gearbox.ratio".
std::string names_of(const DesignReport& report, SearchKind kind) {
  return listed(report.design.parameters, [&](const DesignedParameter& parameter) {
    const FeasibleValues& values = parameter.values;
    const bool is_one =
        values.kind == kind && !is_empty_range(values) && !is_of_figures(report, values);
    return is_one ? values.parameter : "";
  });
}

std::string certified_text(const DesignReport& report) {
  const std::string names = names_of(report, SearchKind::certified);
  if (names.empty()) return "";
  std::string text = names_of(report, SearchKind::scanned).empty() &&
                             names_of(report, SearchKind::searched).empty()
                         ? "This list is complete"
                         : "The list is complete for " + names;
  text +=
      " within the range given, else from 0.001 to 1000 times the present value; for friction and "
      "feedback, up to ten times critical damping. Interval bounds over the whole range prove it.";
  const std::string open = undecided_parts(report, SearchKind::certified);
  if (open.empty()) return text;
  return text + " These parts are open, because they touch a limit to within rounding: " + open +
         ".";
}

std::string scanned_text(const DesignReport& report) {
  const std::string names = names_of(report, SearchKind::scanned);
  if (names.empty()) return "";
  std::string text =
      "Scanned, not proved: " + names + ". Many values were tried, and others may be missed.";
  const std::string open = undecided_parts(report, SearchKind::scanned);
  if (open.empty()) return text;
  return text +
         " No claim is made for these parts, because the motion does not repeat or takes too long "
         "to follow, and values that meet the target may come and go: " +
         open + ".";
}

std::string search_text(const DesignReport& report) {
  SearchedGrids grids(report.drive);
  for (const DesignedParameter& parameter : report.design.parameters) grids.add(parameter.values);
  if (grids.text().empty()) return "";
  std::string text =
      "Searched, not proved: at each value of a grid the drive was followed from many starts, or "
      "from a few where values on both sides miss the target (" +
      grids.text() + "). What is narrower than the distance of two values may be missed.";
  if (const std::string located = grids.located_text("Ends of intervals"); !located.empty()) {
    text += located + ", by following the drive from value to value, and were searched again.";
  }
  const std::string open = undecided_parts(report, SearchKind::searched);
  return open.empty() ? text : text + " Undecided: " + open + ".";
}

/// The conditions that were scanned within what the others permit: "bandwidth, overshoot".
std::string within_text(const DesignReport& report) {
  for (const DesignedParameter& parameter : report.design.parameters) {
    const FeasibleValues& values = parameter.values;
    if (is_empty(values.searched_within)) continue;
    const std::string where = is_of_figures(report, values) ? "" : " within these";
    return "These are computed at many values" + where + ", not bounded over them: " +
           listed(values.searched_within.limits,
                  [](const QuantityLimit& limit) { return words_of(limit.quantity); }) +
           ". What is narrower than the distance of two values may be missed.";
  }
  return "";
}

std::string stopped_searches(const DesignReport& report) {
  const auto text = [](const DesignedParameter& parameter) {
    return parameter.values.stopped
               ? "The search over " + parameter.values.parameter +
                     " was stopped: the values that it did not reach are undecided."
               : "";
  };
  return listed(report.design.parameters, text, " ");
}

std::string certainty(const DesignReport& report) {
  return certified_text(report) + " " + scanned_text(report) + " " + search_text(report) + " " +
         within_text(report) + " " + stopped_searches(report);
}

}  // namespace

std::string design_text(const DesignReport& report) {
  std::vector<const Answer*> answers = {&report.design.present.answer};
  for (const DesignedParameter& parameter : report.design.parameters) {
    for (const DriveWithValue& one : parameter.results) answers.push_back(&one.answer);
  }
  const Answer& present = report.design.present.answer;
  const char* met = report.design.met == Judgement::all    ? "met"
                    : report.design.met == Judgement::none ? "not met"
                    : is_known(report.target, present)
                        ? "on the limit of the target, to within rounding"
                        : "undecided";
  return fmt::format("target: {}\nat present: {}, {}\n\n", report.target_text,
                     result_of(report, present), met) +
         table_of_results(report) + borders_text(report) + reasons(report) + proofs_text(report) +
         wrapped(certainty(report)) + hidden_error_text(report.target, answers, report.drive);
}

std::vector<ParameterFacts> DesignReport::parameters() const {
  return of_each(design.parameters, [&](const DesignedParameter& one) {
    return facts_of(drive, one.values.parameter);
  });
}

}  // namespace gearlash
