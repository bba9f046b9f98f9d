#include "gearlash/io/grid_table.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <string_view>

#include "gearlash/chart/hunting_end.hpp"
#include "gearlash/servo/range_check.hpp"
#include "json_values.hpp"

namespace gearlash {
namespace {

/// "damping 0.1, backlash 0.3": the inputs that are on no axis.
std::string fixed_inputs(const ServoGrid& grid, const char* separator) {
  std::string text;
  for (const Input input : all_inputs) {
    bool varied = false;
    for (const Axis& axis : grid.axes) varied = varied || axis.input == input;
    if (varied) continue;
    text += (text.empty() ? "" : ", ") + std::string(name_of(input)) + separator +
            exact_text(grid.servo.*field_of(input));
  }
  return text;
}

std::string in_words(const char* name) {
  std::string text = name;
  for (char& c : text) c = c == '_' ? ' ' : c;
  return text;
}

/// "backlash (rad)".
std::string label_of(Input input) {
  const std::string unit = unit_of(input);
  return description_of(input) + (unit == "1" ? "" : " (" + unit + ")");
}

bool in_backlashes(const ServoGrid& grid) {
  for (const Axis& axis : grid.axes) {
    if (axis.input == Input::backlash) return false;
  }
  return grid.servo.backlash == 1.0;
}

std::string axis_label(CycleQuantity quantity, bool per_backlash) {
  std::string unit = unit_of(quantity);
  if (per_backlash) {
    if (unit == "rad") unit = "backlashes";
    if (unit == "rad omega_n") unit = "backlashes × ω_n";
    if (unit == "K rad2") unit = "K × backlash²";
  }
  if (unit == "1/omega_n") unit = "1/ω_n";
  if (unit == "rad omega_n") unit = "rad ω_n";
  if (unit == "K rad2") unit = "K rad²";
  return in_words(name_of(quantity)) + (unit == "1" ? "" : " (" + unit + ")");
}

/// Whether it tends to 0 where hunting ends: what is proportional to the backlash or its square.
bool vanishes_with_the_cycle(CycleQuantity quantity) {
  return std::string_view(unit_of(quantity)).find("rad") != std::string_view::npos;
}

/// One curve of the chart: rows `first` … of the table, over the last axis.
ChartCurve curve_of(const GridTable& table, std::size_t first, CycleQuantity quantity,
                    bool with_ends) {
  const Axis& x = table.grid.axes.back();
  const std::vector<double>& values = table.cycles[quantity];
  NormalizedServo servo = table.grid.at(first);
  const auto servo_at = [&](double place) {
    servo.*field_of(x.input) = place;
    return servo;
  };
  const auto add_end = [&](ChartCurve& curve, double hunting, double quiet) {
    const ChartPoint end{hunting_end(servo_at, hunting, quiet), 0.0};
    curve.ends.push_back(end);
    curve.line.push_back(end);
  };
  ChartCurve curve;
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    const Verdict verdict = table.cycles.verdict[first + i];
    if (with_ends && i > 0) {
      const Verdict before = table.cycles.verdict[first + i - 1];
      if (before == Verdict::hunts && verdict == Verdict::cannot_hunt) {
        add_end(curve, x.values[i - 1], x.values[i]);
      } else if (before == Verdict::cannot_hunt && verdict == Verdict::hunts) {
        add_end(curve, x.values[i], x.values[i - 1]);
      }
    }
    curve.line.push_back({x.values[i], values[first + i]});
  }
  return curve;
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
                 {"servo", json_servo(table.grid.servo)}};
  Json axes = Json::array();
  for (const Axis& axis : table.grid.axes) {
    axes.push_back({{"input", name_of(axis.input)}, {"values", axis.values}});
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
  sink("]\n}\n");
}

LineChart chart_of(const GridTable& table, CycleQuantity quantity) {
  const ServoGrid& grid = table.grid;
  const Axis& x = grid.axes.back();
  const bool per_backlash = in_backlashes(grid);
  const bool plastic = has_plastic_contact(grid);
  std::string title = description_of(quantity);
  title = title.substr(0, title.find(':'));
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  LineChart chart{.title = title,
                  .subtitle = in_words(fixed_inputs(grid, " ").c_str()),
                  .x = {.label = label_of(x.input),
                        .logarithmic = x.logarithmic,
                        .low = x.values.front(),
                        .high = x.values.back()},
                  .y = {.label = axis_label(quantity, per_backlash), .low = 0.0}};
  if (x.values.size() == 1) chart.x.low = chart.x.high = std::nullopt;
  const std::size_t curves = grid.axes.size() == 1 ? 1 : grid.axes.front().values.size();
  for (std::size_t i = 0; i < curves; ++i) {
    ChartCurve curve = curve_of(table, i * x.values.size(), quantity,
                                plastic && vanishes_with_the_cycle(quantity));
    bool any = false;
    for (const ChartPoint& point : curve.line) any = any || !std::isnan(point.y);
    if (grid.axes.size() > 1) {
      curve.name = in_words(name_of(grid.axes.front().input)) + " " +
                   fmt::format("{:.4g}", grid.axes.front().values[i]) + (any ? "" : ": rests");
    }
    if (!any) curve.line.clear();
    if (!curve.ends.empty()) chart.end_meaning = "hunting ends";
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace gearlash
