#include "picture/plot_making.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/extent.hpp"
#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/units.hpp"

namespace gearlash {
namespace {

constexpr double tiny = 1e-9;  ///< of a step: rounding

std::string superscript(int number) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += digits[digit - '0'];
  return text;
}

/// "2·10⁻⁵", of numbers with many zeros; else "0.02".
std::string number_text(double digits, int power, bool with_power) {
  if (!with_power) return fmt::format("{:.6g}", digits * std::pow(10.0, power));
  return (digits == 1.0 ? "" : fmt::format("{:.6g}·", digits)) + "10" + superscript(power);
}

/// The power of ten, a multiple of three, that numbers up to `largest` are multiples of.
int shown_power(double largest) {
  constexpr double smallest_plain = 0.02;
  constexpr double largest_plain = 1e5;
  if (!(largest > 0.0) || (largest >= smallest_plain && largest < largest_plain)) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0 + tiny));
}

std::string unit_of_power(const std::string& unit, int power) {
  if (power == 0) return unit;
  constexpr std::pair<int, const char*> prefixes[] = {{-9, "n"}, {-6, "µ"}, {-3, "m"}, {6, "M"}};
  for (const auto& [of, prefix] : prefixes) {
    if (power == of && (unit.starts_with("rad") || unit == "N m")) return prefix + unit;
  }
  return "10" + superscript(power) + (unit.empty() ? "" : " " + unit);
}

std::vector<Tic> even_tics(const Bounds& range, int most, int power) {
  const double step = round_step(range.high - range.low, most);
  std::vector<Tic> tics;
  for (double i = std::ceil(range.low / step - tiny); i * step <= range.high + tiny * step; ++i) {
    const double value = i == 0.0 ? 0.0 : i * step;
    tics.push_back({value, fmt::format("{:.6g}", value / std::pow(10.0, power))});
  }
  return tics;
}

/// Powers of ten, as many numbered as there is room for, and short tics between them; of less than
/// two numbers also 2 and 5, else even steps.
std::vector<Tic> logarithmic_tics(const Bounds& range, int most) {
  constexpr int most_numbers = 9;
  const int first = static_cast<int>(std::floor(std::log10(range.low) + tiny));
  const int last = static_cast<int>(std::floor(std::log10(range.high) + tiny));
  const bool has_powers = range.low < 0.99e-4 || range.high > 1.01e6;
  const int step = (last - first) / most_numbers + 1;
  for (const bool is_short : {false, true}) {
    std::vector<Tic> tics;
    std::ptrdiff_t numbers = 0;
    for (int power = first; power <= last; ++power) {
      for (int digit = 1; digit <= (step == 1 ? 9 : 1); ++digit) {
        const double value = digit * std::pow(10.0, power);
        if (value < range.low * (1.0 - tiny) || value > range.high * (1.0 + tiny)) continue;
        const bool has_number =
            digit == 1 ? power % step == 0 : is_short && (digit == 2 || digit == 5);
        tics.push_back({value, has_number ? number_text(digit, power, has_powers) : ""});
        numbers += has_number ? 1 : 0;
      }
    }
    if (numbers >= 2) return tics;
  }
  std::vector<Tic> tics = even_tics(range, most, has_powers ? last : 0);
  for (Tic& tic : tics) {
    if (has_powers) tic.text += "·10" + superscript(last);
  }
  return tics;
}

/// Ends that are open are NaN.
double value_or(double end, double other) { return std::isnan(end) ? other : end; }

/// The ends of the data along the axis.
Bounds ends_of_data(const Panel& panel, const PlotAxis& axis, double MapPoint::*along,
                    double margin) {
  Extent data;
  for (const Layer& layer : panel.layers) {
    for (const MapPoint& point : layer.points) {
      const bool is_drawn = std::isfinite(point.x) && std::isfinite(point.y);
      if (is_drawn && (!axis.logarithmic || point.*along > 0.0)) data.include(point.*along);
    }
  }
  constexpr double ratio = 1.05;
  if (data.low > data.high) {
    return axis.logarithmic ? Bounds{0.5 * value_or(axis.high, 2.0), 2.0 * value_or(axis.low, 1.0)}
                            : Bounds{0.0, value_or(axis.low, 0.0) + 1.0};
  }
  return axis.logarithmic ? Bounds{data.low / ratio, data.high * ratio}
                          : widened(data, data.low < data.high ? margin : 0.1);
}

