#include "output/comparison_report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "model/reduced_drive.hpp"
#include "output/answer_parts.hpp"
#include "output/answer_report.hpp"
#include "output/parameter_text.hpp"

namespace gearlash {
namespace {

constexpr char nothing[] = "–";

AnswerReport answer_report_of(const ComparisonReport& report, std::size_t i) {
  const ComparedDrive& one = report.drives[i];
  return report_of(one.drive, *one.answer, report.provenance);
}

/// Of a column of the table.
DrawnUnit unit_shown(const ComparisonReport& report, Quantity quantity) {
  if (quantity == Quantity::phase_margin) return {"deg", std::numbers::pi / 180.0};
  if (quantity == Quantity::overshoot) return {"%", 0.01};
  return drawn_unit(quantity, report.drives.front().drive.angle_unit, is_normalized(report));
}

// ---- the table ----------------------------------------------------------------------------------

template <class Cell>
TextRow row_of(const ComparisonReport& report, std::string name, const Cell& cell) {
  TextRow row = {std::move(name)};
  for (const ComparedDrive& one : report.drives) row.push_back(one.answer ? cell(one) : nothing);
  return row;
}

TextRow row_of(const ComparisonReport& report, Quantity quantity) {
  const DrawnUnit unit = unit_shown(report, quantity);
  const bool is_word = info_of(quantity).kind == QuantityKind::choice;
  return row_of(report, name_with_unit(words_of(quantity), unit.name),
                [&](const ComparedDrive& one) {
                  const std::optional<double> value = one.answer->value(quantity);
                  if (is_word) return std::string(name_of(one.answer->verdict));
                  return value ? significant(*value / unit.size, usual_digits) : nothing;
                });
}

std::string stability_text(const ComparedDrive& one) {
  if (!one.answer->loop) return nothing;
  return one.answer->loop->is_stable ? "stable" : "not stable";
}

TextRows rows_of(const ComparisonReport& report) {
  const AngleUnit& angle = report.drives.front().drive.angle_unit;
  TextRows rows = {{report.axis ? report.axis->path : "drive"}};
  add_all(rows.front(), of_each(report.drives, &ComparedDrive::name));
  rows.push_back(row_of(report, "certainty", [](const ComparedDrive& one) {
    return std::string(name_of(one.answer->certainty));
  }));
  rows.push_back(row_of(report, "loop without the gap", stability_text));
  if (!is_normalized(report)) {
    rows.push_back(row_of(report, "loop stiffness (N m/rad)", [](const ComparedDrive& one) {
      return one.stiffness ? significant(*one.stiffness, usual_digits) : nothing;
    }));
  }
  const auto has_encoder = [](const ComparedDrive& one) { return one.encoder_step > 0.0; };
  if (any_of(report.drives, has_encoder)) {
    rows.push_back(row_of(report, name_with_unit("encoder step at the load", angle.name),
                          [&](const ComparedDrive& one) {
                            return significant(angle.from_radians(one.encoder_step), usual_digits);
                          }));
  }
  add_all(rows, of_each(report.quantities, [&](Quantity one) { return row_of(report, one); }));
  return rows;
}

// ---- what else to know --------------------------------------------------------------------------

/// "load, motor": those of which it holds.
template <class Holds>
std::string names_where(const ComparisonReport& report, const Holds& holds) {
  return listed(report.drives,
                [&](const ComparedDrive& one) { return one.answer && holds(one) ? one.name : ""; });
}

std::string unstable_text(const ComparisonReport& report) {
  const std::string names = names_where(report, [](const ComparedDrive& one) {
    return one.answer->loop && !one.answer->loop->is_stable;
  });
  if (names.empty()) return "";
  return "Not stable even without the gap: " + names +
         ". What happens there is not due to backlash alone, and a step response is left out. ";
}

/// Where the same controller with the sensor elsewhere is another one at the load: a firmware's
/// registers count turns of the shaft that is sensed.
std::string rescaled_text(const ComparisonReport& report) {
  const ComparedDrive& first = report.drives.front();
  const std::string list = listed(report.drives, [&](const ComparedDrive& one) -> std::string {
    const bool is_moved = one.drive.sensor.position != first.drive.sensor.position &&
                          one.drive.controller == first.drive.controller;
    if (!is_moved || !one.stiffness || !first.stiffness) return "";
    const double factor = *one.stiffness / *first.stiffness;
    constexpr double rounding = 1e-9;
    if (std::abs(factor - 1.0) <= rounding) return "";
    return one.name + " ×" + significant(factor, usual_digits);
  });
  if (list.empty()) return "";
  return "The controller's numbers count angles of the shaft that is sensed. So moving the sensor "
         "changes the loop stiffness from that with " +
         first.name + ": " + list + ". ";
}

std::string step_text(const ComparisonReport& report) {
  const auto is_of_step = [](Quantity one) { return info_of(one).scope == QuantityScope::step; };
  const ComparedDrive* stepped = first_of(
      report.drives, [](const ComparedDrive& one) { return one.answer && one.answer->step; });
  if (stepped == nullptr || !any_of(report.quantities, is_of_step)) return "";
  const std::string names = names_where(report, [](const ComparedDrive& one) {
    return one.answer->step && !one.answer->step->is_whole;
  });
  const std::string within = names_where(report, [](const ComparedDrive& one) {
    return one.answer->step &&
           std::abs(one.answer->step->step) < backlash_of(one.drive, *one.answer);
  });
  return "All make " + step_text(*stepped->answer->step, report.drives.front().drive) +
         (within.empty() ? ""
                         : "; it is less than the gap of " + within + ": --step gives another") +
         (names.empty() ? "." : "; it could not be followed to its end: " + names + ".");
}

/// Where the places differ.
std::string sensor_text(const ComparisonReport& report) {
  const SensorPlace first = report.drives.front().drive.sensor.position;
  bool differ = false;
  bool has_motor = false;
  for (const ComparedDrive& one : report.drives) {
    differ = differ || one.drive.sensor.position != first;
    has_motor = has_motor || one.drive.sensor.position == SensorPlace::motor;
  }
  if (!differ || !has_motor) return "";
  return "With the sensor on the motor the loop does not see where the load is in the gap. ";
}

}  // namespace

std::vector<Quantity> usual_quantities_compared() {
  return {Quantity::amplitude,    Quantity::motor_amplitude, Quantity::frequency,
          Quantity::error,        Quantity::ceiling,         Quantity::bandwidth,
          Quantity::phase_margin, Quantity::rise_time,       Quantity::overshoot,
          Quantity::settling_time};
}

bool is_normalized(const ComparisonReport& report) {
  return all_of(report.drives, [](const ComparedDrive& one) { return is_normalized(one.drive); });
}

std::optional<double> step_of(const ComparisonReport& report) {
  for (const ComparedDrive& one : report.drives) {
    if (one.answer && one.answer->step) return one.answer->step->step;
  }
  return std::nullopt;
}

std::vector<NamedDrive> named_along(const Axis& axis, const Drive& drive) {
  return of_each(axis.values, [&](double value) {
    NamedDrive one{.drive = drive};
    set_on(axis, one.drive, value);
    one.name = ParameterText(one.drive, axis.path).of(value);
    return one;
  });
}

std::string comparison_headlines(const ComparisonReport& report) {
  TextRows rows;
  for (std::size_t i = 0; i < report.drives.size(); ++i) {
    const bool is_known = report.drives[i].answer.has_value();
    rows.push_back(
        {report.drives[i].name, is_known ? headline(answer_report_of(report, i)) : "not reached"});
  }
  return table_text(rows);
}

std::string comparison_text(const ComparisonReport& report) {
  const std::string remarks =
      unstable_text(report) + rescaled_text(report) + sensor_text(report) + step_text(report);
  return comparison_headlines(report) + "\n" + fitted(table_text(rows_of(report)), usual_columns) +
         (remarks.empty() ? "" : "\n" + wrapped(remarks));
}

}  // namespace gearlash
