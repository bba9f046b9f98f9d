#include "output/reduced_grid_data.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/grid/axis.hpp"
#include "analysis/grid/grid_points.hpp"
#include "base/special_numbers.hpp"
#include "output/columns.hpp"
#include "output/two_pass_file.hpp"

namespace gearlash {
namespace {

constexpr std::uint64_t bins_per_octave = 8;
constexpr char border_verdict[] = "border_verdict";

std::string border_name(const Axis& axis) { return "border_" + column_name(axis.path); }

// --- NetCDF ---

std::vector<double> as_doubles(const VerdictCounts& counts) {
  return {counts.begin(), counts.end()};
}

void add_counts(const Grid& grid, const ReducedGrid& reduced,
                const std::vector<NetcdfDimension>& axes, TwoPassFile& file) {
  const NetcdfDimension verdict = file.file().add_dimension("verdict", verdict_count);
  std::vector<signed char> all;
  for (std::size_t i = 0; i < verdict_count; ++i) all.push_back(static_cast<signed char>(i));
  file.add_flags("verdict", verdict, "verdict on the drive", verdict_words(), std::move(all));
  file.add("points", {verdict}, "points with that verdict", "1", as_doubles(reduced.counts()));
  for (std::size_t k = 0; k < axes.size(); ++k) {
    std::vector<double> numbers;
    for (const VerdictCounts& counts : reduced.counts_by_axis()[k]) {
      numbers.insert(numbers.end(), counts.begin(), counts.end());
    }
    file.add("points_by_" + column_name(grid.axes[k].path), {axes[k], verdict},
             "points with that value and verdict", "1", std::move(numbers),
             {grid.axes[k].values.size(), verdict_count});
  }
}

void add_extremes(const Grid& grid, const ReducedQuantity& reduced, NetcdfDimension extreme,
                  TwoPassFile& file) {
  const QuantityInfo& info = info_of(reduced.quantity);
  const std::string name = std::string(info.name) + "_extreme";
  const bool is_known = reduced.smallest && reduced.largest;
  std::vector<double> values(2, not_a_number);
  std::vector<std::vector<double>> places(grid.axes.size(), values);
  if (is_known) {
    values = {reduced.smallest->value, reduced.largest->value};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint64_t point = i == 0 ? reduced.smallest->point : reduced.largest->point;
      const std::vector<double> place = values_at(grid, static_cast<std::size_t>(point));
      for (std::size_t k = 0; k < place.size(); ++k) places[k][i] = place[k];
    }
  }
  const auto add = [&](const std::string& variable, const std::string& meaning,
                       const std::string& unit, std::vector<double> numbers) {
    file.file().declare_nan_missing(
        file.add(variable, {extreme}, meaning, unit, std::move(numbers)));
  };
  add(name, "smallest and largest " + std::string(info.meaning), std::string(info.unit),
      std::move(values));
  for (std::size_t k = 0; k < grid.axes.size(); ++k) {
    const NamedParameter parameter = named_parameter(grid.axes[k], grid.drive);
    add(name + "_" + parameter.name, parameter.meaning + ", at the first such point",
        parameter.unit, std::move(places[k]));
  }
}

void add_histogram(const ReducedQuantity& reduced, TwoPassFile& file) {
  const QuantityInfo& info = info_of(reduced.quantity);
  const std::string name = std::string(info.name) + "_bin";
  std::vector<double> from;
  std::vector<double> to;
  std::vector<double> counts;
  const auto put = [&](double low, double high, std::uint64_t count) {
    from.push_back(low);
    to.push_back(high);
    counts.push_back(static_cast<double>(count));
  };
  const QuantileSketch& sketch = reduced.sketch;
  if (sketch.infinite_below() > 0) put(-infinity, -infinity, sketch.infinite_below());
  for (const QuantileSketch::Bucket& bin : sketch.buckets(bins_per_octave)) {
    put(bin.low, bin.high, bin.count);
  }
  if (sketch.infinite_above() > 0) put(infinity, infinity, sketch.infinite_above());
  if (counts.empty()) return;
  const NetcdfDimension bin = file.file().add_dimension(name, counts.size());
  const std::string unit(info.unit);
  file.add(name + "_from", {bin}, "lower end of the bin", unit, std::move(from));
  file.add(name + "_to", {bin}, "upper end of the bin", unit, std::move(to));
  file.add(name + "_points", {bin}, "points in the bin, of " + std::string(info.meaning), "1",
           std::move(counts));
}

void add_quantiles(const ReducedQuantity& reduced, NetcdfDimension share, TwoPassFile& file) {
  const QuantityInfo& info = info_of(reduced.quantity);
  std::vector<double> values;
  for (const double one : reported_shares) values.push_back(reduced.sketch.quantile(one));
  const NetcdfVariable variable =
      file.add(std::string(info.name) + "_quantile", {share},
               std::string(info.meaning) + ", not exceeded by a share of the points with one",
               std::string(info.unit), std::move(values));
  file.file().declare_nan_missing(variable);
  file.file().set_attribute(variable, "relative_accuracy",
                            fmt::format("{}", QuantileSketch::relative_accuracy));
}

void describe_border(const Grid& grid, ReducedGrid& reduced, NetcdfFile& file) {
  if (reduced.is_border_too_long() || reduced.border().empty()) {
    file.set_attribute_of_file("border",
                               reduced.is_border_too_long() ? "too long to be kept" : "no point");
    return;
  }
  const NetcdfDimension dimension = file.add_dimension("border_point", reduced.border().size());
  file.add_flags(border_verdict, {dimension},
                 "verdict at a point of which a neighbor's along an axis differs", verdict_words());
  for (const Axis& axis : grid.axes) {
    const NamedParameter parameter = named_parameter(axis, grid.drive);
    file.add_numbers(border_name(axis), {dimension}, parameter.meaning, parameter.unit);
  }
}

/// One variable after the other, to save memory.
void write_border(const Grid& grid, ReducedGrid& reduced, NetcdfFile& file) {
  const std::vector<BorderPoint>& border = reduced.border();
  if (border.empty()) return;
  std::vector<signed char> verdicts;
  for (const BorderPoint& point : border) {
    verdicts.push_back(static_cast<signed char>(point.verdict()));
  }
  file.write(file.variable(border_verdict), {0}, {border.size()}, verdicts);
  std::size_t stride = grid.size();
  std::vector<double> values(border.size());
  for (const Axis& axis : grid.axes) {
    stride /= axis.values.size();
    std::transform(border.begin(), border.end(), values.begin(), [&](const BorderPoint& point) {
      return axis.values[point.point() / stride % axis.values.size()];
    });
    file.write(file.variable(border_name(axis)), {0}, {border.size()}, values);
  }
}

void add_quantities(const Grid& grid, const ReducedGrid& reduced, TwoPassFile& file) {
  const Kept& kept = reduced.kept();
  NetcdfDimension extreme = 0;
  NetcdfDimension share = 0;
  if (kept.extremes) extreme = file.file().add_dimension("extreme", 2);
  if (kept.quantiles) {
    share = file.file().add_dimension("share", std::size(reported_shares));
    file.add("share", {share}, "share of the points with a value that do not exceed it", "1",
             {std::begin(reported_shares), std::end(reported_shares)});
  }
  for (const ReducedQuantity& one : reduced.quantities()) {
    file.add(std::string(name_of(one.quantity)) + "_known", {}, "points at which it is known", "1",
             {static_cast<double>(one.known)});
    if (kept.extremes) add_extremes(grid, one, extreme, file);
    if (kept.histograms) add_histogram(one, file);
    if (kept.quantiles) add_quantiles(one, share, file);
  }
}

// --- text ---

using Row = std::vector<std::string>;

std::string counts_text(const ReducedGrid& reduced) {
  std::vector<Row> rows = {{"verdict", "points", "share"}};
  for (std::size_t i = 0; i < verdict_count; ++i) {
    const std::uint64_t count = reduced.counts()[i];
    if (count == 0) continue;
    const double share = static_cast<double>(count) / static_cast<double>(reduced.points());
    rows.push_back({std::string(name_of(static_cast<Verdict>(i))), std::to_string(count),
                    significant(100.0 * share, usual_digits) + " %"});
  }
  return table_text(rows);
}

std::string value_text(double value, const QuantityInfo& info) {
  const std::string unit(info.unit);
  return significant(value, usual_digits) + (unit == "1" ? "" : " " + unit);
}

std::string extremes_text(const Grid& grid, const ReducedGrid& reduced) {
  std::vector<Row> rows = {{"quantity", "known at", "smallest, largest"}};
  for (const Axis& axis : grid.axes) rows.front().push_back("at " + column_name(axis.path));
  for (const ReducedQuantity& one : reduced.quantities()) {
    const QuantityInfo& info = info_of(one.quantity);
    if (!one.smallest || !one.largest) {
      rows.push_back({std::string(info.name), "0"});
      continue;
    }
    for (const Extreme* extreme : {&*one.smallest, &*one.largest}) {
      const bool is_first = extreme == &*one.smallest;
      Row row = {is_first ? std::string(info.name) : "", is_first ? std::to_string(one.known) : "",
                 value_text(extreme->value, info)};
      const std::vector<double> place = values_at(grid, static_cast<std::size_t>(extreme->point));
      for (std::size_t k = 0; k < place.size(); ++k) {
        const std::string unit = unit_of(grid.axes[k], grid.drive);
        std::string text = unit.empty() ? text_of(grid.axes[k], grid.drive, place[k])
                                        : significant(place[k], usual_digits);
        if (!unit.empty() && unit != "1") text += " " + unit;
        row.push_back(std::move(text));
      }
      rows.push_back(std::move(row));
    }
  }
  return table_text(rows);
}

std::string quantiles_text(const ReducedGrid& reduced) {
  constexpr double shown[] = {0.01, 0.25, 0.5, 0.75, 0.99};
  std::vector<Row> rows = {{"share of the points with a value"}};
  for (const double share : shown) rows.front().push_back(fmt::format("{:.4g} %", 100.0 * share));
  for (const ReducedQuantity& one : reduced.quantities()) {
    const QuantityInfo& info = info_of(one.quantity);
    Row row = {std::string(info.name) + (info.unit == "1" ? "" : ", " + std::string(info.unit))};
    for (const double share : shown) {
      row.push_back(one.known == 0 ? "–" : significant(one.sketch.quantile(share), usual_digits));
    }
    rows.push_back(std::move(row));
  }
  return table_text(rows) + fmt::format("Quantiles are within {} % of a value.\n",
                                        significant(100.0 * QuantileSketch::relative_accuracy, 2));
}

std::string border_text(ReducedGrid& reduced) {
  if (reduced.is_border_too_long()) {
    return fmt::format("Border: more than {} points, which are not kept.\n",
                       ReducedGrid::most_border_points);
  }
  return fmt::format("Border: {} points with another verdict than a neighbor.\n",
                     reduced.border().size());
}

}  // namespace

