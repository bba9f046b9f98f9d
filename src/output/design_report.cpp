#include "output/design_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/design/target.hpp"
#include "output/columns.hpp"
#include "output/drive_text.hpp"
#include "output/json_values.hpp"

namespace gearlash {
namespace {

constexpr int limit_digits = 6;

/// The limit in few digits, rounded to the wanted side of the exact value.
std::string rounded(double value, bool up) {
  std::string text = significant(value, limit_digits);
  const double read = std::stod(text);
  if (value == 0.0 || (up ? read >= value : read <= value)) return text;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - (limit_digits - 1));
  return significant(read + (up ? unit : -unit), limit_digits);
}

/// The unit of a parameter in text: the author's unit of angles for the backlash, else SI.
struct ShownUnit {
  std::string name;
  double size = 1.0;
};

ShownUnit shown_unit(const DesignReport& report, const std::string& parameter) {
  const ChangeableNumber& number = report.drive.number(parameter);
  if (number.is_backlash()) return {" " + report.angle.name, report.angle.radians};
  return {number.unit == "1" ? "" : " " + number.unit, 1.0};
}

std::string interval_text(const Bounds& interval, const Bounds& searched, const ShownUnit& unit) {
  const std::string low = rounded(interval.low / unit.size, true);
  const std::string high = rounded(interval.high / unit.size, false);
  const bool from_start = interval.low <= searched.low;
  const bool to_end = interval.high >= searched.high;
  if (from_start && to_end) return "any";
  if (from_start) return "at most " + high + unit.name;
  if (to_end) return "at least " + low + unit.name;
  return low + " to " + high + unit.name;
}

/// The relative change; empty if the present value is 0.
std::string change_from(double present, double value) {
  if (value == present) return "0 %";
  return present == 0.0 ? "" : change_text(value / present);
}

std::string performance_text(const Performance& performance, const DesignReport& report) {
  if (performance.verdict == Verdict::cannot_hunt) {
    return "at rest (growth " + significant(performance.growth_at_rest, 3) + ")";
  }
  if (std::isnan(performance.amplitude)) return name_of(performance.verdict);
  std::string text = swing_text(performance.amplitude, report.angle, 3);
  if (!report.is_normalized) text += " at " + significant(performance.frequency, 3) + " Hz";
  return text;
}

/// The value nearest to the present one within an interval.
double nearest_in(const Bounds& interval, double present) {
  return std::clamp(present, interval.low, interval.high);
}

std::vector<std::string> header() {
  return {"parameter", "now", "meets the target", "change", "ω_n", "ζ", "K", "result"};
}

/// The first row of a parameter names it; further rows are alternatives.
std::vector<std::string> interval_row(const DesignReport& report, const FeasibleValues& values,
                                      std::size_t index) {
  const std::string& parameter = values.parameter;
  const Bounds& interval = values.intervals[index];
  const ShownUnit unit = shown_unit(report, parameter);
  const double value = nearest_in(interval, values.present);
  const Drivetrain& present = report.drive.drivetrain();
  const Drivetrain changed = report.drive.with(parameter, value);
  const bool is_first = index == 0;
  return {is_first ? parameter : "  or",
          is_first ? significant(values.present / unit.size, limit_digits) + unit.name : "",
          interval_text(interval, values.searched, unit),
          change_from(values.present, value),
          change_from(natural_frequency(present), natural_frequency(changed)),
          significant(normalize(changed).damping, 3),
          change_from(present.stiffness, changed.stiffness),
          performance_text(performance_of(changed), report)};
}

/// One line on why no value meets the target.
std::string reason(const DesignReport& report, const FeasibleValues& values) {
  const ShownUnit unit = shown_unit(report, values.parameter);
  const auto shown = [&](double value) {
    return significant(value / unit.size, limit_digits) + unit.name;
  };
  std::string text = values.parameter + ": ";
  if (values.searched.low == values.searched.high) return text + "is 0 and has no multiples";
  if (report.drive.number(values.parameter).is_backlash() &&
      (report.target.no_hunting || report.target.no_hunting_if_disturbed ||
       !std::isinf(report.target.permitted(Quantity::growth_at_rest).high))) {
    return text + "no value stops the hunting; the amplitude is proportional to it";
  }
  text += fmt::format("no value from {} to {}", shown(values.searched.low),
                      shown(values.searched.high));
  text += values.kind == SearchKind::certified ? "" : " of those tried";
  const Performance closest = performance_of(report.drive.with(values.parameter, *values.closest));
  return text + fmt::format("; closest is {} with {} (growth at rest {})", shown(*values.closest),
                            performance_text(closest, report),
                            significant(closest.growth_at_rest, 3));
}

/// Bounds usually enclose a limit to 1e-9 of its value; wider undecided parts are reported.
bool is_worth_naming(const FeasibleValues& answer) {
  constexpr double narrow = 1e-6;
  return std::any_of(answer.undecided.begin(), answer.undecided.end(), [&](const Bounds& part) {
    return answer.kind == SearchKind::scanned || part.high - part.low > narrow * part.high;
  });
}

/// The undecided parts of the range of all parameters with this kind of search.
std::string undecided_parts(const DesignReport& report, SearchKind kind) {
  std::string parts;
  for (const FeasibleValues& answer : report.answers) {
    if (answer.kind != kind || !is_worth_naming(answer)) continue;
    const ShownUnit unit = shown_unit(report, answer.parameter);
    parts += (parts.empty() ? "" : "; ") + answer.parameter;
    constexpr std::size_t most_named = 4;
    const std::size_t named = std::min(most_named, answer.undecided.size());
    for (std::size_t i = 0; i < named; ++i) {
      const Bounds& part = answer.undecided[i];
      parts += fmt::format("{} {} to {}{}", i == 0 ? "" : ",", rounded(part.low / unit.size, false),
                           rounded(part.high / unit.size, true), unit.name);
    }
    if (named < answer.undecided.size()) {
      parts += fmt::format(" and {} more", answer.undecided.size() - named);
    }
  }
  return parts;
}

std::string certainty(const DesignReport& report) {
  if (!report.answers.empty() && report.answers.back().stopped) {
    return "The search over " + report.answers.back().parameter +
           " was stopped. This list is not complete.";
  }
  std::string text =
      "This list is complete for 0.001 to 1000 times the present value; for friction and feedback, "
      "up to ten times critical damping. Interval bounds over the whole range prove it";
  std::string scanned;
  for (const FeasibleValues& answer : report.answers) {
    if (answer.kind == SearchKind::certified) continue;
    scanned += (scanned.empty() ? "" : ", ") + answer.parameter;
  }
  text += scanned.empty() ? "."
                          : ", except for " + scanned +
                                ": with bounces, many values were tried, and others may be missed.";
  if (const std::string open = undecided_parts(report, SearchKind::certified); !open.empty()) {
    text += " These parts are open, because they touch a limit to within rounding: " + open + ".";
  }
  if (const std::string open = undecided_parts(report, SearchKind::scanned); !open.empty()) {
    text +=
        " No claim is made for these parts, because the motion does not repeat or takes too long "
        "to "
        "follow, and values that meet the target may come and go: " +
        open + ".";
  }
  return text;
}

Json json_loop(const Drivetrain& drive) {
  return {{"natural_frequency", json_number(natural_frequency(drive))},
          {"damping", json_number(normalize(drive).damping)},
          {"stiffness", json_number(drive.stiffness)}};
}

/// A value of the parameter and the drive's behaviour with it.
Json json_value(const DesignReport& report, const FeasibleValues& values, double value) {
  const Drivetrain changed = report.drive.with(values.parameter, value);
  const double change = values.present == 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                              : 100.0 * (value / values.present - 1.0);
  return {{"value", json_number(value)},
          {"change_percent", json_number(change)},
          {"performance", json_performance(performance_of(changed))},
          {"loop", json_loop(changed)}};
}

Json json_answer(const DesignReport& report, const FeasibleValues& values) {
  const ChangeableNumber& number = report.drive.number(values.parameter);
  const std::optional<double> nearest = values.nearest();
  return {{"parameter", number.name},
          {"description", number.description},
          {"unit", number.unit},
          {"present", json_number(values.present)},
          {"searched", json_bounds(values.searched)},
          {"certified", values.kind == SearchKind::certified && !values.stopped},
          {"stopped", values.stopped},
          {"intervals", json_list(values.intervals, &json_bounds)},
          {"undecided", json_list(values.undecided, &json_bounds)},
          {"nearest", nearest ? json_value(report, values, *nearest) : Json(nullptr)},
          {"closest", nearest ? Json(nullptr) : json_value(report, values, *values.closest)}};
}

/// Whether the present drive meets the target; with plastic contact only as far as proved for the
/// data.
Judgement judge_present(const DesignReport& report, const Performance& present) {
  const Drivetrain& drive = report.drive.drivetrain();
  if (servo_dynamics(normalize(drive)).plastic_contact()) {
    return judge(report.target, report.drive.box(), present.flight_time);
  }
  return is_met(report.target, present) ? Judgement::all : Judgement::none;
}

const char* words_of(Judgement judgement) {
  if (judgement == Judgement::some) return "on the limit of the target, to within rounding";
  return judgement == Judgement::all ? "met" : "not met";
}

Json json_of(Judgement judgement) {
  if (judgement == Judgement::some) return nullptr;
  return judgement == Judgement::all;
}

}  // namespace

