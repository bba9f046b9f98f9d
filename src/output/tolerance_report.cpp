#include "output/tolerance_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "base/overloaded.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/output.hpp"
#include "model/reduced_drive.hpp"
#include "output/parameter_text.hpp"

namespace gearlash {
namespace {

/// Two standard errors: about 95 % of such intervals contain the true value.
constexpr double bar = 2.0;

DriveUnits units_of(const ToleranceReport& report) { return DriveUnits(report.drive.nominal); }

/// "amplitude", "amplitude of the motor".
std::string amplitude_name(const ToleranceReport& report) {
  return report.amplitude == Quantity::motor_amplitude ? "amplitude of the motor" : "amplitude";
}

/// "12.3 ± 0.2 %": a probability with two standard errors. Where all of n samples agree, a share of
/// 3/n stays open: that many exceptions are missed by 5 % of such samples.
std::string percent_text(const Estimate& estimate, std::size_t samples) {
  const double open = 300.0 / static_cast<double>(samples);
  if (estimate.value == 0.0) {
    return fmt::format("none of {}, so at most {} %", samples, significant(open, 2));
  }
  if (estimate.value == 1.0) {
    return fmt::format("all {}, so at least {} %", samples,
                       significant(100.0 - open, usual_digits));
  }
  return fmt::format("{} ± {} %", significant(100.0 * estimate.value, usual_digits),
                     significant(100.0 * bar * *estimate.standard_error, 2));
}

std::string amplitude_text(const std::optional<Estimate>& estimate, const ToleranceReport& report) {
  return estimate ? units_of(report).swing(estimate->value) : "none";
}

std::string frequency_text(const std::optional<Estimate>& estimate) {
  return estimate ? significant(estimate->value, usual_digits) + " Hz" : "none";
}

/// The shares that hunt and that meet the target, each as `text` shows it.
template <class Text>
TextRows share_rows(const ToleranceReport& report, const Text& text) {
  TextRows rows = {{"hunt", text(report.study.hunting)}};
  if (!report.target_text.empty()) {
    rows.push_back({"meet \"" + report.target_text + "\"", text(report.study.yield)});
  }
  return rows;
}

TextRows headline_rows(const ToleranceReport& report) {
  const ToleranceStudy& study = report.study;
  TextRows rows = share_rows(
      report, [&](const Estimate& share) { return percent_text(share, study.sampling.samples()); });
  rows.push_back(
      {amplitude_name(report) + ", mean of all", amplitude_text(study.mean_amplitude, report)});
  return rows;
}

TextRows quantile_rows(const ToleranceReport& report) {
  const DriveUnits units = units_of(report);
  const ToleranceStudy& study = report.study;
  TextRows rows = {{"share of samples up to", "error in the end", amplitude_name(report),
                    "amplitude, of those that hunt"}};
  if (!units.is_normalized()) rows.front().emplace_back("frequency");
  for (std::size_t i = 0; i < study.amplitude.size(); ++i) {
    TextRow row = {significant(100.0 * study.amplitude[i].share, usual_digits) + " %",
                   units.angle(study.error[i].value->value),
                   amplitude_text(study.amplitude[i].value, report),
                   amplitude_text(study.amplitude_of_hunting[i].value, report)};
    if (!units.is_normalized()) row.push_back(frequency_text(study.frequency[i].value));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string index_text(const std::optional<SensitivityIndices>& indices,
                       Estimate SensitivityIndices::*index) {
  if (!indices) return "–";
  // The error of the estimate may make it negative.
  return fmt::format("{:.3f}", std::max(0.0, ((*indices).*index).value));
}

ParameterText text_of(const std::string& path, const ToleranceReport& report) {
  return {report.drive.nominal, path, usual_digits};
}

/// "± 5 %", "0.05 rad to 0.15 rad", "normal, 3 %", "2 lots".
std::string spread_text(const ParameterTolerance& varied, const ToleranceReport& report) {
  const auto share = [](double spread, double nominal) {
    return significant(100.0 * spread / std::abs(nominal), usual_digits) + " %";
  };
  const auto value = [number = text_of(varied.path, report)](double one) { return number.of(one); };
  return std::visit(
      Overloaded{
          [&](const ExactValue& exact) { return value(exact.value); },
          [&](const UniformBetween& between) {
            return value(between.min) + " to " + value(between.max);
          },
          [&](const UniformAbout& about) {
            return "± " + (about.nominal == 0.0 ? value(about.tolerance)
                                                : share(about.tolerance, about.nominal));
          },
          [&](const Normal& normal) {
            std::string text =
                "normal, " + (normal.mean == 0.0 ? value(normal.standard_deviation)
                                                 : share(normal.standard_deviation, normal.mean));
            if (normal.min) text += ", from " + value(*normal.min);
            if (normal.max) text += ", to " + value(*normal.max);
            return text;
          },
          [&](const DiscreteLots& lots) { return fmt::format("{} lots", lots.lots.size()); }},
      varied.distribution);
}

/// Two standard errors of the least certain index.
double widest_bar(const SensitivityStudy& study) {
  double widest = 0.0;
  for (const NumberSensitivity& number : study.numbers) {
    for (const auto& indices : {number.of_amplitude, number.of_hunting}) {
      if (!indices) continue;
      for (const Estimate& estimate : {indices->first_order, indices->total}) {
        widest = std::max(widest, bar * estimate.standard_error.value_or(0.0));
      }
    }
  }
  return widest;
}

std::string worst_number_text(const WorstNumber& worst, const ToleranceReport& report) {
  return text_of(worst.path, report).of(worst.value) + ", " + name_of(worst.place);
}

TextRows number_rows(const ToleranceReport& report) {
  TextRows rows = {
      {"parameter", "varies", "amplitude", "in all", "hunting", "in all", "worst sample"}};
  for (std::size_t i = 0; i < report.drive.varied.size(); ++i) {
    const ParameterTolerance& varied = report.drive.varied[i];
    const NumberSensitivity& indices = report.sensitivities.numbers[i];
    const bool has_worst = !report.worst.numbers.empty();
    rows.push_back({varied.path, spread_text(varied, report),
                    index_text(indices.of_amplitude, &SensitivityIndices::first_order),
                    index_text(indices.of_amplitude, &SensitivityIndices::total),
                    index_text(indices.of_hunting, &SensitivityIndices::first_order),
                    index_text(indices.of_hunting, &SensitivityIndices::total),
                    has_worst ? worst_number_text(report.worst.numbers[i], report) : "not known"});
  }
  return rows;
}

/// Empty where the search for it was stopped.
std::string worst_text(const ToleranceReport& report) {
  if (report.worst.numbers.empty()) return "";
  const detail::SampleResult& worst = report.worst.result;
  const DriveUnits units = units_of(report);
  std::string text = "The worst sample found within the tolerances ";
  if (worst.verdict == Verdict::cannot_hunt && !std::isnan(worst.growth_at_rest)) {
    text += "cannot hunt (growth at rest " + significant(worst.growth_at_rest, usual_digits) + ")";
  } else {
    text += name_of(worst.verdict);
    if (worst.amplitude > 0.0 && std::isfinite(worst.amplitude)) {
      text += ": " + units.swing(worst.amplitude);
      if (!units.is_normalized()) {
        text += " at " + significant(worst.frequency, usual_digits) + " Hz";
      }
    }
  }
  const std::string how =
      is_searched(report.drive)
          ? ". Ends of the tolerances were tried, unlimited normal distributions being cut at "
            "three "
            "standard deviations."
          : ". A climbing search found it, with unlimited normal distributions cut at three "
            "standard deviations.";
  return further_paragraph(text + how);
}

bool has_limit(const Drive& drive) {
  const drive::ReducedDrive reduced = reduce(drive);
  return std::isfinite(reduced.torque_limit) || std::isfinite(reduced.winding.torque_limit);
}

std::string proved_text(const ToleranceReport& report) {
  const EnclosedCeiling& proved = report.proved;
  if (!proved.bound && proved.reason.empty()) return "";  // not reached
  if (!proved.bound) {
    return further_paragraph("Not proved: a bound of all samples within the tolerances (" +
                             proved.reason + ").");
  }
  std::string text = "Proved: no sample within the tolerances swings by more than " +
                     units_of(report).swing_at_most(*proved.bound) + " in the end" +
                     (has_limit(report.drive.nominal) ? ", if its torque stays off the limit" : "");
  text += fmt::format(" (the ceiling, over {} {}", proved.parts,
                      proved.parts == 1 ? "box" : "boxes of parameters");
  if (proved.largest) {
    text += "; of single drives it reaches " + units_of(report).swing_at_most(*proved.largest);
  }
  return further_paragraph(text + ").");
}

std::string backlash_text(const ToleranceReport& report) {
  if (report.demanded_yield == 0.0) return "";
  const std::string demand = significant(100.0 * report.demanded_yield, usual_digits) + " %";
  if (!report.backlash) {
    return further_paragraph("No tolerance of the backlash gives a yield of " + demand + ".");
  }
  const WidestBacklash& widest = *report.backlash;
  const auto angle = [&](double value) {
    return std::isinf(value) ? std::string("any") : units_of(report).angle(value);
  };
  return further_paragraph(fmt::format(
      "A yield of {} needs a backlash from {} to at most {} ({} to {} within the error of the "
      "estimate).",
      demand, angle(widest.min), angle(widest.max), angle(widest.uncertainty.low),
      angle(widest.uncertainty.high)));
}

std::string counts_text(const ToleranceReport& report) {
  const ToleranceStudy& study = report.study;
  std::string text = fmt::format(
      "{} samples: {} times {} points of Sobol's sequence, shifted at random (seed {}). Error bars "
      "are two standard errors.",
      study.sampling.samples(), study.sampling.replicates, study.sampling.points,
      study.sampling.seed);
  if (study.undecided + study.unknown_amplitudes + study.refused > 0) {
    text += fmt::format(
        " Undecided: {}; hunting with an unknown amplitude: {}; draws that are no drive: {}.",
        study.undecided, study.unknown_amplitudes, study.refused);
  }
  if (study.hidden_errors > 0) {
    text += fmt::format(
        " Of the samples that meet the target {} end farther off than the amplitude that it "
        "permits: \"error <= …\" limits where the load ends, static error and hunting together.",
        study.hidden_errors);
  }
  return further_paragraph(text);
}

/// What is known of a study that was stopped.
std::string stopped_text(const ToleranceReport& report) {
  const ToleranceStudy& study = report.study;
  const TextRows rows = share_rows(report, [](const Estimate& share) {
    return std::isnan(share.value) ? "not known" : significant(100.0 * share.value, 3) + " %";
  });
  return fmt::format("Of the {} samples, out of {}, that were answered before the stop\n",
                     study.answered, study.sampling.samples()) +
         table_text(rows);
}

std::string decisive_text(const ToleranceReport& report) {
  if (report.sensitivities.numbers.empty()) return "";
  return fmt::format(
             "\nWhat decides: the share of the variance of the amplitude, and of hunting, that "
             "each\nparameter causes alone, and in all, together with others (Sobol's indices, "
             "± {})\n",
             significant(widest_bar(report.sensitivities), 1)) +
         table_text(number_rows(report));
}

}  // namespace

std::string tolerance_text(const ToleranceReport& report) {
  if (report.study.stopped) return stopped_text(report);
  return "Of all samples\n" + table_text(headline_rows(report)) + "\n" +
         table_text(quantile_rows(report)) + decisive_text(report) + worst_text(report) +
         proved_text(report) + backlash_text(report) + counts_text(report);
}

std::vector<Moments> ToleranceReport::moments() const {
  return of_each(drive.varied, [](const ParameterTolerance& one) {
    return Moments{one.path, mean_of(one.distribution), standard_deviation_of(one.distribution)};
  });
}

}  // namespace gearlash
