#include "picture/bifurcation_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "base/extent.hpp"
#include "picture/gnuplot.hpp"
#include "picture/gnuplot_script.hpp"
#include "picture/grid_words.hpp"

namespace gearlash {
namespace {

struct Style {
  const char* line;
  const char* name;
};

Style style_of(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return {"linewidth 2.6 linecolor rgb '#0072b2'", "stable cycle"};
    case Stability::neutral:
      return {"linewidth 1.6 dashtype (2,2) linecolor rgb '#009e73'", "neutral cycle"};
    case Stability::unstable:
      return {"linewidth 1.6 dashtype (8,5) linecolor rgb '#d55e00'", "unstable cycle"};
  }
  return {"", ""};
}

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

/// The picture's numbers.
struct Scale {
  Quantity quantity{};
  double per_value = 1.0;      ///< of the quantity's SI unit
  double per_parameter = 1.0;  ///< of the axis's
  bool is_logarithmic = false;
  double foot = 0.0;  ///< lower end of the vertical axis
  double top = 1.0;

  double value(const CycleAt& cycle) const { return value_of(cycle, quantity).value() / per_value; }
  double parameter(double si) const { return si / per_parameter; }
  /// Share of the vertical axis.
  double height(double value) const {
    if (!is_logarithmic) return (value - foot) / (top - foot);
    return std::log(std::max(value, foot) / foot) / std::log(top / foot);
  }
};

Scale scale_of(const BifurcationDiagram& diagram, const Grid& grid, Quantity quantity,
               const AngleUnit& angle) {
  Scale scale{.quantity = quantity};
  scale.per_value = drawn_unit(quantity, grid, angle);
  scale.per_parameter = drawn_unit(grid.axes.front(), grid.drive, angle);
  Extent values;
  const auto include = [&](double value) {
    if (std::isfinite(value) && value > 0.0) values.include(value);
  };
  for (const CycleBranch& branch : diagram.branches) {
    for (const CycleAt& point : branch.points) include(scale.value(point));
  }
  for (const IrregularAt& motion : diagram.irregular) {
    if (!is_amplitude(quantity)) break;
    include((quantity == Quantity::amplitude ? motion.amplitude : motion.motor_amplitude) /
            scale.per_value);
  }
  if (!(values.high > 0.0)) return scale;
  constexpr double margin = 1.08;
  constexpr double wide = 30.0;
  scale.top = margin * values.high;
  scale.is_logarithmic = is_amplitude(quantity) && values.high > wide * values.low;
  if (scale.is_logarithmic) {
    scale.top = 1.6 * values.high;
    scale.foot = values.low / 2.5;
  }
  return scale;
}

struct DrawnBranches {
  std::string data;
  std::vector<std::string> layers;
  std::vector<std::string> names;

