#include "output/comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/analyse.hpp"
#include "analysis/repetition.hpp"
#include "base/progress_part.hpp"
#include "base/range_check.hpp"
#include "input/drive_file.hpp"
#include "model/linear_drive.hpp"
#include "output/columns.hpp"
#include "output/drive_text.hpp"
#include "output/json_values.hpp"

namespace gearlash {
namespace {

const AnswerReport& first_of(const ComparisonReport& report) { return report.cases.front().report; }

std::string angle(const ComparisonReport& report, double radians) {
  return angle_text(radians, first_of(report).angle, usual_digits);
}

std::string time(const ComparisonReport& report, const std::optional<double>& seconds) {
  if (!seconds) return "–";
  return time_text(*seconds, first_of(report).is_normalized, usual_digits);
}

// ---- cells --------------------------------------------------------------------------------------

std::string amplitude_text(const ComparisonReport& report, const SensorCase& one) {
  const Answer& answer = one.report.answer;
  if (const Cycle* cycle = answer.largest_stable()) {
    if (is_of_motor_alone(*cycle)) return "motor ±" + angle(report, cycle->motor_amplitude);
    return "±" + angle(report, cycle->amplitude);
  }
  if (answer.irregular.empty()) return "–";
  const IrregularMotion& motion = answer.irregular.front();
  if (motion.is_motor_alone && motion.motor_amplitude) {
    return "motor ±" + angle(report, *motion.motor_amplitude);
  }
  return (repeats(motion) ? "±" : "up to ±") + angle(report, motion.amplitude);
}

std::string pace_text(const ComparisonReport& report, const SensorCase& one) {
  const Answer& answer = one.report.answer;
  std::optional<double> period;
  if (const Cycle* cycle = answer.largest_stable()) {
    period = cycle->period;
  } else if (!answer.irregular.empty()) {
    period = answer.irregular.front().mean_period;
  }
  if (!period) return "–";
  if (first_of(report).is_normalized) return "period " + time(report, *period);
  return significant(1.0 / *period, usual_digits) + " Hz";
}

std::string static_error(const ComparisonReport& report, const SensorCase& one) {
  const Answer& answer = one.report.answer;
  const bool is_known = answer.verdict == Verdict::cannot_hunt ||
                        (answer.search && answer.search->count("undecided") == 0);
  if (!answer.rest) return is_known ? "never at rest" : "not known";
  const double low = answer.rest->error.low;
  const double high = answer.rest->error.high;
  const double size = std::max(std::abs(low), std::abs(high));
  // Rest at a single place prints as one number.
  if (high - low <= 1e-6 * size) return angle(report, low);
  const AngleUnit& unit = first_of(report).angle;
  return significant(unit.from_radians(low), usual_digits) + " … " + angle(report, high);
}

double encoder_step(const SensorCase& one) { return reduce(one.report.drive).sensing.resolution; }

std::string resolution(const ComparisonReport& report, const SensorCase& one) {
  const double step = encoder_step(one);
  return step > 0.0 ? angle(report, step) : "–";
}

template <class Cell>
std::vector<std::string> row(const ComparisonReport& report, const std::string& name,
                             const Cell& cell) {
  std::vector<std::string> cells = {name};
  for (const SensorCase& one : report.cases) cells.push_back(cell(one));
  return cells;
}

std::string meaning(const ComparisonReport& report) {
  std::string text;
  for (const SensorCase& one : report.cases) {
    if (one.place == SensorPlace::motor) {
      text +=
          "With the sensor on the motor, the gap is outside the loop. The loop does not see where "
          "the load is in the gap. ";
    } else if (one.place == SensorPlace::both) {
      text += "With both, the position is the load's and the speed is the motor's";
      text += linear_drive(reduce(one.report.drive)).uses_speed()
                  ? ". "
                  : ", which this controller does not use. ";
    }
  }
  for (const SensorCase& one : report.cases) {
    if (one.response.is_whole) continue;
    text += fmt::format("With the sensor on {}, the step response could be followed only for {}. ",
                        name_of(one.place), time(report, one.response.until));
  }
  return text +
         "A search from several starts found the rest and the cycles (limit-cycle reports each). "
         "Step responses are exact motions from rest.";
}

}  // namespace

ComparisonReport compare_sensors(const Drive& drive, const std::vector<SensorPlace>& places,
                                 const drive::Step& step, const ReportStyle& style,
                                 Progress& progress) {
  if (places.empty()) {
    require_none({{"sensors", "", "must name load, motor or both", ""}});
  }
  ComparisonReport report{.cases = {}, .provenance = style.provenance};
  for (const SensorPlace place : places) {
    ProgressPart part(progress, report.cases.size(), places.size());
    Drive placed = drive;
    placed.sensor.position = place;
    placed.sensor.speed.reset();
    const drive::ReducedDrive reduced = reduce(placed);
    const Answer answer = answer_of(drive::find_attractors(reduced, {}, part), reduced);
    ProgressPart at_end(part, 1.0, 1.0);
    const StepResponse response = drive::step_response(reduced, step.size, step.until, at_end);
    report.cases.push_back({.place = place,
                            .report = report_of(placed, answer, style.angle, style.provenance),
                            .response = response});
  }
  return report;
}

drive::Step step_of_comparison(const Drive& drive, std::optional<double> size,
                               std::optional<double> until, const StepFields& fields) {
  drive::Step step = drive::usual_step(reduce(drive));
  step.size = size.value_or(step.size);
  step.until = until.value_or(step.until);
  RangeCheck check;
  if (step.size == 0.0) check.refuse(fields.size, "0", "must be an angle other than 0");
  if (!(step.until > 0.0)) check.refuse(fields.until, exact_text(step.until), "must be positive");
  require_none(check.faults());
  return step;
}

std::string comparison_text(const ComparisonReport& report) {
  const auto response = [&](const auto& number) {
    return [&report, number](const SensorCase& one) { return time(report, number(one.response)); };
  };
  const StepResponse& first = report.cases.front().response;
  std::vector<std::vector<std::string>> rows = {
      row(report, "sensor on",
          [](const SensorCase& one) { return std::string(name_of(one.place)); }),
      row(report, "encoder step at the load",
          [&](const SensorCase& one) { return resolution(report, one); }),
      row(report, "hunting",
          [](const SensorCase& one) { return std::string(name_of(one.report.answer.verdict)); }),
      row(report, "  amplitude, load",
          [&](const SensorCase& one) { return amplitude_text(report, one); }),
      row(report, "  frequency", [&](const SensorCase& one) { return pace_text(report, one); }),
      row(report, "error at rest, load",
          [&](const SensorCase& one) { return static_error(report, one); }),
      row(report, "step of " + angle(report, first.step),
          [](const SensorCase&) { return std::string(); }),
      row(report, "  rise, 10 % to 90 %",
          response([](const StepResponse& one) { return one.rise_time; })),
      row(report, "  overshoot",
          [](const SensorCase& one) {
            const std::optional<double>& overshoot = one.response.overshoot;
            return overshoot ? fmt::format("{:.1f} %", 100.0 * *overshoot) : "–";
          }),
      row(report, "  settled to 5 %",
          response([](const StepResponse& one) { return one.settling_time; })),
      row(report, "  error at the end",
          [&](const SensorCase& one) { return angle(report, one.response.final_error); }),
      row(report, "  amplitude at the end",
          [&](const SensorCase& one) { return "±" + angle(report, one.response.ripple); })};
  return table_text(rows) + "\n" + wrapped(meaning(report));
}

std::string comparison_json(const ComparisonReport& report) {
  Json json = json_head("compare", report.provenance);
  json["cases"] = json_list(report.cases, [](const SensorCase& one) {
    const StepResponse& response = one.response;
    return Json{{"sensor", name_of(one.place)},
                {"encoder_step", json_number(encoder_step(one))},
                {"step_response",
                 {{"step", json_number(response.step)},
                  {"watched", json_number(response.until)},
                  {"rise_time", json_optional(response.rise_time)},
                  {"overshoot", json_optional(response.overshoot)},
                  {"settling_time", json_optional(response.settling_time)},
                  {"band", json_number(response.band)},
                  {"final_error", json_number(response.final_error)},
                  {"ripple", json_number(response.ripple)}}},
                {"limit_cycle", Json::parse(answer_json(one.report))}};
  });
  return json.dump(2) + "\n";
}

}  // namespace gearlash