PlotAxis finished_axis(const Panel& panel, PlotAxis axis, double MapPoint::*along, double margin,
                       int most) {
  const Bounds data = ends_of_data(panel, axis, along, margin);
  axis.low = value_or(axis.low, data.low);
  axis.high = value_or(axis.high, data.high);
  const bool is_plain = axis.logarithmic || !axis.tics.empty();
  const int power = is_plain ? 0 : shown_power(std::max(std::abs(axis.low), std::abs(axis.high)));
  if (axis.tics.empty()) {
    const Bounds ends{axis.low, axis.high};
    axis.tics = axis.logarithmic ? logarithmic_tics(ends, most) : even_tics(ends, most, power);
  }
  axis.label = axis.name.empty() ? "" : name_with_unit(axis.name, unit_of_power(axis.unit, power));
  return axis;
}

/// "position (deg) over time (s): load, motor".
std::string description_of(const Panel& panel) {
  std::vector<std::string> names;
  for (const Layer& layer : panel.layers) {
    if (!layer.name.empty() && !contains(names, layer.name)) names.push_back(layer.name);
  }
  std::string axes = panel.y.label;
  if (!panel.x.label.empty()) axes += (axes.empty() ? "over " : " over ") + panel.x.label;
  return axes + (names.empty() ? "" : (axes.empty() ? "" : ": ") + listed(names));
}

}  // namespace

Plot finished(Plot plot) {
  std::set<std::string> named = {""};
  for (PlotColumn& column : plot.columns) {
    for (Panel& panel : column) {
      panel.x = finished_x(panel, panel_width / static_cast<double>(plot.columns.size()));
      panel.y = finished_y(panel);
      for (Layer& layer : panel.layers) layer.in_legend = named.insert(layer.name).second;
      plot.description += (plot.description.empty() ? "" : "; ") + description_of(panel);
    }
  }
  return plot;
}

Plot plot_of(std::string title, std::string subtitle, Panel panel) {
  Plot plot{.title = std::move(title)};
  if (!subtitle.empty()) plot.subtitles.push_back(std::move(subtitle));
  plot.columns.resize(1);
  plot.columns.front().push_back(std::move(panel));
  return finished(std::move(plot));
}

void append(const MapCurve& curve, MapCurve& points) {
  if (!points.empty()) points.push_back({not_a_number, not_a_number});
  add_all(points, curve);
}

MapCurve joined(const std::vector<MapCurve>& curves) {
  MapCurve points;
  for (const MapCurve& curve : curves) append(curve, points);
  return points;
}

MapCurve rectangle(const Bounds& x, const Bounds& y) {
  return {{x.low, y.low}, {x.high, y.low}, {x.high, y.high}, {x.low, y.high}};
}

Layer with(Layer style, MapCurve points) {
  style.points = std::move(points);
  return style;
}

MapCurve near(MapCurve points, const Panel& panel) {
  const auto is_near = [](double place) { return place > -1.0 && place < 2.0; };
  for (MapPoint& point : points) {
    if (!is_near(position_on(span_of(panel.x), point.x)) ||
        !is_near(position_on(span_of(panel.y), point.y))) {
      point = {not_a_number, not_a_number};
    }
  }
  return points;
}

Layer zero_lines(const Panel& panel, Layer style) {
  return with(std::move(style), joined({{{panel.x.low, 0.0}, {panel.x.high, 0.0}},
                                        {{0.0, panel.y.low}, {0.0, panel.y.high}}}));
}

PlotAxis finished_x(const Panel& panel, double width) {
  return finished_axis(panel, panel.x, &MapPoint::x, 0.0,
                       std::clamp(static_cast<int>(width / 60.0), 4, 7));
}

PlotAxis finished_y(const Panel& panel) {
  constexpr double margin = 0.03;
  return finished_axis(panel, panel.y, &MapPoint::y, margin,
                       std::clamp(static_cast<int>(panel.height / 25.0), 5, 7));
}

std::string label_of(const PlotAxis& axis) { return name_with_unit(axis.name, axis.unit); }

Axis span_of(const PlotAxis& axis) {
  return {.values = {axis.low, axis.high}, .logarithmic = axis.logarithmic};
}

std::string mixed(const Colour& from, const Colour& to, double share) {
  const auto part = [&](double Colour::*one) {
    return static_cast<int>(
        std::lround(from.*one + std::clamp(share, 0.0, 1.0) * (to.*one - from.*one)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", part(&Colour::red), part(&Colour::green),
                     part(&Colour::blue));
}

double round_step(double length, int most) {
  return round_number_from(length / most, std::array{1.0, 2.0, 5.0});
}

Bounds widened(const Bounds& range, double margin) {
  const auto [low, high] = range;
  const double length = high > low ? high - low : std::max(1.0, std::abs(high));
  return {low - margin * length, high + margin * length};
}

}  // namespace gearlash