void write_reduced_netcdf(const GridContents& contents, ReducedGrid& reduced,
                          const OutputFile& output) {
  TwoPassFile file(NetcdfFile::create(output.hidden_file(), output.shown_name()));
  for (const auto& [name, text] : attributes_of_file(contents)) {
    file.file().set_attribute_of_file(name, text);
  }
  const std::vector<NetcdfDimension> axes = describe_axes(file.file(), contents.grid);
  describe_fixed_numbers(file.file(), contents.grid);
  if (reduced.kept().counts) add_counts(contents.grid, reduced, axes, file);
  add_quantities(contents.grid, reduced, file);
  if (reduced.kept().border) describe_border(contents.grid, reduced, file.file());
  file.finish([&](NetcdfFile& described) {
    write_parameters(described, contents.grid);
    write_border(contents.grid, reduced, described);
  });
}

std::string reduced_text(const GridContents& contents, ReducedGrid& reduced) {
  const Kept& kept = reduced.kept();
  std::string text = counts_text(reduced);
  if (kept.extremes) text += "\n" + extremes_text(contents.grid, reduced);
  if (kept.quantiles) text += "\n" + quantiles_text(reduced);
  if (kept.border) text += "\n" + border_text(reduced);
  return text;
}

}  // namespace gearlash
