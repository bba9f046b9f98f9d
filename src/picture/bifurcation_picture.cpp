#include "picture/bifurcation_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/extent.hpp"
#include "base/lists.hpp"
#include "picture/curve_panel.hpp"
#include "picture/grid_words.hpp"
#include "picture/plot_making.hpp"

namespace gearlash {
namespace {

/// In the order of Stability.
const Layer branch_styles[] = {
    {.name = "stable cycle", .colour = "#0072b2", .width = 2.6},
    {.name = "neutral cycle", .colour = "#009e73", .width = 1.6, .dashes = "2,2"},
    {.name = "unstable cycle", .colour = "#d55e00", .width = 1.6, .dashes = "8,5"}};

/// Empty for a quantity that branches do not have.
std::optional<double> value_of(const CycleAt& cycle, Quantity quantity) {
  switch (quantity) {
    case Quantity::amplitude:
      return cycle.amplitude;
    case Quantity::motor_amplitude:
      return cycle.motor_amplitude;
    case Quantity::period:
      return cycle.period;
    case Quantity::frequency:
      return 1.0 / cycle.period;
    case Quantity::multiplier:
      return std::abs(cycle.multiplier);
    default:
      return std::nullopt;
  }
}

bool is_amplitude(Quantity quantity) {
  return quantity == Quantity::amplitude || quantity == Quantity::motor_amplitude;
}

/// How values become places in the picture.
struct Drawing {
  Quantity quantity{};
  double per_value = 1.0;      ///< of the quantity's SI unit
  double per_parameter = 1.0;  ///< of the axis's
  PlotAxis y{};

