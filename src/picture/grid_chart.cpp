#include "picture/grid_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "picture/curve_panel.hpp"
#include "picture/grid_words.hpp"
#include "picture/hunting_curve.hpp"
#include "picture/plot_making.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

/// One curve of the chart: rows `first` … of the table, over the last axis.
NamedCurve curve_of(const GridTable& table, const Family& family, std::size_t first,
                    Quantity quantity) {
  const Axis& x = table.grid.axes.back();
  std::vector<double> place = values_at(table.grid, first);
  const auto servo_at = [&](double on_curve) {
    place.back() = on_curve;
    const std::optional<ProportionalServo> servo = family.servo_at(place);
    return servo ? servo->servo : NormalizedServo{.damping = 1.0};
  };
  const bool is_plastic = !family.engines().bounces && !family.engines().search;
  const double limit = limit_where_hunting_ends(quantity, servo_at(x.values.front()).backlash)
                           .value_or(std::numeric_limits<double>::infinity());
  const bool ends = is_plastic && std::isfinite(limit);
  std::vector<CurveServo> servos;
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    const Verdict verdict = table.table.verdict(first + i);
    // For searched drives rest has a value: an amplitude of 0.
    CurveServo servo{x.values[i], family.engines().search
                                      ? table.table[quantity][first + i]
                                      : motion_value(table.table, quantity, first + i)};
    if (ends && verdict == Verdict::hunts) servo.hunts = true;
    if (ends && verdict == Verdict::cannot_hunt) servo.hunts = false;
    servos.push_back(servo);
  }
  return curve_to_hunting_ends(servos, servo_at, limit);
}

/// The reason why these rows of the table have nothing to draw.
std::string word_for_nothing(const GridTable& table, std::size_t first, std::size_t count,
                             Quantity quantity) {
  bool all_rest = true;
  for (std::size_t row = first; row < first + count; ++row) {
    if (std::isinf(table.table[quantity][row])) return "infinite";
    const Verdict verdict = table.table.verdict(row);
    all_rest = all_rest && (verdict == Verdict::cannot_hunt || verdict == Verdict::comes_to_rest);
  }
  return all_rest ? "rests" : "not known";
}

/// Adds marks, because a line of one point is invisible, and a line between searched points is a
/// guess.
void mark_points(NamedCurve& curve, bool are_all_marked) {
  const auto is_drawn = [&](std::size_t i) {
    return i < curve.line.size() && std::isfinite(curve.line[i].y);
  };
  for (std::size_t i = 0; i < curve.line.size(); ++i) {
    const bool has_neighbour = !are_all_marked && (is_drawn(i + 1) || (i > 0 && is_drawn(i - 1)));
    if (is_drawn(i) && !has_neighbour) curve.marks.push_back(curve.line[i]);
  }
}

void draw_in(double x_unit, double y_unit, NamedCurve& curve) {
  for (MapCurve* points : {&curve.line, &curve.marks, &curve.ends}) {
    for (MapPoint& point : *points) point = {point.x / x_unit, point.y / y_unit};
  }
}

}  // namespace

Plot chart_plot(const GridTable& table, Quantity quantity) {
  const Grid& grid = table.grid;
  const Family family(grid);
  const Axis& x = grid.axes.back();
  const double x_unit = drawn_unit(x, grid.drive).size;
  const double y_unit = drawn_unit(quantity, grid).size;
  const std::size_t count = grid.axes.size() == 1 ? 1 : grid.axes.front().values.size();
  std::vector<NamedCurve> curves;
  double lowest = 0.0;
  bool nothing_drawn = true;
  bool has_ends = false;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i * x.values.size();
    NamedCurve curve = curve_of(table, family, first, quantity);
    const bool is_drawn =
        any_of(curve.line, [](const MapPoint& point) { return std::isfinite(point.y); });
    if (grid.axes.size() > 1) {
      const Axis& named = grid.axes.front();
      curve.name = in_words(named.path) + " " + text_with_unit(named, grid.drive, named.values[i]);
      if (!is_drawn) curve.name += ": " + word_for_nothing(table, first, x.values.size(), quantity);
    }
    for (const MapPoint& point : curve.line) lowest = std::min(lowest, point.y);
    if (!is_drawn) curve.line.clear();
    nothing_drawn = nothing_drawn && !is_drawn;
    has_ends = has_ends || !curve.ends.empty();
    mark_points(curve, has_words(x, grid.drive) || family.engines().search);
    if (has_words(x, grid.drive)) curve.line.clear();
    draw_in(x_unit, y_unit, curve);
    curves.push_back(std::move(curve));
  }
  Panel panel{.x = plot_axis(x, grid.drive), .y = plot_axis(quantity, grid)};
  if (!(lowest < 0.0)) panel.y.low = 0.0;
  constexpr double mark_size = 0.8;
  add_curves(curves, mark_size, panel);
  explain_curves("", "", mark_size, has_ends ? "hunting ends" : "", panel);
  if (nothing_drawn) {
    const std::string word = word_for_nothing(table, 0, table.table.rows(), quantity);
    say(word == "rests" ? "no limit cycle" : word, panel);
  }
  return plot_of(title_of(quantity), subtitle_of(grid), std::move(panel));
}

std::vector<Fault> faults_of_picture(const Grid& grid, const std::vector<std::string>& fields,
                                     bool has_curves) {
  constexpr std::size_t most_curves = 16;  // a longer legend leaves no room for them
  constexpr double narrowest_share =
      1e-3;  // of the larger end: else its numbers have too many digits
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < grid.axes.size(); ++i) {
    const Axis& axis = grid.axes[i];
    const double first = axis.values.front();
    const double last = axis.values.back();
    const auto refuse = [&](const std::string& value, const std::string& permitted) {
      faults.push_back(
          {fields.empty() ? axis.path : fields[i], value,
           "must " + permitted + " in a picture; tables (.csv, .json, .nc) may have it"});
    };
    const bool are_curves = has_curves && i + 1 < grid.axes.size();
    if (!std::isfinite(last)) {
      refuse(exact_text(last), "be finite");
    } else if (are_curves && axis.values.size() > most_curves) {
      refuse(fmt::format("{} values", axis.values.size()),
             fmt::format("be at most {}", most_curves));
    } else if (!are_curves && !has_words(axis, grid.drive) && axis.values.size() > 1 &&
               last - first < narrowest_share * std::abs(last)) {
      refuse(exact_text(first) + " to " + exact_text(last),
             fmt::format("span {:g} of itself or more", narrowest_share));
    }
  }
  return faults;
}

}  // namespace gearlash
