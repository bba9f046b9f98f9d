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
#include "picture/gnuplot.hpp"
#include "picture/gnuplot_script.hpp"
#include "picture/nyquist_curves.hpp"
#include "picture/text_placer.hpp"

namespace gearlash {
namespace {

using drive::DescribedMotion;
using drive::DescribedPart;
using drive::DescribingAnalysis;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr int label_digits = 3;

// The frame of terminal() and heading(), in shares of the picture; then this picture's proportions.
constexpr double frame_left = 0.11;
constexpr double frame_width = 0.97 - frame_left;
constexpr double frame_top = 0.88;
constexpr double paper_width = 9.0;
constexpr double paper_height = 7.0;

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
                       double aspect) {
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
  return window_around(shown, aspect);
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
    constexpr double room = 0.1;
    if (!is_finite(at) || !window_.holds(at, -0.03)) return;
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

/// Mean width of a letter of the labels, in heights of the frame.
double letter_width(PictureFormat format) {
  switch (format) {
    case PictureFormat::svg:
      return 0.017;
    case PictureFormat::png:
      return 0.0155;
    case PictureFormat::pdf:
      return 0.0125;
  }
  return 0.0;
}

// ---- the drawing --------------------------------------------------------------------------------

struct CurveStyle {
  const char* colour;
  const char* dash;
};
// Colours that colour-blind readers distinguish (Okabe and Ito); dashes do the same in grey.
constexpr CurveStyle loop_style = {"#0072b2", "1"};
constexpr std::array inverse_styles = {CurveStyle{"#d55e00", "(10,4)"},
                                       CurveStyle{"#009e73", "(4,3)"},
                                       CurveStyle{"#cc79a7", "(12,3,3,3)"}};

struct DrawnCurve {
  std::string name;
  Trace trace;
  CurveStyle style;
  std::vector<CurveMark> marks;
};

class NyquistDrawing {
 public:
  NyquistDrawing(const NyquistPicture& picture, PictureFormat format, double aspect)
      : points_(key_points(picture)),
        window_(critical_window(picture, points_, aspect)),
        format_(format) {
    trace_curves(picture);
    choose_marks(picture);
    const Complex opposite =
        window_.corner + Complex{window_.aspect * window_.height, window_.height};
    script_ = fmt::format(
        "set lmargin screen {:.3g}\nset grid linewidth 0.5 linecolor rgb '#dddddd'\n"
        "set xzeroaxis linewidth 0.8 linecolor rgb '#888888'\n"
        "set yzeroaxis linewidth 0.8 linecolor rgb '#888888'\n"
        "set xlabel 'real part'\nset ylabel 'imaginary part'\n"
        "set xrange [{:.7g}:{:.7g}]\nset yrange [{:.7g}:{:.7g}]\n",
        frame_left, window_.corner.real(), opposite.real(), window_.corner.imag(), opposite.imag());
    for (std::size_t i = 0; i < curves_.size(); ++i) draw_curve(i);
    draw_points();
    draw_texts();
  }

  std::string script() const { return script_ + data_ + plot_command(layers_); }
  const std::vector<std::string>& legend() const { return legend_; }

 private:
  void trace_curves(const NyquistPicture& picture) {
    const TransferFunction& loop = picture.analyses.front().loop;
    curves_.push_back({"L(jω)", traced_loop(loop, window_), loop_style, {}});
    for (std::size_t i = 0; i < picture.analyses.size(); ++i) {
      const DescribingAnalysis& analysis = picture.analyses[i];
      curves_.push_back(
          {"−1/N(A)" + distinction(picture, analysis) + meaning(analysis, picture.is_normalized),
           traced_inverse_gain(analysis.nonlinearity, window_),
           inverse_styles[i % inverse_styles.size()],
           {}});
    }
  }

  /// The unit of the amplitude marks.
  static std::string meaning(const DescribingAnalysis& analysis, bool is_normalized) {
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

  void choose_marks(const NyquistPicture& picture) {
    std::vector<Complex> taken = {window_.on_paper(0.0)};  // where unnumbered marks crowd
    for (const KeyPoint& point : points_) {
      if (is_finite(point.at)) taken.push_back(window_.on_paper(point.at));
    }
    MarkChooser chooser(window_, taken);
    for (std::size_t i = 0; i < picture.analyses.size(); ++i) {
      curves_[i + 1].marks = amplitude_marks(picture.analyses[i], chooser);
    }
    curves_[0].marks = frequency_marks(picture, chooser);
  }

  void draw_curve(std::size_t number) {
    const DrawnCurve& curve = curves_[number];
    DataBlock line(fmt::format("curve{}", number));
    bool was_seen = true;
    for (const TracePoint& point : curve.trace) {
      const bool is_seen = is_finite(point.value) && window_.holds(point.value, 0.5);
      if (is_seen) line.row(point.value.real(), point.value.imag());
      if (!is_seen && was_seen) line.gap();
      was_seen = is_seen;
    }
    if (!line.is_empty()) {
      data_ += line.text();
      layers_.push_back(fmt::format(
          "$curve{} using 1:2 with lines linewidth 1.8 dashtype {} linecolor rgb '{}' title {}",
          number, curve.style.dash, curve.style.colour, gearlash::quoted(curve.name)));
      legend_.push_back(curve.name);
    }
    DataBlock marks(fmt::format("marks{}", number));
    for (const CurveMark& mark : curve.marks) marks.row(mark.at.real(), mark.at.imag());
    if (!marks.is_empty()) {
      data_ += marks.text();
      layers_.push_back(fmt::format(
          "$marks{} using 1:2 with points pointtype 7 pointsize 0.45 linecolor rgb '{}' notitle",
          number, curve.style.colour));
    }
    draw_arrow(curve);
  }

  /// Draws an arrow towards a growing parameter, in the middle of the visible curve.
  void draw_arrow(const DrawnCurve& curve) {
    std::vector<Complex> seen;
    for (const TracePoint& point : curve.trace) {
      if (!is_finite(point.value) || !window_.holds(point.value)) continue;
      if (seen.empty() || std::abs(point.value - seen.back()) > 0.004 * window_.height) {
        seen.push_back(point.value);
      }
    }
    constexpr std::size_t apart = 4;
    if (seen.size() < 2 * apart) return;
    const Complex tip = seen[seen.size() * 2 / 5 + apart];
    const Complex tail = seen[seen.size() * 2 / 5];
    script_ += fmt::format(
        "set arrow from {:.7g},{:.7g} to {:.7g},{:.7g} head filled size screen 0.013,18 "
        "linewidth 1.8 linecolor rgb '{}'\n",
        tail.real(), tail.imag(), tip.real(), tip.imag(), curve.style.colour);
    arrows_.push_back(window_.on_paper(tip));
  }

  static int point_type(MarkKind mark) {
    switch (mark) {
      case MarkKind::stable:
        return 7;
      case MarkKind::unstable:
        return 6;
      case MarkKind::exact_frequency:
        return 13;
      case MarkKind::exact_amplitude:
        return 12;
    }
    return 0;
  }

  void draw_points() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const KeyPoint& point = points_[i];
      const std::string style =
          fmt::format("with points pointtype {} pointsize 1.2 linewidth 1.6 linecolor rgb 'black'",
                      point_type(point.mark));
      std::string name = point.legend;
      if (is_finite(point.at) && window_.holds(point.at)) {
        DataBlock block(fmt::format("point{}", i));
        block.row(point.at.real(), point.at.imag());
        data_ += block.text();
        layers_.push_back(
            fmt::format("$point{} using 1:2 {} title {}", i, style, gearlash::quoted(name)));
      } else {
        name += is_finite(point.at) ? "; outside" : ": none, too small";
        layers_.push_back(fmt::format("keyentry {} title {}", style, gearlash::quoted(name)));
      }
      legend_.push_back(name);
    }
  }

  std::vector<Complex> obstacles() const {
    std::vector<Complex> found = arrows_;
    for (const DrawnCurve& curve : curves_) {
      Complex last{-1.0, -1.0};
      for (const TracePoint& point : curve.trace) {
        if (!is_finite(point.value) || !window_.holds(point.value)) continue;
        const Complex place = window_.on_paper(point.value);
        if (std::abs(place - last) < 0.008) continue;
        found.push_back(place);
        last = place;
      }
      for (const CurveMark& mark : curve.marks) found.push_back(window_.on_paper(mark.at));
    }
    // Marks of points are larger than those of curves.
    for (const KeyPoint& point : points_) {
      if (is_finite(point.at)) found.insert(found.end(), 4, window_.on_paper(point.at));
    }
    return found;
  }

  void draw_texts() {
    TextPlacer placer(obstacles(), letter_width(format_), window_.aspect);
    const auto draw = [&](const Complex& at, const std::string& text, const char* colour,
                          bool must) {
      if (!is_finite(at) || !window_.holds(at)) return;
      const auto place = placer.place(window_.on_paper(at), text, must);
      if (!place) return;
      const Complex centre = window_.corner + window_.height * *place;
      script_ += fmt::format("set label {} at {:.7g},{:.7g} center front textcolor rgb '{}'\n",
                             gearlash::quoted(text, must ? "/:Bold*0.8" : "/*0.8"), centre.real(),
                             centre.imag(), colour);
    };
    for (const KeyPoint& point : points_) draw(point.at, point.label, "black", true);
    for (const DrawnCurve& curve : curves_) {
      for (const CurveMark& mark : curve.marks) draw(mark.at, mark.text, curve.style.colour, false);
    }
  }

  std::vector<KeyPoint> points_;
  Window window_;
  PictureFormat format_;
  std::vector<DrawnCurve> curves_;
  std::vector<Complex> arrows_;  ///< on paper
  std::string script_;
  std::string data_;
  std::vector<std::string> layers_;
  std::vector<std::string> legend_;
};

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

std::string draw_nyquist(const NyquistPicture& picture, PictureFormat format) {
  const bool has_exact = std::any_of(picture.exact.begin(), picture.exact.end(), is_drawn);
  const std::string subtitle =
      std::string("cycles are predicted where L(jω) = −1/N(A)") +
      (has_exact ? "; were that exact, the diamonds would be one point" : "");
  constexpr double letters = 0.72;
  // The frame's height depends on the legend, which depends slightly on the frame's contents.
  constexpr double usual_aspect = 1.7;
  const Legend first =
      legend_below(NyquistDrawing(picture, format, usual_aspect).legend(), format, letters);
  const double aspect = frame_width * paper_width / ((frame_top - first.bottom) * paper_height);
  const NyquistDrawing drawing(picture, format, aspect);
  return run_gnuplot(
      terminal(format) + heading(picture.title, subtitle) + first.commands + drawing.script(),
      picture.title);
}

}  // namespace gearlash
