#include "output/ceiling_report.hpp"

#include <fmt/format.h>

#include "output/columns.hpp"
#include "output/json_values.hpp"

namespace gearlash {
namespace {

constexpr int digits = 4;

std::string torque_text(double torque, const AnswerReport& report) {
  return fmt::format("±{} {}", significant(rounded_up(torque, digits), digits),
                     report.is_normalized ? "K rad" : "N m at the load");
}

std::string remark_on_limit(const Ceiling& ceiling) {
  if (!ceiling.meets_limit) return "";
  return *ceiling.meets_limit ? "below the torque limit" : "the torque limit may be reached";
}

}  // namespace

std::string ceiling_text(const AnswerReport& report) {
  if (!report.answer.ceiling) return "";
  const Ceiling& ceiling = *report.answer.ceiling;
  if (!ceiling.load) return "\n" + wrapped("No ceiling: " + ceiling.reason + ".");
  const auto angle = [&](double value) { return swing_bound_text(value, report.angle, digits); };
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
  return "\nCeiling: what no motion exceeds in the end" +
         std::string(ceiling.is_below_limit ? ", if its torque stays below the limit" : "") +
         " (proved)\n" + table_text(rows);
}

nlohmann::ordered_json ceiling_json(const std::optional<Ceiling>& ceiling) {
  if (!ceiling) return nullptr;
  const auto text = [](const std::string& words) {
    return words.empty() ? Json(nullptr) : Json(words);
  };
  return {{"value", json_optional(ceiling->load)},
          {"motor", json_optional(ceiling->motor)},
          {"effort", json_optional(ceiling->effort)},
          {"reason", text(ceiling->reason)},
          {"effort_reason", text(ceiling->effort_reason)},
          {"below_limit", ceiling->is_below_limit},
          {"meets_limit", ceiling->meets_limit ? Json(*ceiling->meets_limit) : Json(nullptr)},
          {"terms", json_list(ceiling->terms, [](const CeilingTerm& term) {
             return Json{{"source", term.source},
                         {"size", json_number(term.size)},
                         {"load", json_number(term.load)},
                         {"motor", json_number(term.motor)},
                         {"effort", json_optional(term.effort)}};
           })}};
}

}  // namespace gearlash
