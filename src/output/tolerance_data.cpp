#include "output/tolerance_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "output/csv_table.hpp"
#include "output/two_pass_file.hpp"

namespace gearlash {
namespace {

// The estimate's value; NaN without an estimate.
double value_of(const std::optional<Estimate>& estimate) {
  return estimate ? estimate->value : not_a_number;
}
double error_of(const std::optional<Estimate>& estimate) {
  return estimate ? estimate->standard_error.value_or(not_a_number) : not_a_number;
}

/// A quantity estimated at several shares, and its description.
struct QuantileSeries {
  const char* name;
  const char* long_name;
  const char* units;
  const std::vector<QuantileEstimate>& quantiles;
};

std::vector<QuantileSeries> quantile_series(const ToleranceReport& report) {
  const ToleranceStudy& study = report.study;
  std::vector<QuantileSeries> series = {
      {"amplitude", "amplitude of limit cycle, 0 where the drive cannot hunt", "rad",
       study.amplitude},
      {"amplitude_of_hunting", "amplitude of limit cycle, of drives that hunt", "rad",
       study.amplitude_of_hunting}};
  series.push_back(
      {"frequency", "frequency of limit cycle, of drives that hunt", "Hz", study.frequency});
  return series;
}

/// A sensitivity index of every parameter, and its description.
struct IndexSeries {
  const char* name;
  const char* long_name;
  std::optional<SensitivityIndices> NumberSensitivity::*indices;
  Estimate SensitivityIndices::*index;