std::string design_text(const DesignReport& report) {
  const Performance present = performance_of(report.drive.drivetrain());
  std::string text =
      fmt::format("target: {}\nat present: {}, {}\n\n", report.target_text,
                  performance_text(present, report), words_of(judge_present(report, present)));
  std::vector<std::vector<std::string>> rows = {header()};
  std::string reasons;
  for (const FeasibleValues& answer : report.answers) {
    for (std::size_t i = 0; i < answer.intervals.size(); ++i) {
      rows.push_back(interval_row(report, answer, i));
    }
    if (answer.intervals.empty() && !answer.stopped)
      reasons += "  " + reason(report, answer) + "\n";
  }
  if (rows.size() > 1) {
    text += "One change by itself, other parameters fixed; ω_n, ζ and K show its cost\n" +
            table_text(rows) + "\n";
  }
  if (!reasons.empty()) text += "No value meets the target\n" + reasons + "\n";
  return text + wrapped(certainty(report));
}

std::string design_json(const DesignReport& report) {
  const Performance present = performance_of(report.drive.drivetrain());
  Json json = json_head("design", report.drive.drive(), report.provenance);
  json["target"] = report.target_text;
  json["met"] = json_of(judge_present(report, present));
  json["present"] = {{"performance", json_performance(present)},
                     {"loop", json_loop(report.drive.drivetrain())}};
  json["answers"] = json_list(
      report.answers, [&](const FeasibleValues& answer) { return json_answer(report, answer); });
  return json.dump(2) + "\n";
}

}  // namespace gearlash
