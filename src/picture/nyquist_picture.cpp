#include "picture/nyquist_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <optional>

#include "base/overloaded.hpp"
#include "output/describe_report.hpp"
#include "picture/nyquist_curves.hpp"
#include "picture/paper.hpp"

namespace gearlash {
namespace {

using drive::DescribedMotion;
using drive::DescribedPart;
using drive::DescribingAnalysis;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr int label_digits = 3;

// ---- key points ---------------------------------------------------------------------------------

constexpr Mark stable_mark = Mark::disc;
constexpr Mark unstable_mark = Mark::circle;
constexpr Mark exact_frequency_mark = Mark::diamond;
constexpr Mark exact_amplitude_mark = Mark::open_diamond;

struct KeyPoint {
  Complex at;
  Mark mark;
  std::string label;  ///< beside it
  std::string legend;
};

std::string motion_text(double size, double period, const NyquistPicture& picture) {
  const std::string swing = "±" + angle_text(size, picture.angle, label_digits);
  if (picture.is_normalized) return swing + ", ω = " + significant(turn / period, label_digits);
  return swing + ", " + frequency_text(period, false, label_digits);
}

/// The text after a comma that distinguishes analyses of one loop; empty for a single one.
std::string distinction(const NyquistPicture& picture, const DescribingAnalysis& analysis) {
  if (picture.analyses.size() < 2) return "";
  return analysis.part == DescribedPart::gap_load_held       ? ", held"
         : analysis.part == DescribedPart::gap_load_coasting ? ", coasting"
                                                             : "";
}

bool is_drawn(const drive::ExactMotion& motion) {
  return motion.is_stable && std::isfinite(motion.period) && std::isfinite(motion.motor_amplitude);
}

std::vector<KeyPoint> key_points(const NyquistPicture& picture) {
  std::vector<KeyPoint> points;
  int number = 0;
  for (const DescribingAnalysis& analysis : picture.analyses) {
    for (const DescribedMotion& cycle : analysis.cycles) {
      const bool stable = cycle.balance.stable;
      const std::string name = std::to_string(++number);
      points.push_back({loop_at(analysis.loop, cycle.balance.frequency),
                        stable ? stable_mark : unstable_mark, name,
                        fmt::format("{} {}{}: {}", name, stable ? "stable" : "unstable",
                                    distinction(picture, analysis),
                                    motion_text(cycle.amplitude, cycle.balance.period, picture))});
    }
  }
  for (const drive::ExactMotion& cycle : picture.exact) {
    if (!is_drawn(cycle)) continue;
    points.push_back(
        {loop_at(picture.analyses.front().loop, turn / cycle.period), exact_frequency_mark,
         "exact ω",
         "L at the exact frequency: " + motion_text(cycle.amplitude, cycle.period, picture)});
    for (const DescribingAnalysis& analysis : picture.analyses) {
      points.push_back(
          {inverse_gain(analysis.nonlinearity, drive::input_amplitude(analysis, cycle)),
           exact_amplitude_mark, "exact A",
           "−1/N at the exact amplitude" + distinction(picture, analysis)});
    }
  }
  return points;
}

bool is_finite(const Complex& point) {
  return std::isfinite(point.real()) && std::isfinite(point.imag());
}

/// The linear limit of −1/N; nothing for a relay.
std::optional<Complex> linear_end(const Nonlinearity& nonlinearity) {
  if (std::holds_alternative<Saturation>(nonlinearity)) {
    return -1.0 / std::get<Saturation>(nonlinearity).slope;
  }
  if (std::holds_alternative<DeadZone>(nonlinearity)) {
    return -1.0 / std::get<DeadZone>(nonlinearity).slope;
  }
  const bool is_gap = std::holds_alternative<FrictionControlledBacklash>(nonlinearity) ||
                      std::holds_alternative<InertiaControlledBacklash>(nonlinearity);
  return is_gap ? std::optional<Complex>(-1.0) : std::nullopt;
}

/// The largest |L| at the frequencies of poles and zeros: the extent of a bounded loop.
double extent_of(const TransferFunction& loop) {
  double extent = 0.0;
  const FactoredTransferFunction factors = factored(loop);
  for (const auto* roots : {&factors.zeros, &factors.poles}) {
    for (const Complex& root : *roots) {
      if (root != 0.0) extent = std::max(extent, std::abs(loop_at(loop, std::abs(root))));
    }
  }
  return extent > 0.0 && std::isfinite(extent) ? extent : 1.0;
}

/// The window with the origin, the linear end of −1/N, stable cycles and the exact frequency. Other
/// points are included up to three times as far from the origin.
Window critical_window(const NyquistPicture& picture, const std::vector<KeyPoint>& points,
                       const Complex& size) {
  std::vector<Complex> shown = {0.0};
  for (const DescribingAnalysis& analysis : picture.analyses) {
    if (const auto end = linear_end(analysis.nonlinearity)) {
      shown.push_back(*end);
      shown.push_back(1.6 * *end);  // shows some of the curve towards it
    }
  }
  const bool has_stable = std::any_of(points.begin(), points.end(), [](const KeyPoint& point) {
    return point.mark == stable_mark;
  });
  const auto is_wanted = [&](Mark mark) {
    return mark == stable_mark || mark == exact_frequency_mark ||
           (mark == unstable_mark && !has_stable);
  };
  for (const KeyPoint& point : points) {
    if (is_wanted(point.mark)) shown.push_back(point.at);
  }
  double radius = 0.0;
  for (const Complex& point : shown) radius = std::max(radius, std::abs(point));
  if (radius == 0.0) {
    const double extent = extent_of(picture.analyses.front().loop);
    shown.insert(shown.end(), {{-extent, -extent}, {extent, extent}});
    radius = extent;
  }
  constexpr double reach = 3.0;
  for (const KeyPoint& point : points) {
    if (is_finite(point.at) && std::abs(point.at) <= reach * radius) shown.push_back(point.at);
  }
  return window_around(shown, size);
}

// ---- marks on the curves ------------------------------------------------------------------------

/// A point of a curve that may be marked.
struct Candidate {
  Complex at;
  std::string text;
};

/// 1, 2, 5, 3, 1.5 and 7 times powers of ten, the roundest first.
std::vector<double> round_numbers() {
  std::vector<double> numbers;
  for (const double digit : {1.0, 2.0, 5.0, 3.0, 1.5, 7.0}) {
    for (int power = -6; power <= 6; ++power) numbers.push_back(digit * std::pow(10.0, power));
  }
  return numbers;
}

/// The roundest first, of L.
std::vector<Candidate> frequencies(const NyquistPicture& picture) {
  std::vector<Candidate> candidates;
  for (const double number : round_numbers()) {
    const double frequency = picture.is_normalized ? number : turn * number;
    candidates.push_back(
        {loop_at(picture.analyses.front().loop, frequency),
         significant(number, label_digits) + (picture.is_normalized ? " ω_n" : " Hz")});
  }
  return candidates;
}

/// The most telling first, of −1/N.
std::vector<Candidate> amplitudes(const DescribingAnalysis& analysis) {
  const AmplitudeScale scale = scale_of(analysis.nonlinearity);
  std::vector<double> numbers = {2.0, 1.5, 1.2, 5.0, 1.1, 3.0, 1.0, 1.05, 10.0, 1.02, 1.01, 0.8};
  if (!scale.is_relative) numbers = round_numbers();
  std::vector<Candidate> candidates;
  for (const double number : numbers) {
    const double amplitude = number * scale.unit;
    if (amplitude <= scale.least) continue;
    candidates.push_back({inverse_gain(analysis.nonlinearity, amplitude),
                          significant(number, label_digits) +
                              (scale.is_relative ? std::string(" ") + scale.name : "")});
  }
  return candidates;
}

// ---- the drawing --------------------------------------------------------------------------------

struct DrawnCurve {
  Layer layer;
  Trace trace;
  std::vector<Candidate> marks;
};

/// The unit of the amplitude marks.
std::string meaning_of(const DescribingAnalysis& analysis, bool is_normalized) {
  switch (analysis.part) {
    case DescribedPart::torque_limit:
      return ", A by the limit T_max";
    case DescribedPart::coulomb_friction:
      return is_normalized ? ", A in rad ω_n" : ", A in rad/s";
    case DescribedPart::dead_band:
    case DescribedPart::relay:
      return ", A by the threshold";
    default:
      return ", A by half the gap, h";
  }
}

std::vector<DrawnCurve> traced_curves(const NyquistPicture& picture, const Window& window) {
  const std::array inverse_styles = {Layer{.colour = "#d55e00", .dashes = "10,4"},
                                     Layer{.colour = "#009e73", .dashes = "4,3"},
                                     Layer{.colour = "#cc79a7", .dashes = "12,3,3,3"}};
  const TransferFunction& loop = picture.analyses.front().loop;
  std::vector<DrawnCurve> curves = {
      {{.name = "L(jω)", .colour = "#0072b2"}, traced_loop(loop, window), frequencies(picture)}};
  for (std::size_t i = 0; i < picture.analyses.size(); ++i) {
    const DescribingAnalysis& analysis = picture.analyses[i];
    Layer layer = inverse_styles[i % inverse_styles.size()];
    layer.name =
        "−1/N(A)" + distinction(picture, analysis) + meaning_of(analysis, picture.is_normalized);
    curves.push_back({std::move(layer), traced_inverse_gain(analysis.nonlinearity, window),
                      amplitudes(analysis)});
  }
  for (DrawnCurve& curve : curves) {
    constexpr double outside = 240.0;
    for (const TracePoint& point : curve.trace) {
      if (is_finite(point.value) && window.holds(point.value, outside)) {
        curve.layer.points.push_back({point.value.real(), point.value.imag()});
      } else {
        append({}, curve.layer.points);
      }
    }
  }
  return curves;
}

/// The curve's visible points on paper, not too close.
PaperLine seen_of(const DrawnCurve& curve, const Window& window) {
  PaperLine seen;
  for (const TracePoint& point : curve.trace) {
    if (!is_finite(point.value) || !window.holds(point.value)) continue;
    const Complex place = window.on_paper(point.value);
    if (seen.empty() || std::abs(place - seen.back()) > 2.0) seen.push_back(place);
  }
  return seen;
}

/// The outline of an arrow's head towards a growing parameter, in the middle of the visible curve.
MapCurve arrow_of(const PaperLine& seen, const Window& window) {
  constexpr std::size_t apart = 4;
  if (seen.size() < 2 * apart) return {};
  const Complex tail = seen[seen.size() * 2 / 5];
  const Complex way = seen[seen.size() * 2 / 5 + apart] - tail;
  const Complex unit = way / std::abs(way);
  MapCurve outline;
  for (const Complex& corner : {Complex{13.0, 0.0}, Complex{0.0, 4.5}, Complex{0.0, -4.5}}) {
    const Complex place = window.from_paper(tail + corner * unit);
    outline.push_back({place.real(), place.imag()});
  }
  return outline;
}

Layer layer_of(const KeyPoint& point, const Window& window) {
  Layer layer{.kind = LayerKind::marks, .name = point.legend, .mark = point.mark, .size = 1.2};
  if (is_finite(point.at) && window.holds(point.at)) {
    layer.points = {{point.at.real(), point.at.imag()}};
  } else {
    layer.name += is_finite(point.at) ? "; outside" : ": none, too small";
  }
  return layer;
}

MapPoint map_point(const Complex& point) { return {point.real(), point.imag()}; }

/// Adds the marks of the curves that have room around them, and all texts.
void add_marks(const std::vector<KeyPoint>& points, const std::vector<DrawnCurve>& curves,
               const Window& window, Panel& panel) {
  std::vector<PaperLine> lines;
  for (const DrawnCurve& curve : curves) lines.push_back(seen_of(curve, window));
  std::vector<Complex> taken = {window.on_paper(0.0)};  // where unnumbered marks crowd
  for (const KeyPoint& point : points) {
    if (!is_finite(point.at)) continue;
    taken.push_back(window.on_paper(point.at));
    lines.push_back({taken.back()});
  }
  TextPlacer placer(lines, window.size.imag());
  const auto add_text = [&](const Complex& at, PlotText text) {
    const auto place = placer.beside(window.on_paper(at), text.text, text.size, text.is_bold);
    if (!place) return false;
    text.at = map_point(window.from_paper(*place));
    panel.texts.push_back(std::move(text));
    return true;
  };
  for (const KeyPoint& point : points) {
    if (is_finite(point.at) && window.holds(point.at)) {
      add_text(point.at, {.text = point.label, .is_bold = true});
    }
  }
  constexpr double room = 48.0;  // pixels
  constexpr double margin = 14.0;
  for (auto curve = curves.rbegin(); curve != curves.rend(); ++curve) {
    Layer marks{.kind = LayerKind::marks, .colour = curve->layer.colour, .size = 0.45};
    for (const Candidate& mark : curve->marks) {
      if (!is_finite(mark.at) || !window.holds(mark.at, -margin)) continue;
      const Complex place = window.on_paper(mark.at);
      const bool is_clear = std::none_of(taken.begin(), taken.end(), [&](const Complex& other) {
        return std::abs(place - other) < room;
      });
      if (!is_clear ||
          !add_text(mark.at, {.text = mark.text, .colour = marks.colour, .size = 0.8})) {
        continue;
      }
      taken.push_back(place);
      marks.points.push_back(map_point(mark.at));
    }
    panel.layers.push_back(std::move(marks));
  }
}

}  // namespace

std::vector<DescribingAnalysis> loop_analyses(const std::vector<DescribingAnalysis>& analyses,
                                              DescribedPart part) {
  const auto is_gap = [](DescribedPart other) {
    return other == DescribedPart::gap_load_held || other == DescribedPart::gap_load_coasting;
  };
  std::vector<DescribingAnalysis> found;
  std::copy_if(analyses.begin(), analyses.end(), std::back_inserter(found),
               [&](const DescribingAnalysis& analysis) {
                 const bool is_wanted =
                     analysis.part == part || (is_gap(part) && is_gap(analysis.part));
                 return is_wanted && is_in_loop(analysis);
               });
  return found;
}

Plot nyquist_plot(const NyquistPicture& picture) {
  Panel panel;
  const std::vector<KeyPoint> points = key_points(picture);
  const Window window = critical_window(picture, points, {panel_width, panel.height});
  const Complex opposite = window.from_paper(window.size);
  panel.x = {.name = "real part", .low = window.corner.real(), .high = opposite.real()};
  panel.y = {.name = "imaginary part", .low = window.corner.imag(), .high = opposite.imag()};
  panel.layers.push_back({.colour = "#888888",
                          .width = 0.8,
                          .points = joined({{{*panel.x.low, 0.0}, {*panel.x.high, 0.0}},
                                            {{0.0, *panel.y.low}, {0.0, *panel.y.high}}})});
  const std::vector<DrawnCurve> curves = traced_curves(picture, window);
  for (const DrawnCurve& curve : curves) {
    if (!curve.layer.points.empty()) panel.layers.push_back(curve.layer);
    panel.layers.push_back({.kind = LayerKind::area,
                            .colour = curve.layer.colour,
                            .points = arrow_of(seen_of(curve, window), window)});
  }
  for (const KeyPoint& point : points) panel.layers.push_back(layer_of(point, window));
  add_marks(points, curves, window, panel);
  const bool has_exact = std::any_of(picture.exact.begin(), picture.exact.end(), is_drawn);
  return plot_of(picture.title,
                 std::string("cycles are predicted where L(jω) = −1/N(A)") +
                     (has_exact ? "; were that exact, the diamonds would be one point" : ""),
                 std::move(panel));
}

}  // namespace gearlash