  std::optional<Estimate> of(const NumberSensitivity& number) const {
    const std::optional<SensitivityIndices>& found = number.*indices;
    return found ? std::optional((*found).*index) : std::nullopt;
  }
};

const std::array<IndexSeries, 4>& index_series() {
  static const std::array<IndexSeries, 4> series = {
      {{"first_order_index_of_amplitude", "first-order Sobol index of the amplitude",
        &NumberSensitivity::of_amplitude, &SensitivityIndices::first_order},
       {"total_index_of_amplitude", "total Sobol index of the amplitude",
        &NumberSensitivity::of_amplitude, &SensitivityIndices::total},
       {"first_order_index_of_hunting", "first-order Sobol index of whether it hunts",
        &NumberSensitivity::of_hunting, &SensitivityIndices::first_order},
       {"total_index_of_hunting", "total Sobol index of whether it hunts",
        &NumberSensitivity::of_hunting, &SensitivityIndices::total}}};
  return series;
}

/// Single estimates by their names.
std::vector<std::pair<const char*, std::optional<Estimate>>> single_estimates(
    const ToleranceReport& report) {
  std::vector<std::pair<const char*, std::optional<Estimate>>> estimates = {
      {"hunting", report.study.hunting}, {"mean_amplitude", report.study.mean_amplitude}};
  if (!report.target_text.empty()) estimates.emplace_back("yield", report.study.yield);
  return estimates;
}

// --- NetCDF ---

void add_estimates(TwoPassFile& file, const std::string& name,
                   const std::vector<NetcdfDimension>& dimensions, const std::string& long_name,
                   const std::string& units,
                   const std::vector<std::optional<Estimate>>& estimates) {
  std::vector<double> values;
  std::vector<double> errors;
  for (const std::optional<Estimate>& estimate : estimates) {
    values.push_back(value_of(estimate));
    errors.push_back(error_of(estimate));
  }
  for (const NetcdfVariable variable :
       {file.add(name, dimensions, long_name, units, std::move(values)),
        file.add(name + "_standard_error", dimensions, "standard error of the " + long_name, units,
                 std::move(errors))}) {
    if (!dimensions.empty()) file.file().declare_nan_missing(variable);
  }
}

void add_quantiles(const ToleranceReport& report, TwoPassFile& file) {
  std::vector<double> shares;
  for (const QuantileEstimate& quantile : report.study.amplitude) shares.push_back(quantile.share);
  const NetcdfDimension share = file.file().add_dimension("share", shares.size());
  file.add("share", {share}, "share of samples up to the value", "1", shares);
  for (const QuantileSeries& series : quantile_series(report)) {
    std::vector<std::optional<Estimate>> estimates;
    for (const QuantileEstimate& quantile : series.quantiles) estimates.push_back(quantile.value);
    add_estimates(file, std::string(series.name) + "_quantile", {share}, series.long_name,
                  series.units, estimates);
  }
}

void add_indices(const ToleranceReport& report, TwoPassFile& file) {
  const std::vector<NumberSensitivity>& numbers = report.sensitivities.numbers;
  const NetcdfDimension number = file.file().add_dimension("number", numbers.size());
  std::vector<double> places;
  std::string names;
  for (const NumberSensitivity& one : numbers) {
    names += (names.empty() ? "" : " ") + one.path;
    places.push_back(static_cast<double>(places.size()));
  }
  const NetcdfVariable variable =
      file.add("number", {number}, "parameter that varies", "1", places);
  file.file().set_attribute(variable, "flag_meanings", names);
  for (const IndexSeries& series : index_series()) {
    std::vector<std::optional<Estimate>> estimates;
    for (const NumberSensitivity& one : numbers) estimates.push_back(series.of(one));
    add_estimates(file, series.name, {number}, series.long_name, "1", estimates);
  }
}

void add_histogram(const ToleranceReport& report, TwoPassFile& file) {
  const AmplitudeHistogram& histogram = report.study.histogram;
  if (histogram.counts.empty()) return;
  const NetcdfDimension bin = file.file().add_dimension("bin", histogram.counts.size());
  file.add("amplitude_from", {bin}, "least amplitude of the step", "rad",
           {histogram.edges.begin(), histogram.edges.end() - 1});
  file.add("amplitude_to", {bin}, "largest amplitude of the step", "rad",
           {histogram.edges.begin() + 1, histogram.edges.end()});
  std::vector<double> counts;
  for (const std::size_t count : histogram.counts) counts.push_back(static_cast<double>(count));
  file.add("samples", {bin}, "samples with such an amplitude", "1", std::move(counts));
}

}  // namespace

void write_tolerance_csv(const ToleranceReport& report, const TextSink& sink) {
  CsvTable table(sink, {"quantity", "of", "value", "standard_error"});
  const auto line = [&](std::string_view quantity, std::string_view of,
                        const std::optional<Estimate>& estimate) {
    table.row(quantity, of, value_of(estimate), error_of(estimate));
  };
  for (const auto& [name, estimate] : single_estimates(report)) line(name, "", estimate);
  if (report.study.relative_accuracy > 0.0) {
    line("relative_accuracy_of_quantiles", "", Estimate{.value = report.study.relative_accuracy});
  }
  for (const QuantileSeries& series : quantile_series(report)) {
    for (const QuantileEstimate& quantile : series.quantiles) {
      line(std::string(series.name) + "_quantile", exact_text(quantile.share), quantile.value);
    }
  }
  for (const IndexSeries& series : index_series()) {
    for (const NumberSensitivity& number : report.sensitivities.numbers) {
      line(series.name, number.path, series.of(number));
    }
  }
  const AmplitudeHistogram& histogram = report.study.histogram;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    line("samples", exact_text(histogram.edges[i]) + " to " + exact_text(histogram.edges[i + 1]),
         Estimate{.value = static_cast<double>(histogram.counts[i])});
  }
}

void write_tolerance_netcdf(const ToleranceReport& report, const OutputFile& output) {
  TwoPassFile file(NetcdfFile::create(output.hidden_file(), output.shown_name()));
  NetcdfFile& description = file.file();
  description.set_attribute_of_file("Conventions", "CF-1.8");
  description.set_attribute_of_file("title", "Production run of a geared servo with backlash");
  description.set_attribute_of_file("source", "gearlash " + report.provenance.version);
  description.set_attribute_of_file("history", report.provenance.command);
  if (!report.target_text.empty()) {
    description.set_attribute_of_file("target", report.target_text);
  }
  if (report.study.relative_accuracy > 0.0) {
    description.set_attribute_of_file("relative_accuracy_of_quantiles",
                                      exact_text(report.study.relative_accuracy));
  }
  for (const auto& [name, estimate] : single_estimates(report)) {
    const bool is_amplitude = std::string(name) == "mean_amplitude";
    add_estimates(file, name, {},
                  is_amplitude ? "mean amplitude of all samples" : "share of all samples",
                  is_amplitude ? "rad" : "1", {estimate});
  }
  add_quantiles(report, file);
  add_indices(report, file);
  add_histogram(report, file);
  file.finish();
}

}  // namespace gearlash
