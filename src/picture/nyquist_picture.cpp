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

enum class MarkKind { stable, unstable, exact_frequency, exact_amplitude };

struct KeyPoint {
  Complex at;
  MarkKind mark;
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
                        stable ? MarkKind::stable : MarkKind::unstable, name,
                        fmt::format("{} {}{}: {}", name, stable ? "stable" : "unstable",
                                    distinction(picture, analysis),
                                    motion_text(cycle.amplitude, cycle.balance.period, picture))});
    }
  }
  for (const drive::ExactMotion& cycle : picture.exact) {
    if (!is_drawn(cycle)) continue;
    points.push_back(
        {loop_at(picture.analyses.front().loop, turn / cycle.period), MarkKind::exact_frequency,
         "exact ω",
         "L at the exact frequency: " + motion_text(cycle.amplitude, cycle.period, picture)});
    for (const DescribingAnalysis& analysis : picture.analyses) {
      points.push_back(
          {inverse_gain(analysis.nonlinearity, drive::input_amplitude(analysis, cycle)),
           MarkKind::exact_amplitude, "exact A",
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
    return point.mark == MarkKind::stable;
  });
  const auto is_wanted = [&](MarkKind mark) {
    return mark == MarkKind::stable || mark == MarkKind::exact_frequency ||
           (mark == MarkKind::unstable && !has_stable);
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

struct CurveMark {
  Complex at;
  std::string text;
};

bool is_clear(const Complex& place, const std::vector<Complex>& taken, double distance) {
  return std::none_of(taken.begin(), taken.end(),
                      [&](const Complex& other) { return std::abs(place - other) < distance; });
}

/// Takes candidates in their order if they lie in the window with room around them.
class MarkChooser {
 public:
  MarkChooser(const Window& window, std::vector<Complex> taken)
      : window_(window), taken_(std::move(taken)) {}

  void offer(const Complex& at, const std::string& text, std::vector<CurveMark>& marks) {
    constexpr double room = 48.0;  // pixels
    constexpr double margin = 14.0;
    if (!is_finite(at) || !window_.holds(at, -margin)) return;
    const Complex place = window_.on_paper(at);
    if (!is_clear(place, taken_, room)) return;
    taken_.push_back(place);
    marks.push_back({at, text});
  }

 private:
  const Window& window_;
  std::vector<Complex> taken_;
};

/// 1, 2, 5, 3, 1.5 and 7 times powers of ten, the roundest first.
std::vector<double> round_numbers() {
  std::vector<double> numbers;
  for (const double digit : {1.0, 2.0, 5.0, 3.0, 1.5, 7.0}) {
    for (int power = -6; power <= 6; ++power) numbers.push_back(digit * std::pow(10.0, power));
  }
  return numbers;
}

std::vector<CurveMark> frequency_marks(const NyquistPicture& picture, MarkChooser& chooser) {
  std::vector<CurveMark> marks;
  const bool in_hertz = !picture.is_normalized;
  for (const double number : round_numbers()) {
    const double frequency = in_hertz ? turn * number : number;
    const std::string text = significant(number, label_digits);
    chooser.offer(loop_at(picture.analyses.front().loop, frequency),
                  in_hertz ? text + " Hz" : text + " ω_n", marks);
  }
  return marks;
}

std::vector<CurveMark> amplitude_marks(const DescribingAnalysis& analysis, MarkChooser& chooser) {
  const AmplitudeScale scale = scale_of(analysis.nonlinearity);
  std::vector<double> numbers = {2.0, 1.5, 1.2, 5.0, 1.1, 3.0, 1.0, 1.05, 10.0, 1.02, 1.01, 0.8};
  if (!scale.is_relative) numbers = round_numbers();
  std::vector<CurveMark> marks;
  for (const double number : numbers) {
    const double amplitude = number * scale.unit;
    if (amplitude <= scale.least) continue;
    const std::string unit = scale.is_relative ? std::string(" ") + scale.name : "";
    chooser.offer(inverse_gain(analysis.nonlinearity, amplitude),
                  significant(number, label_digits) + unit, marks);
  }
  return marks;
}

// ---- the drawing --------------------------------------------------------------------------------

struct DrawnCurve {
  Layer layer;
  Trace trace;
  std::vector<CurveMark> marks = {};
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
      {{.name = "L(jω)", .colour = "#0072b2"}, traced_loop(loop, window)}};
  for (std::size_t i = 0; i < picture.analyses.size(); ++i) {
    const DescribingAnalysis& analysis = picture.analyses[i];
    Layer layer = inverse_styles[i % inverse_styles.size()];
    layer.name =
        "−1/N(A)" + distinction(picture, analysis) + meaning_of(analysis, picture.is_normalized);
    curves.push_back({std::move(layer), traced_inverse_gain(analysis.nonlinearity, window)});
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

void choose_marks(const NyquistPicture& picture, const Window& window,
                  const std::vector<KeyPoint>& points, std::vector<DrawnCurve>& curves) {
  std::vector<Complex> taken = {window.on_paper(0.0)};  // where unnumbered marks crowd
  for (const KeyPoint& point : points) {
    if (is_finite(point.at)) taken.push_back(window.on_paper(point.at));
  }
  MarkChooser chooser(window, taken);
  for (std::size_t i = 0; i < picture.analyses.size(); ++i) {
    curves[i + 1].marks = amplitude_marks(picture.analyses[i], chooser);
  }
  curves[0].marks = frequency_marks(picture, chooser);
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

Mark shape_of(MarkKind mark) {
  switch (mark) {
    case MarkKind::stable:
      return Mark::disc;
    case MarkKind::unstable:
      return Mark::circle;
    case MarkKind::exact_frequency:
      return Mark::diamond;
    case MarkKind::exact_amplitude:
      break;
  }
  return Mark::open_diamond;
}

Layer layer_of(const KeyPoint& point, const Window& window) {
  Layer layer{
      .kind = LayerKind::marks, .name = point.legend, .mark = shape_of(point.mark), .size = 1.2};
  if (is_finite(point.at) && window.holds(point.at)) {
    layer.points = {{point.at.real(), point.at.imag()}};
  } else {
    layer.name += is_finite(point.at) ? "; outside" : ": none, too small";
  }
  return layer;
}

void add_texts(const std::vector<KeyPoint>& points, const std::vector<DrawnCurve>& curves,
               const Window& window, Panel& panel) {
  std::vector<PaperLine> lines;
  for (const DrawnCurve& curve : curves) {
    lines.push_back(seen_of(curve, window));
    for (const CurveMark& mark : curve.marks) lines.push_back({window.on_paper(mark.at)});
  }
  for (const KeyPoint& point : points) {
    if (is_finite(point.at)) lines.push_back({window.on_paper(point.at)});
  }
  TextPlacer placer(lines, window.size.imag());
  const auto add = [&](const Complex& at, PlotText text) {
    if (!is_finite(at) || !window.holds(at)) return;
    const auto place = placer.beside(window.on_paper(at), text.text, text.size, text.is_bold);
    if (!place) return;
    const Complex centre = window.from_paper(*place);
    text.at = {centre.real(), centre.imag()};
    panel.texts.push_back(std::move(text));
  };
  for (const KeyPoint& point : points) add(point.at, {.text = point.label, .is_bold = true});
  for (const DrawnCurve& curve : curves) {
    for (const CurveMark& mark : curve.marks) {
      add(mark.at, {.text = mark.text, .colour = curve.layer.colour, .size = 0.8});
    }
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
  std::vector<DrawnCurve> curves = traced_curves(picture, window);
  choose_marks(picture, window, points, curves);
  for (const DrawnCurve& curve : curves) {
    Layer marks{.kind = LayerKind::marks, .colour = curve.layer.colour, .size = 0.45};
    for (const CurveMark& mark : curve.marks) {
      marks.points.push_back({mark.at.real(), mark.at.imag()});
    }
    if (!curve.layer.points.empty()) panel.layers.push_back(curve.layer);
    panel.layers.push_back(std::move(marks));
    panel.layers.push_back({.kind = LayerKind::area,
                            .colour = curve.layer.colour,
                            .points = arrow_of(seen_of(curve, window), window)});
  }
  for (const KeyPoint& point : points) panel.layers.push_back(layer_of(point, window));
  add_texts(points, curves, window, panel);
  const bool has_exact = std::any_of(picture.exact.begin(), picture.exact.end(), is_drawn);
  return plot_of(picture.title,
                 std::string("cycles are predicted where L(jω) = −1/N(A)") +
                     (has_exact ? "; were that exact, the diamonds would be one point" : ""),
                 std::move(panel));
}

}  // namespace gearlash
