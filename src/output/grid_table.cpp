#include "output/grid_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/range_check.hpp"
#include "output/grid_words.hpp"
#include "output/json_values.hpp"
#include "picture/hunting_curve.hpp"

namespace gearlash {
namespace {

/// One curve of the chart: rows `first` … of the table, over the last axis.
ChartCurve curve_of(const GridTable& table, std::size_t first, CycleQuantity quantity) {
  const Axis& x = table.grid.axes.back();
  const std::vector<double>& values = table.cycles[quantity];
  NormalizedServo servo_on_curve = table.grid.at(first);
  const double limit = limit_where_hunting_ends(quantity, servo_on_curve.backlash)
                           .value_or(std::numeric_limits<double>::infinity());
  const bool ends = !table.grid.may_bounce() && std::isfinite(limit);
  std::vector<CurveServo> servos;
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    const Verdict verdict = table.cycles.verdict[first + i];
    CurveServo servo{x.values[i], values[first + i]};
    if (ends && verdict == Verdict::hunts) servo.hunts = true;
    if (ends && verdict == Verdict::cannot_hunt) servo.hunts = false;
    servos.push_back(servo);
  }
  const auto servo_at = [&](double place) {
    servo_on_curve.*field_of(x.input) = place;
    return servo_on_curve;
  };
  return curve_to_hunting_ends(servos, servo_at, limit);
}

/// Why nothing of these rows of the table is drawn.
std::string word_for_nothing(const GridTable& table, std::size_t first, std::size_t count,
                             CycleQuantity quantity) {
  bool all_rest = true;
  for (std::size_t row = first; row < first + count; ++row) {
    if (std::isinf(table.cycles[quantity][row])) return "infinite";
    all_rest = all_rest && table.cycles.verdict[row] == Verdict::cannot_hunt;
  }
  return all_rest ? "rests" : "not known";
}

/// A line of one point does not show.
void mark_lone_points(ChartCurve& curve) {
  const auto is_drawn = [&](std::size_t i) {
    return i < curve.line.size() && std::isfinite(curve.line[i].y);
  };
  for (std::size_t i = 0; i < curve.line.size(); ++i) {
    const bool has_neighbour = is_drawn(i + 1) || (i > 0 && is_drawn(i - 1));
    if (is_drawn(i) && !has_neighbour) curve.marks.push_back(curve.line[i]);
  }
}

/// "[[[x, y], …], …]", a curve a line.
void write_curves(const std::vector<MapCurve>& curves, const TextSink& sink) {
  sink("[");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    sink(i == 0 ? "\n    [" : ",\n    [");
    for (std::size_t j = 0; j < curves[i].size(); ++j) {
      const MapPoint& point = curves[i][j];
      sink((j == 0 ? "" : ", ") + Json({point.x, point.y}).dump());
    }
    sink("]");
  }
  sink(curves.empty() ? "]" : "\n  ]");
}

}  // namespace

void write_grid_csv(const GridTable& table, const TextSink& sink) {
  sink("# gearlash " + table.provenance.version + "\n# command: " + table.provenance.command +
       "\n# " + fixed_inputs(table.grid, " = ") + "\n");
  for (const CycleQuantity quantity : all_quantities) {
    sink(fmt::format("# {}: {}, {}\n", name_of(quantity), description_of(quantity),
                     unit_of(quantity)));
  }
  std::string header;
  for (const Axis& axis : table.grid.axes) header += std::string(name_of(axis.input)) + ",";
  header += "verdict";
  for (const CycleQuantity quantity : all_quantities)
    header += std::string(",") + name_of(quantity);
  sink(header + "\n");
  for (std::size_t row = 0; row < table.cycles.rows(); ++row) {
    const NormalizedServo servo = table.grid.at(row);
    std::string line;
    for (const Axis& axis : table.grid.axes) line += exact_text(servo.*field_of(axis.input)) + ",";
    line += name_of(table.cycles.verdict[row]);
    for (const CycleQuantity quantity : all_quantities) {
      const double value = table.cycles[quantity][row];
      line += "," + (std::isnan(value) ? "" : exact_text(value));
    }
    sink(line + "\n");
  }
}

void write_grid_json(const GridTable& table, const TextSink& sink) {
  Json header = {{"provenance", json_provenance(table.provenance)},
                 {"certainty", certainty_of(table.grid)},
                 {"servo", json_servo(table.grid.servo)}};
  Json axes = Json::array();
  for (const Axis& axis : table.grid.axes) {
    Json values = Json::array();
    for (const double value : axis.values) values.push_back(json_number(value));
    axes.push_back({{"input", name_of(axis.input)}, {"values", std::move(values)}});
    header["servo"].erase(name_of(axis.input));
  }
  header["axes"] = std::move(axes);
  std::string text = header.dump(2);
  text.resize(text.rfind("\n}"));  // reopened: the columns follow, number by number
  sink(text + ",\n  \"verdict\": [");
  const std::vector<Verdict>& verdicts = table.cycles.verdict;
  for (std::size_t row = 0; row < verdicts.size(); ++row) {
    sink((row == 0 ? "" : ", ") + Json(name_of(verdicts[row])).dump());
  }
  for (const CycleQuantity quantity : all_quantities) {
    sink(fmt::format("],\n  \"{}\": [", name_of(quantity)));
    const std::vector<double>& values = table.cycles[quantity];
    for (std::size_t row = 0; row < values.size(); ++row) {
      sink((row == 0 ? "" : ", ") + json_number(values[row]).dump());
    }
  }
  sink("]");
  if (table.hunting_boundary) {
    sink(",\n  \"hunting_boundary\": ");
    write_curves(*table.hunting_boundary, sink);
  }
  if (table.dissipative_boundary) {
    sink(",\n  \"dissipative_boundary\": ");
    write_curves(*table.dissipative_boundary, sink);
  }
  sink("\n}\n");
}

LineChart chart_of(const GridTable& table, CycleQuantity quantity) {
  const ServoGrid& grid = table.grid;
  const Axis& x = grid.axes.back();
  LineChart chart{.title = title_of(quantity),
                  .subtitle = in_words(fixed_inputs(grid, " ").c_str()),
                  .x = chart_axis(x),
                  .y = {.label = label_of(quantity, grid), .low = 0.0}};
  const std::size_t curves = grid.axes.size() == 1 ? 1 : grid.axes.front().values.size();
  bool nothing_drawn = true;
  for (std::size_t i = 0; i < curves; ++i) {
    const std::size_t first = i * x.values.size();
    ChartCurve curve = curve_of(table, first, quantity);
    const bool is_drawn = std::any_of(curve.line.begin(), curve.line.end(),
                                      [](const auto& point) { return std::isfinite(point.y); });
    if (grid.axes.size() > 1) {
      curve.name = in_words(name_of(grid.axes.front().input)) +
                   fmt::format(" {:.4g}", grid.axes.front().values[i]);
      if (!is_drawn) curve.name += ": " + word_for_nothing(table, first, x.values.size(), quantity);
    }
    if (!is_drawn) curve.line.clear();
    nothing_drawn = nothing_drawn && !is_drawn;
    mark_lone_points(curve);
    for (const ChartPoint& point : curve.line) {
      if (point.y < 0.0) chart.y.low.reset();
    }
    if (!curve.ends.empty()) chart.end_meaning = "hunting ends";
    chart.curves.push_back(std::move(curve));
  }
  if (nothing_drawn) {
    const std::string word = word_for_nothing(table, 0, table.cycles.rows(), quantity);
    chart.empty_meaning = word == "rests" ? "no limit cycle" : word;
  }
  return chart;
}

}  // namespace gearlash
