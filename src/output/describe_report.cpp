#include "output/describe_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "model/reduced_drive.hpp"
#include "output/answer_report.hpp"

namespace gearlash {
namespace {

using drive::DescribedMotion;
using drive::DescribingAnalysis;
using drive::ExactMotion;
using drive::PredictionError;

const char* stability(bool stable) { return stable ? "stable" : "unstable"; }

// ---- text ---------------------------------------------------------------------------------------

std::string with_capital(std::string text) {
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

TextRow motion_row(const std::string& name, const ExactMotion& motion,
                   const DescribeReport& report) {
  const DriveUnits units(report.drive);
  return {name, units.swing(motion.amplitude), units.swing(motion.motor_amplitude),
          units.time(motion.period), units.frequency(motion.period)};
}

TextRow error_row(const PredictionError& error) {
  const auto text = [](double part) { return change_text(1.0 + part); };
  return {"  error", text(error.amplitude), text(error.motor_amplitude), text(error.period),
          text(error.frequency)};
}

bool is_forced(const DescribeReport& report) { return report.answer.verdict == Verdict::forced; }

/// The text for a stable predicted cycle without an exact motion near it.
std::string without_exact(const DescribeReport& report, const std::vector<ExactMotion>& exact) {
  if (report.answer.verdict == Verdict::undecided) return "undecided";
  const bool has_stable = any_of(exact, [](const ExactMotion& motion) { return motion.is_stable; });
  return has_stable ? "no stable motion near it" : "no stable cycle";
}

/// Each predicted cycle beside the exact motion that it predicts.
std::string cycle_table(const DescribingAnalysis& analysis, const DescribeReport& report) {
  TextRows rows = {{"", "amplitude", "motor", "period", "frequency"}};
  const std::vector<ExactMotion> exact = drive::exact_motions(report.answer);
  for (const DescribedMotion& cycle : analysis.cycles) {
    if (drive::is_unseen(cycle, report.backlash)) continue;
    const std::string kind = stability(cycle.balance.stable);
    rows.push_back(motion_row("predicted, " + kind,
                              {cycle.amplitude, cycle.motor_amplitude, cycle.balance.period},
                              report));
    if (is_forced(report)) continue;
    const std::optional<PredictionError>& error = cycle.error;
    if (!error && cycle.balance.stable) rows.push_back({"  exact", without_exact(report, exact)});
    if (!error) continue;
    rows.push_back(motion_row("  exact", exact[error->exact], report));
    rows.push_back(error_row(*error));
  }
  return table_text(rows);
}

bool has_cycle_to_tell(const DescribingAnalysis& analysis, const DescribeReport& report) {
  return any_of(analysis.cycles, [&](const DescribedMotion& cycle) {
    return !drive::is_unseen(cycle, report.backlash);
  });
}

/// "s² + 0.38 s + 5".
std::string polynomial_text(const std::vector<double>& coefficients) {
  std::string text;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const double coefficient = coefficients[i];
    if (coefficient == 0.0) continue;
    const std::size_t power = coefficients.size() - 1 - i;
    const std::string factor = significant(std::abs(coefficient), usual_digits);
    text += coefficient < 0.0 ? (text.empty() ? "−" : " − ") : (text.empty() ? "" : " + ");
    if (power == 0 || factor != "1") text += factor + (power > 0 ? " " : "");
    if (power > 0) text += "s";
    if (power > 1) text += power < 4 ? (power == 2 ? "²" : "³") : fmt::format("^{}", power);
  }
  return text.empty() ? "0" : text;
}

/// "= 25/(s² + 5 s)", or the order of a function too long to print.
std::string transfer_text(const TransferFunction& transfer) {
  constexpr std::size_t longest = 6;
  if (transfer.denominator.size() > longest) {
    return fmt::format("of order {}; its coefficients are in the JSON",
                       transfer.denominator.size() - 1);
  }
  const auto in_brackets = [](const std::vector<double>& coefficients) {
    const std::string text = polynomial_text(coefficients);
    return text.find(' ') == std::string::npos ? text : "(" + text + ")";
  };
  const bool has_denominator = transfer.denominator != std::vector<double>{1.0};
  std::string text = "= ";
  text += has_denominator
              ? in_brackets(transfer.numerator) + "/" + in_brackets(transfer.denominator)
              : polynomial_text(transfer.numerator);
  if (transfer.delay > 0.0)
    text += fmt::format(" · e^(−{} s)", significant(transfer.delay, usual_digits));
  return text;
}

std::string unresolved_text(const DescribingAnalysis& analysis) {
  if (analysis.unresolved.empty()) return "";
  const Bounds whole{analysis.unresolved.front().low, analysis.unresolved.back().high};
  return fmt::format(
      "Between the angular frequencies {} and {} the balance is undecided, because its solutions "
      "fill a range or merge there. ",
      significant(whole.low, usual_digits), significant(whole.high, usual_digits));
}

std::string assumptions_text(const DescribingAnalysis& analysis) {
  const std::string text = listed(
      analysis.assumptions, [](drive::Assumption one) { return name_of(one); }, "; ");
  return text.empty() ? "" : "Assumed: " + text + ".";
}

std::string analysis_text(const DescribingAnalysis& analysis, const DescribeReport& report) {
  std::string text = with_capital(name_of(analysis.part)) + "\n";
  if (!is_in_loop(analysis)) {
    return text + "  no cycle: nothing is fed back through it\n";
  }
  text += has_cycle_to_tell(analysis, report) ? cycle_table(analysis, report)
                                              : "  no cycle predicted\n";
  text += "  L(s) " + transfer_text(analysis.loop) + "\n";
  const std::string remarks = unresolved_text(analysis) + assumptions_text(analysis);
  return remarks.empty() ? text : text + wrapped(remarks, usual_columns, "  ");
}

}  // namespace

DescribeReport describe_report_of(const Drive& drive, const Answer& answer,
                                  const Provenance& provenance) {
  const drive::ReducedDrive reduced = reduce(drive);
  std::vector<DescribingAnalysis> analyses = drive::describing_analyses(reduced);
  set_errors(analyses, answer);
  return {.analyses = std::move(analyses),
          .drive = drive,
          .answer = answer,
          .backlash = reduced.backlash,
          .provenance = provenance};
}

std::string describe_text(const DescribeReport& report) {
  std::string text = headline(report.drive, report.answer) + "\n";
  for (const DescribingAnalysis& analysis : report.analyses) {
    text += "\n" + analysis_text(analysis, report);
  }
  return text;
}

}  // namespace gearlash
