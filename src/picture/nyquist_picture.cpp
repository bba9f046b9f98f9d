#include "picture/nyquist_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "base/extent.hpp"
#include "base/lists.hpp"
#include "base/overloaded.hpp"
#include "output/describe_report.hpp"
#include "picture/paper.hpp"
#include "picture/plot_making.hpp"
#include "question/loop/describing/harmonic_balance.hpp"

namespace gearlash {
namespace {

using Complex = std::complex<double>;
using drive::DescribedMotion;
using drive::DescribedPart;
using drive::DescribingAnalysis;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr int label_digits = 3;

// ---- the complex plane --------------------------------------------------------------------------

/// The ends of the axes around the points with a margin, larger on the left, where L comes from.
/// Both axes have the same scale.
void show(const std::vector<Complex>& points, Panel& panel) {
  Extent real;
  Extent imaginary;
  for (const Complex& point : points) {
    real.include(point.real());
    imaginary.include(point.imag());
  }
  constexpr double filled = 0.68;  // share of the frame
  const double pixel =
      std::max({imaginary.width() / panel.height, real.width() / panel_width, 1e-300}) / filled;
  const double left = real.low - 0.65 * (panel_width * pixel - real.width());
  const double below = imaginary.low - 0.5 * (panel.height * pixel - imaginary.width());
  panel.x = {.name = "real part", .low = left, .high = left + panel_width * pixel};
  panel.y = {.name = "imaginary part", .low = below, .high = below + panel.height * pixel};
}

bool is_finite(const Complex& point) {
  return std::isfinite(point.real()) && std::isfinite(point.imag());
}

MapPoint map_point(const Complex& point) { return {point.real(), point.imag()}; }

Complex loop_at(const TransferFunction& loop, double frequency) {
  return frequency_response(loop, frequency).value;
}

/// −1/N. Not finite if N is 0 or undefined.
Complex inverse_gain(const Nonlinearity& nonlinearity, double amplitude) {
  return -1.0 / describing_gain(nonlinearity, amplitude);
}

/// The curve −1/N of a nonlinearity: its marks, and where it begins.
struct InverseGain {
  double unit;       ///< of marked amplitudes
  const char* name;  ///< of the unit; empty: marks are round numbers, else typical multiples
  const char* meaning;
  double least;                             ///< below it N is undefined, 0 or constant
  std::optional<double> linear_end = -1.0;  ///< its limit; nothing for a relay
};

InverseGain curve_of(const Nonlinearity& nonlinearity, bool is_normalized) {
  constexpr const char* half_gap = ", A by half the gap, h";
  constexpr const char* threshold = ", A by the threshold";
  return std::visit(
      Overloaded{
          [](const FrictionControlledBacklash& play) -> InverseGain {
            return {0.5 * play.gap, "h", half_gap, 0.5 * play.gap};
          },
          [](const InertiaControlledBacklash& play) -> InverseGain {
            return {0.5 * play.gap, "h", half_gap, play.gap / std::numbers::pi};
          },
          [](const RelayWithHysteresis& relay) -> InverseGain {
            return {relay.half_width, "δ", threshold, relay.half_width, std::nullopt};
          },
          [](const Saturation& saturation) -> InverseGain {
            const double linear = saturation.limit / saturation.slope;
            return {linear, "T_max", ", A by the limit T_max", linear, -1.0 / saturation.slope};
          },
          [&](const CoulombFriction&) -> InverseGain {
            return {1.0, "", is_normalized ? ", A in rad ω_n" : ", A in rad/s", 0.0, std::nullopt};
          },
          [](const DeadZone& zone) -> InverseGain {
            return {zone.half_width, "h", threshold, zone.half_width, -1.0 / zone.slope};
          }},
      nonlinearity);
}

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
  return swing + ", " + significant(1.0 / period, label_digits) + " Hz";
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

/// Around the origin, the linear end of −1/N, stable cycles and the exact frequency. Other points
/// are included up to three times as far from the origin.
Panel critical_panel(const NyquistPicture& picture, const std::vector<KeyPoint>& points) {
  std::vector<Complex> shown = {0.0};
  for (const DescribingAnalysis& analysis : picture.analyses) {
    if (const auto end = curve_of(analysis.nonlinearity, picture.is_normalized).linear_end) {
      shown.push_back(*end);
      shown.push_back(1.6 * *end);  // shows some of the curve towards it
    }
  }
  const bool has_stable =
      any_of(points, [](const KeyPoint& point) { return point.mark == stable_mark; });
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
  Panel panel;
  show(shown, panel);
  return panel;
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
  return of_each(round_numbers(), [&](double number) {
    const double frequency = picture.is_normalized ? number : turn * number;
    return Candidate{loop_at(picture.analyses.front().loop, frequency),
                     significant(number, label_digits) + (picture.is_normalized ? " ω_n" : " Hz")};
  });
}

/// The most telling first, of −1/N.
std::vector<Candidate> amplitudes(const Nonlinearity& nonlinearity, const InverseGain& curve) {
  const bool is_relative = *curve.name != '\0';
  std::vector<double> numbers = {2.0, 1.5, 1.2, 5.0, 1.1, 3.0, 1.0, 1.05, 10.0, 1.02, 1.01, 0.8};
  if (!is_relative) numbers = round_numbers();
  std::vector<Candidate> candidates;
  for (const double number : numbers) {
    const double amplitude = number * curve.unit;
    if (amplitude <= curve.least) continue;
    candidates.push_back(
        {inverse_gain(nonlinearity, amplitude),
         significant(number, label_digits) + (is_relative ? " " : "") + curve.name});
  }
  return candidates;
}

// ---- the drawing --------------------------------------------------------------------------------

struct DrawnCurve {
  Layer layer = {};
  std::vector<Candidate> marks = {};
  PaperLine seen = {};  ///< its visible points, not too close
};

/// Sets the curve's points in and near the panel. The parameter runs from `low` to `high`, evenly
/// in its logarithm.
void trace(const std::function<Complex(double parameter)>& curve, const Bounds& range,
           const Panel& panel, DrawnCurve& drawn) {
  constexpr int steps = 20'000;
  constexpr double apart = 1.5;  // pixels
  const Paper paper(panel);
  MapCurve points;
  Complex last = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    const MapPoint point = map_point(
        curve(range.low * std::pow(range.high / range.low, static_cast<double>(i) / steps)));
    const Complex place = paper.on_paper(point);
    if (std::abs(place - last) < apart) continue;
    points.push_back(point);
    if (paper.holds(place)) drawn.seen.push_back(place);
    last = place;
  }
  drawn.layer.points = near(std::move(points), panel);
}

/// −1/N, from the amplitude on at which it begins.
void trace_inverse_gain(const Nonlinearity& nonlinearity, double least, const Panel& panel,
                        DrawnCurve& drawn) {
  // Without a least amplitude, −1/N is proportional to the amplitude.
  const double height = panel.y.high - panel.y.low;
  const double size = least > 0.0 ? least : height / std::abs(inverse_gain(nonlinearity, 1.0));
  trace([&](double excess) { return inverse_gain(nonlinearity, least + excess); },
        {1e-8 * size, 1e6 * size}, panel, drawn);
}

std::vector<DrawnCurve> traced_curves(const NyquistPicture& picture, const Panel& panel) {
  const std::array inverse_styles = {Layer{.colour = "#d55e00", .dashes = "10,4"},
                                     Layer{.colour = "#009e73", .dashes = "4,3"},
                                     Layer{.colour = "#cc79a7", .dashes = "12,3,3,3"}};
  const TransferFunction& loop = picture.analyses.front().loop;
  std::vector<DrawnCurve> curves = {{{.name = "L(jω)", .colour = "#0072b2"}, frequencies(picture)}};
  trace([&](double frequency) { return loop_at(loop, frequency); }, natural_frequency_range(loop),
        panel, curves.front());
  for (const DescribingAnalysis& analysis : picture.analyses) {
    const InverseGain inverse = curve_of(analysis.nonlinearity, picture.is_normalized);
    DrawnCurve curve{inverse_styles[(curves.size() - 1) % inverse_styles.size()],
                     amplitudes(analysis.nonlinearity, inverse)};
    curve.layer.name = "−1/N(A)" + distinction(picture, analysis) + inverse.meaning;
    trace_inverse_gain(analysis.nonlinearity, inverse.least, panel, curve);
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// The outline of an arrow's head towards a growing parameter, in the middle of the visible curve.
MapCurve arrow_of(const PaperLine& seen, const Paper& paper) {
  constexpr std::size_t apart = 5;
  if (seen.size() < 3 * apart) return {};
  const Complex tail = seen[seen.size() * 2 / 5];
  const Complex way = seen[seen.size() * 2 / 5 + apart] - tail;
  const Complex unit = way / std::abs(way);
  return of_each(std::array{Complex{13.0, 0.0}, Complex{0.0, 4.5}, Complex{0.0, -4.5}},
                 [&](const Complex& corner) { return paper.on_map(tail + corner * unit); });
}

bool is_seen(const Complex& point, const Paper& paper, double margin = 0.0) {
  return is_finite(point) && paper.holds(paper.on_paper(map_point(point)), margin);
}

Layer layer_of(const KeyPoint& point, const Paper& paper) {
  Layer layer{.kind = LayerKind::marks, .name = point.legend, .mark = point.mark, .size = 1.0};
  if (is_seen(point.at, paper)) {
    layer.points = {map_point(point.at)};
  } else {
    layer.name += is_finite(point.at) ? "; outside" : ": none, too small";
  }
  return layer;
}

/// Adds the marks of the curves that have room around them, and all texts.
void add_marks(const std::vector<KeyPoint>& points, const std::vector<DrawnCurve>& curves,
               const Paper& paper, Panel& panel) {
  std::vector<PaperLine> lines = of_each(curves, &DrawnCurve::seen);
  std::vector<Complex> taken = {paper.on_paper(MapPoint{})};  // where unnumbered marks crowd
  for (const KeyPoint& point : points) {
    if (!is_finite(point.at)) continue;
    taken.push_back(paper.on_paper(map_point(point.at)));
    lines.push_back({taken.back()});
  }
  TextPlacer placer(lines, paper.height());
  const auto add_text = [&](const Complex& at, PlotText text) {
    const auto place =
        placer.beside(paper.on_paper(map_point(at)), text.text, text.size, text.is_bold);
    if (!place) return false;
    text.at = paper.on_map(*place);
    panel.texts.push_back(std::move(text));
    return true;
  };
  for (const KeyPoint& point : points) {
    if (is_seen(point.at, paper)) {
      add_text(point.at, {.text = point.label, .is_bold = true});
    }
  }
  constexpr double room = 48.0;  // pixels
  constexpr double margin = 14.0;
  for (auto curve = curves.rbegin(); curve != curves.rend(); ++curve) {
    Layer marks{.kind = LayerKind::marks, .colour = curve->layer.colour, .size = 0.45};
    for (const Candidate& mark : curve->marks) {
      if (!is_seen(mark.at, paper, -margin)) continue;
      const Complex place = paper.on_paper(map_point(mark.at));
      const auto is_near = [&](const Complex& other) { return std::abs(place - other) < room; };
      const PlotText text{.text = mark.text, .colour = marks.colour, .size = 0.8};
      if (any_of(taken, is_near) || !add_text(mark.at, text)) continue;
      taken.push_back(place);
      marks.points.push_back(map_point(mark.at));
    }
    panel.layers.push_back(std::move(marks));
  }
}

/// A part as a question has it, and as the title of its picture has it.
struct DrawnPart {
  DescribedPart part;
  std::string_view word;
  const char* title;
};
constexpr DrawnPart drawn_parts[] = {
    {DescribedPart::gap_load_held, "gap", "The gap by its describing functions"},
    {DescribedPart::elastic_gap, "elastic-gap",
     "A gap with elastic faces by its describing function"},
    {DescribedPart::torque_limit, "torque-limit", "The torque limit by its describing function"},
    {DescribedPart::coulomb_friction, "coulomb-friction",
     "Coulomb friction by its describing function"},
    {DescribedPart::dead_band, "dead-band", "The dead band by its describing function"},
    {DescribedPart::relay, "relay", "The relay by its describing function"}};

}  // namespace

std::vector<std::string> parts_to_draw() {
  return of_each<std::string>(drawn_parts, &DrawnPart::word);
}

Plot nyquist_plot(const DescribeReport& report, std::string_view part) {
  for (const DescribingAnalysis& analysis : report.analyses) {
    if (!is_in_loop(analysis)) continue;
    for (const DrawnPart& drawn : drawn_parts) {
      const bool is_asked = part.empty() || drawn.word == part;
      if (!is_asked || loop_analyses({analysis}, drawn.part).empty()) continue;
      return nyquist_plot({.title = drawn.title,
                           .analyses = loop_analyses(report.analyses, drawn.part),
                           .exact = drive::exact_motions(report.answer),
                           .angle = report.drive.angle_unit,
                           .is_normalized = is_normalized(report.drive)});
    }
  }
  if (!part.empty()) refuse("part", part, "must be a part that the drive has inside its loop");
  refuse("picture", "nyquist", "must be left out: this drive feeds nothing back");
}

std::vector<DescribingAnalysis> loop_analyses(const std::vector<DescribingAnalysis>& analyses,
                                              DescribedPart part) {
  const auto is_gap = [](DescribedPart other) {
    return other == DescribedPart::gap_load_held || other == DescribedPart::gap_load_coasting;
  };
  return those_of(analyses, [&](const DescribingAnalysis& analysis) {
    const bool is_wanted = analysis.part == part || (is_gap(part) && is_gap(analysis.part));
    return is_wanted && is_in_loop(analysis);
  });
}

Plot nyquist_plot(const NyquistPicture& picture) {
  const std::vector<KeyPoint> points = key_points(picture);
  Panel panel = critical_panel(picture, points);
  const Paper paper(panel);
  panel.layers.push_back(zero_lines(panel, {.colour = "#888888", .width = 0.8}));
  const std::vector<DrawnCurve> curves = traced_curves(picture, panel);
  for (const DrawnCurve& curve : curves) {
    if (!curve.layer.points.empty()) panel.layers.push_back(curve.layer);
    panel.layers.push_back({.kind = LayerKind::area,
                            .colour = curve.layer.colour,
                            .points = arrow_of(curve.seen, paper)});
  }
  for (const KeyPoint& point : points) panel.layers.push_back(layer_of(point, paper));
  add_marks(points, curves, paper, panel);
  const bool has_exact = any_of(picture.exact, is_drawn);
  return plot_of(picture.title,
                 std::string("cycles are predicted where L(jω) = −1/N(A)") +
                     (has_exact ? "; were that exact, the diamonds would be one point" : ""),
                 std::move(panel));
}

}  // namespace gearlash