  /// `title`: empty for a further part of something that is named already.
  void add(const DataBlock& block, const std::string& name, const std::string& how,
           const std::string& title) {
    if (block.is_empty()) return;
    data += block.text();
    layers.push_back(fmt::format("${} using 1:2 with {} {}", name, how,
                                 title.empty() ? "notitle" : "title " + quoted(title)));
    if (!title.empty()) names.push_back(title);
  }
};

void add_rest(const BifurcationDiagram& diagram, const Scale& scale, DrawnBranches& drawing) {
  if (!is_amplitude(scale.quantity)) return;
  DataBlock block("rest");
  for (const Bounds& interval : diagram.rests) {
    block.row(scale.parameter(interval.low), scale.foot);
    block.row(scale.parameter(interval.high), scale.foot);
    block.gap();
  }
  drawing.add(block, "rest", "lines linewidth 5 linecolor rgb '#8a8a8a'", "can come to rest");
}

void add_branches(const BifurcationDiagram& diagram, const Scale& scale, DrawnBranches& drawing) {
  for (const Stability stability : {Stability::unstable, Stability::neutral, Stability::stable}) {
    const std::string name = fmt::format("branch{}", static_cast<int>(stability));
    DataBlock lines(name);
    DataBlock marks(name + "_marks");  // a line of one point is invisible
    for (const CycleBranch& branch : diagram.branches) {
      if (branch.stability != stability) continue;
      for (const CycleAt& point : branch.points) {
        const double value = scale.value(point);
        if (!std::isfinite(value)) continue;
        lines.row(scale.parameter(point.parameter), std::max(value, scale.foot));
        if (branch.points.size() == 1) marks.row(scale.parameter(point.parameter), value);
      }
      lines.gap();
    }
    const Style style = style_of(stability);
    drawing.add(lines, name, fmt::format("lines {}", style.line), style.name);
    drawing.add(marks, name + "_marks",
                stability == Stability::stable
                    ? "points pointtype 7 pointsize 0.7 linecolor rgb '#0072b2'"
                    : "points pointtype 6 pointsize 0.7 linecolor rgb '#d55e00'",
                "");
  }
}

void add_irregular(const BifurcationDiagram& diagram, const Scale& scale, DrawnBranches& drawing) {
  if (!is_amplitude(scale.quantity)) return;
  DataBlock block("irregular");
  for (const IrregularAt& motion : diagram.irregular) {
    const double value =
        (scale.quantity == Quantity::amplitude ? motion.amplitude : motion.motor_amplitude) /
        scale.per_value;
    if (std::isfinite(value)) {
      block.row(scale.parameter(motion.parameter), std::max(value, scale.foot));
    }
  }
  drawing.add(block, "irregular", "points pointtype 2 pointsize 0.8 linecolor rgb '#000000'",
              "motion that closes no cycle");
}

/// Borders without those that another one of their word covers.
std::vector<const MarkedBorder*> distinct(const BifurcationDiagram& diagram, const Axis& axis,
                                          const Scale& scale) {
  constexpr double together = 0.02;  // of the axes
  std::vector<const MarkedBorder*> kept;
  for (const MarkedBorder& border : diagram.borders) {
    const auto covers = [&](const MarkedBorder* other) {
      if (other->word != border.word || other->cycle.has_value() != border.cycle.has_value() ||
          std::abs(position_on(axis, other->parameter) - position_on(axis, border.parameter)) >
              together) {
        return false;
      }
      return !border.cycle || std::abs(scale.height(scale.value(*other->cycle)) -
                                       scale.height(scale.value(*border.cycle))) <= together;
    };
    if (std::none_of(kept.begin(), kept.end(), covers)) kept.push_back(&border);
  }
  return kept;
}

/// Open marks differ in shape, so that they are read without colour.
struct Mark {
  std::string_view word;
  int type;  ///< gnuplot's
};
constexpr std::array known_marks = {Mark{"fold", 6},
                                    Mark{"flip", 4},
                                    Mark{"branching", 8},
                                    Mark{"Neimark–Sacker", 12},
                                    Mark{"grazing", 3},
                                    Mark{"events change", 1},
                                    Mark{"endless period", 13},
                                    Mark{"loss of rest", 7},
                                    Mark{"cycle is lost", 10},
                                    Mark{"stability changes", 14}};

int mark_of(const std::string& word) {
  const auto* known = std::find_if(known_marks.begin(), known_marks.end(),
                                   [&](const Mark& mark) { return mark.word == word; });
  constexpr int other = 5;
  return known == known_marks.end() ? other : known->type;
}

/// One legend entry for each word.
void add_borders(const BifurcationDiagram& diagram, const Axis& axis, const Scale& scale,
                 DrawnBranches& drawing) {
  std::map<std::string, DataBlock> marks;
  std::map<std::string, DataBlock> upright;
  const auto block = [](std::map<std::string, DataBlock>& blocks, const std::string& word,
                        const char* name) -> DataBlock& {
    return blocks.try_emplace(word, fmt::format("{}{}", name, blocks.size())).first->second;
  };
  for (const MarkedBorder* border : distinct(diagram, axis, scale)) {
    const double parameter = scale.parameter(border->parameter);
    if (!border->cycle) {
      DataBlock& line = block(upright, border->word, "upright");
      line.row(parameter, scale.foot);
      line.row(parameter, scale.top);
      line.gap();
      continue;
    }
    // Rest has an amplitude, but no period.
    const double value = scale.value(*border->cycle);
    if (!std::isfinite(value) || (value == 0.0 && !is_amplitude(scale.quantity))) continue;
    block(marks, border->word, "border").row(parameter, std::max(value, scale.foot));
  }
  for (const auto& [word, line] : upright) {
    drawing.add(line, line.name(), "lines linewidth 1.4 dashtype (2,4) linecolor rgb '#555555'",
                word);
  }
  for (const auto& [word, points] : marks) {
    drawing.add(points, points.name(),
                fmt::format("points pointtype {} pointsize 1.4 linewidth 1.6 linecolor rgb 'black'",
                            mark_of(word)),
                word);
  }
}

std::string subtitle_of(const BifurcationDiagram& diagram, const Grid& grid) {
  std::string servo = diagram.searched == 0 ? gearlash::subtitle_of(grid) : "";
  if (!servo.empty()) return servo;
  return fmt::format("searched at {} values, cycles followed between them", diagram.searched);
}

}  // namespace

bool has_branches(Quantity quantity) { return value_of({.period = 1.0}, quantity).has_value(); }

std::string draw_bifurcations(const BifurcationDiagram& diagram, const Grid& grid,
                              Quantity quantity, const AngleUnit& angle, PictureFormat format) {
  const Axis& axis = grid.axes.front();
  const Scale scale = scale_of(diagram, grid, quantity, angle);
  DrawnBranches drawing;
  add_rest(diagram, scale, drawing);
  add_branches(diagram, scale, drawing);
  add_irregular(diagram, scale, drawing);
  add_borders(diagram, axis, scale, drawing);
  std::string labels;
  if (drawing.layers.empty()) {
    drawing.layers.emplace_back("1/0 notitle");
    labels = "set label 2 'no cycle was found' at graph 0.5, graph 0.5 center\n";
  }
  const ChartAxis x = chart_axis(axis, grid.drive, angle);
  const ChartAxis y{.label = label_of(quantity, grid, angle),
                    .logarithmic = scale.is_logarithmic,
                    .low = scale.foot,
                    .high = scale.top};
  const std::string title =
      "Cycles over " + in_words(axis.path) + ": " + in_words(std::string(name_of(quantity)));
  return run_gnuplot(terminal(format) + heading(title, subtitle_of(diagram, grid)) +
                         "set grid linewidth 0.5 linecolor rgb '#c4c4c4'\n" +
                         legend_below(drawing.names, format).commands + axis_commands('x', x) +
                         axis_commands('y', y) + labels + drawing.data +
                         plot_command(drawing.layers),
                     title);
}

}  // namespace gearlash
