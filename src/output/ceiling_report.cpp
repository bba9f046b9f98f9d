#include "output/ceiling_report.hpp"

#include <fmt/format.h>

#include "model/signal.hpp"
#include "output/columns.hpp"

namespace gearlash {
namespace {

std::string torque_text(double torque, const AnswerReport& report) {
  return fmt::format("±{} {}", significant(rounded_up(torque, usual_digits), usual_digits),
                     report.is_normalized ? "K rad" : "N m at the load");
}

std::string remark_on_limit(const Ceiling& ceiling) {
  if (!ceiling.meets_limit) return "";
  return *ceiling.meets_limit ? "below the torque limit" : "the torque limit may be reached";
}

/// Rounded down.
std::string lower_bound_text(double radians, const AnswerReport& report) {
  const AngleUnit& unit = report.angle;
  return significant(rounded_down(unit.from_radians(radians), usual_digits), usual_digits) + " " +
         unit.name;
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
  return "\n" +
         wrapped(fmt::format(
             "{}tarts displaced by up to ±{} from the motion with the gap closed never meet the "
             "torque limit, nor do starts on it whose speed differs by up to ±{}/s (proved).",
             has_ending_signal(report.drive) ? "Once the signals have ended, s" : "S",
             lower_bound_text(starts->position, report), lower_bound_text(starts->speed, report)));
}

std::string below_limit_text(const Ceiling& ceiling) {
  return ceiling.is_below_limit ? ", if its torque stays below the limit" : "";
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

std::optional<double> AnswerReport::widest_backlash() const {
  if (!answer.ceiling || !specification) return std::nullopt;
  const double backlash = drive.servo ? drive.servo->backlash : drive.gearbox.backlash;
  return answer.ceiling->widest_backlash(*specification, backlash);
}

std::string ceiling_text(const AnswerReport& report) {
  if (!report.answer.ceiling) return "";
  const Ceiling& ceiling = *report.answer.ceiling;
  if (!ceiling.load) {
    return "\n" + wrapped("No ceiling: " + ceiling.reason + ".") + mesh_torque_alone(report);
  }
  const auto angle = [&](double value) {
    return swing_bound_text(value, report.angle, usual_digits);
  };
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"load", angle(*ceiling.load), ""});
  if (ceiling.terms.size() > 1) {
    for (const CeilingTerm& term : ceiling.terms) {
      rows.push_back({"  " + term.source, angle(term.load), ""});
    }
  }
  rows.push_back({"motor", angle(*ceiling.motor), ""});
  if (ceiling.effort) {
    rows.push_back(
        {"motor torque", torque_text(*ceiling.effort, report), remark_on_limit(ceiling)});
  }
  if (ceiling.mesh_torque) {
    rows.push_back({"mean mesh torque", torque_text(*ceiling.mesh_torque, report), ""});
  }
  return "\nCeiling: what no motion exceeds in the end" + below_limit_text(ceiling) +
         " (proved)\n" + table_text(rows) + safe_starts_text(report);
}

std::string specification_text(const AnswerReport& report) {
  if (!report.specification || !report.answer.ceiling) return "";
  const Ceiling& ceiling = *report.answer.ceiling;
  const std::string wanted =
      "±" + significant(report.angle.from_radians(*report.specification), usual_digits) + " " +
      report.angle.name;
  if (!ceiling.load) return "";  // the reason stands where the ceiling would be
  const std::optional<double> widest = report.widest_backlash();
  if (widest) {
    return "\n" +
           wrapped(fmt::format(
               "Specification: every backlash up to {} provably keeps the load within {} in "
               "the end. This drive {}.",
               lower_bound_text(*widest, report), wanted,
               *ceiling.load <= *report.specification ? "meets it" : "is not proved to meet it"));
  }
  return "\n" + wrapped(fmt::format(
                    "Specification: no backlash is proved to keep the load within {}: what else "
                    "disturbs the loop may move it further.",
                    wanted));
}

}  // namespace gearlash