  double foot() const { return y.low; }
  MapPoint at(double parameter, double value) const {
    return {parameter / per_parameter, std::max(value, foot())};
  }
  double value(const CycleAt& cycle) const { return value_of(cycle, quantity).value() / per_value; }
  double value(const IrregularAt& motion) const {
    return (quantity == Quantity::amplitude ? motion.amplitude : motion.motor_amplitude) /
           per_value;
  }
};

Drawing drawing_of(const BifurcationDiagram& diagram, const Grid& grid, Quantity quantity) {
  Drawing drawing{.quantity = quantity,
                  .per_value = drawn_unit(quantity, grid).size,
                  .per_parameter = drawn_unit(grid.axes.front(), grid.drive).size,
                  .y = plot_axis(quantity, grid)};
  Extent values;
  const auto include = [&](double value) {
    if (std::isfinite(value) && value > 0.0) values.include(value);
  };
  for (const CycleBranch& branch : diagram.branches) {
    for (const CycleAt& point : branch.points) include(drawing.value(point));
  }
  if (is_amplitude(quantity)) {
    for (const IrregularAt& motion : diagram.irregular) include(drawing.value(motion));
  }
  const bool is_empty = !(values.high > 0.0);
  constexpr double wide = 30.0;
  drawing.y.logarithmic = !is_empty && is_amplitude(quantity) && values.high > wide * values.low;
  drawing.y.low = drawing.y.logarithmic ? values.low / 2.5 : 0.0;
  drawing.y.high = is_empty ? 1.0 : drawing.y.logarithmic ? 1.6 * values.high : 1.08 * values.high;
  return drawing;
}

void add(Layer layer, Panel& panel) {
  if (!layer.points.empty()) panel.layers.push_back(std::move(layer));
}

void add_rest(const BifurcationDiagram& diagram, const Drawing& drawing, Panel& panel) {
  if (!is_amplitude(drawing.quantity)) return;
  Layer layer{.name = "can come to rest", .colour = "#8a8a8a", .width = 5.0};
  for (const Bounds& interval : diagram.rests) {
    append({drawing.at(interval.low, 0.0), drawing.at(interval.high, 0.0)}, layer.points);
  }
  add(std::move(layer), panel);
}

void add_branches(const BifurcationDiagram& diagram, const Drawing& drawing, Panel& panel) {
  for (const Stability stability : {Stability::unstable, Stability::neutral, Stability::stable}) {
    Layer lines = branch_styles[static_cast<std::size_t>(stability)];
    Layer marks{.kind = LayerKind::marks,  // a line of one point is invisible
                .colour = lines.colour,
                .mark = stability == Stability::stable ? Mark::disc : Mark::circle,
                .size = 0.7};
    for (const CycleBranch& branch : diagram.branches) {
      if (branch.stability != stability) continue;
      append({}, lines.points);
      for (const CycleAt& point : branch.points) {
        const double value = drawing.value(point);
        if (!std::isfinite(value)) continue;
        lines.points.push_back(drawing.at(point.parameter, value));
        if (branch.points.size() == 1) marks.points.push_back(lines.points.back());
      }
    }
    add(std::move(lines), panel);
    add(std::move(marks), panel);
  }
}

void add_irregular(const BifurcationDiagram& diagram, const Drawing& drawing, Panel& panel) {
  if (!is_amplitude(drawing.quantity)) return;
  Layer layer{.kind = LayerKind::marks,
              .name = "motion that closes no cycle",
              .mark = Mark::cross,
              .size = 0.8};
  for (const IrregularAt& motion : diagram.irregular) {
    const double value = drawing.value(motion);
    if (std::isfinite(value)) layer.points.push_back(drawing.at(motion.parameter, value));
  }
  add(std::move(layer), panel);
}

/// Marks differ in shape, so that they are read without colour.
Mark mark_of(const std::string& word) {
  constexpr std::pair<std::string_view, Mark> marks[] = {
      {"fold", Mark::circle},
      {"flip", Mark::open_square},
      {"branching", Mark::open_triangle},
      {"Neimark–Sacker", Mark::open_diamond},
      {"grazing", Mark::star},
      {"events change", Mark::plus},
      {"endless period", Mark::diamond},
      {"loss of rest", Mark::disc},
      {"cycle is lost", Mark::open_wedge},
      {"stability changes", Mark::open_pentagon}};
  for (const auto& [known, mark] : marks) {
    if (known == word) return mark;
  }
  return Mark::square;
}

/// One legend entry for each word.
void add_borders(const BifurcationDiagram& diagram, const Drawing& drawing, Panel& panel) {
  std::map<std::string, MapCurve> marks;
  std::map<std::string, MapCurve> upright;
  for (const MarkedBorder& border : diagram.borders) {
    if (!border.cycle) {
      append({drawing.at(border.parameter, 0.0), drawing.at(border.parameter, drawing.y.high)},
             upright[border.word]);
      continue;
    }
    // Rest has an amplitude, but no period.
    const double value = drawing.value(*border.cycle);
    if (!std::isfinite(value) || (value == 0.0 && !is_amplitude(drawing.quantity))) continue;
    marks[border.word].push_back(drawing.at(border.parameter, value));
  }
  for (const auto& [word, points] : upright) {
    panel.layers.push_back(
        {.name = word, .colour = "#555555", .width = 1.4, .dashes = "2,4", .points = points});
  }
  for (const auto& [word, points] : marks) {
    panel.layers.push_back({.kind = LayerKind::marks,
                            .name = word,
                            .mark = mark_of(word),
                            .size = 1.4,
                            .points = points});
  }
}

std::string subtitle_of(const BifurcationDiagram& diagram, const Grid& grid) {
  std::string servo = diagram.searched == 0 ? gearlash::subtitle_of(grid) : "";
  if (!servo.empty()) return servo;
  return fmt::format("searched at {} values, cycles followed between them", diagram.searched);
}

}  // namespace

std::vector<Fault> faults_of_branches(const Grid& grid, Quantity quantity,
                                      const std::vector<std::string>& fields) {
  constexpr std::size_t most_values = 1000;
  std::vector<Fault> faults;
  const Axis& x = grid.axes.back();
  if (grid.axes.size() > 1) {
    faults.push_back({fields[0], "given", "must be left out: bifurcation=FILE has branches"});
  }
  const bool is_number = !has_words(x, grid.drive);
  if (!is_number || x.values.size() < 2 || x.values.size() > most_values) {
    faults.push_back({fields[1], is_number ? fmt::format("{} values", x.values.size()) : "words",
                      "must have 2 to 1000 numbers for bifurcation=FILE"});
  }
  if (!value_of({.period = 1.0}, quantity)) {
    faults.push_back({fields[2], std::string(name_of(quantity)),
                      "must be amplitude, motor_amplitude, period, frequency or multiplier for "
                      "bifurcation=FILE"});
  }
  return faults;
}

Plot bifurcation_plot(const BifurcationDiagram& diagram, const Grid& grid, Quantity quantity) {
  const Axis& axis = grid.axes.front();
  const Drawing drawing = drawing_of(diagram, grid, quantity);
  Panel panel{.x = plot_axis(axis, grid.drive), .y = drawing.y};
  add_rest(diagram, drawing, panel);
  add_branches(diagram, drawing, panel);
  add_irregular(diagram, drawing, panel);
  add_borders(diagram, drawing, panel);
  if (panel.layers.empty()) say("no cycle was found", panel);
  return plot_of(
      "Cycles over " + in_words(axis.path) + ": " + in_words(std::string(name_of(quantity))),
      subtitle_of(diagram, grid), std::move(panel));
}

}  // namespace gearlash
